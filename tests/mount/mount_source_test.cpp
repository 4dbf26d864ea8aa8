#include "modules/mount/mount_source.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "platform/config.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

std::string config_error_of(const std::string& path) {
  try {
    (void)load_mount_reference(path);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

const MountReference kReference{{-0.012, 0.004, 0.03}, {0.001, 0.002, 0.0005}, 10};

TEST(MountSource, ComesBackAsItWas) {
  const test::TempFolder folder;
  const std::string path = (folder.path() / "mount.toml").string();
  save_mount_reference(path, kReference);
  save_mount_reference(path, kReference);
  const MountReference back = load_mount_reference(path);
  EXPECT_EQ(back.mean_rad, kReference.mean_rad);
  EXPECT_EQ(back.std_rad, kReference.std_rad);
  EXPECT_EQ(back.num_stretches, 10);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(MountSource, RefusesADamagedFileAndNamesTheKey) {
  const test::TempFolder folder;
  const std::string path = (folder.path() / "mount.toml").string();
  save_mount_reference(path, kReference);
  std::string text;
  std::ifstream in(path);
  std::getline(in, text, '\0');
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    std::ofstream(path) << changed;
  };
  with("yaw_rad", "jaw_rad");
  test::expect_contains(config_error_of(path), "yaw_rad is missing");
  with("version = 1", "version = 2");
  test::expect_contains(config_error_of(path), "version");
  with("pitch_std_rad = ", "pitch_std_rad = -");
  test::expect_contains(config_error_of(path), "pitch_std_rad");
}

TEST(MountSource, SaysWhenItCannotBeWritten) {
  test::expect_contains(
      test::input_error_of([&] { save_mount_reference("/no/such/folder/mount.toml", kReference); }),
      "cannot write");
}

}  // namespace
}  // namespace plumb
