#include "modules/mount/mount_source.hpp"

#include "core/input_error.hpp"
#include "platform/complete_reader.hpp"
#include "platform/config.hpp"
#include "platform/durable_file.hpp"

namespace plumb {
namespace {

constexpr const char* kSchema = "plumb.mount_reference";
constexpr int kVersion = 1;
constexpr double kMost_rad = 1.6;

template <typename Visit>
void visit(MountReference& r, Visit&& field) {
  std::string schema = kSchema;
  int version = kVersion;
  field("mount_reference.schema", schema, {kSchema}, "what this file is");
  field("mount_reference.version", version, kVersion, kVersion, "version of the schema");
  field("mount_reference.num_stretches", r.num_stretches, 1, 1'000'000,
        "number of straight stretches measured");
  const auto angle = [&](const char* mean, const char* std, int i, const char* meaning) {
    field(mean, r.mean_rad(i), -kMost_rad, kMost_rad, meaning);
    field(std, r.std_rad(i), 0.0, kMost_rad, "standard deviation of it");
  };
  angle("mount_reference.pitch_rad", "mount_reference.pitch_std_rad", 0,
        "against the road, nose down positive");
  angle("mount_reference.roll_rad", "mount_reference.roll_std_rad", 1,
        "against the road, right side down positive");
  angle("mount_reference.yaw_rad", "mount_reference.yaw_std_rad", 2,
        "against the direction of motion, looking left positive");
}

}  // namespace

MountReference load_mount_reference(const std::string& path) {
  MountReference reference;
  ConfigFile file = ConfigFile::load(path);
  visit(reference, CompleteReader(path, &file));
  file.refuse_unread();
  return reference;
}

void save_mount_reference(const std::string& path, const MountReference& reference) {
  MountReference out = reference;
  ConfigWriter writer;
  visit(out, writer);
  const std::string text =
      "# Orientation of the camera on its vehicle. Written by plumb-ground; delete it after work "
      "on "
      "the camera.\n" +
      writer.sections();
  if (!replace_file(path, text)) throw InputError("cannot write " + path);
}

}  // namespace plumb
