#include "modules/ground/ground_model_source.hpp"

#include <cstdio>
#include <cstdlib>

#include "platform/complete_reader.hpp"
#include "platform/config.hpp"

namespace plumb {
namespace {

constexpr const char* kSchema = "plumb.ground_model";

/// Origin and identity, then the numbers: field() as ConfigReader and ConfigWriter want it.
template <typename Model, typename Visit>
void visit_head(std::string& schema, int& version, Model& model, Visit&& field) {
  field("model.schema", schema, {kSchema}, "what this file is");
  field("model.version", version, kGroundModelVersion, kGroundModelVersion, "of the schema");
  field("model.drives", model.origin.drives, "trained on");
  field("model.command", model.origin.command, "that wrote this file");
  field("model.date", model.origin.date, "UTC");
}

void check_bounds(const std::string& path, const char* name, double low, double high) {
  if (low <= high) return;
  throw ConfigError(path + ": " + name + ": the lower bound is above the upper one");
}

double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", kModelDigits, value);
  return std::strtod(text, nullptr);
}

}  // namespace

GroundModel load_ground_model(const std::string& path) {
  if (path.empty()) return built_in_ground_model();
  GroundModel model;
  ConfigFile file = ConfigFile::load(path);
  std::string schema;
  int version = 0;
  visit_head(schema, version, model, CompleteReader(path, &file));
  GroundModel::visit(model, CompleteReader(path, &file));
  file.refuse_unread();
  const auto check = [&path](const char* name, const LogVariance& v) {
    check_bounds(path, name, v.low_std, v.high_std);
  };
  check("dense_n1", model.dense_n1);
  check("dense_n3", model.dense_n3);
  check("dense_height", model.dense_height);
  check("points", model.points);
  check("travel", model.travel);
  check("plane_pitch", model.plane_pitch);
  check("plane_roll", model.plane_roll);
  check("plane_height", model.plane_height);
  check_bounds(path, "objects_n3", model.objects_n3.least, model.objects_n3.most);
  check_bounds(path, "paper_dense_n1", model.paper.dense_n1.least, model.paper.dense_n1.most);
  check_bounds(path, "paper_dense_n3", model.paper.dense_n3.least, model.paper.dense_n3.most);
  check_bounds(path, "paper_dense_h", model.paper.dense_h.least, model.paper.dense_h.most);
  check_bounds(path, "paper_points_h", model.paper.points_h.least, model.paper.points_h.most);
  return model;
}

std::string ground_model_text(const GroundModel& model) {
  GroundModel text_model = model;
  GroundModel::visit(text_model, [](const char*, double& value, double, double, const char*) {
    value = rounded(value);
  });
  std::string schema = kSchema;
  int version = kGroundModelVersion;
  ConfigWriter writer;
  visit_head(schema, version, text_model, writer);
  GroundModel::visit(text_model, writer);
  return "# How far plumb-ground trusts its cues. Written by plumb-train fit; the meaning of each "
         "number is in\n# modules/ground/covariance/ground_model.hpp.\n" +
         writer.sections();
}

}  // namespace plumb
