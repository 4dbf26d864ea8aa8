#include "modules/chain/model_file_source.hpp"

#include <cstdio>
#include <cstdlib>

#include "platform/complete_reader.hpp"
#include "platform/config.hpp"

namespace plumb {
namespace {

constexpr const char* kSchema = "plumb.ground_model";

/// Visits the schema and origin: field() as ConfigReader and ConfigWriter have it.
template <typename Models, typename Visit>
void visit_head(std::string& schema, int& version, Models& models, Visit&& field) {
  ModelOrigin& origin = models.ground.origin;
  field("model.schema", schema, {kSchema}, "what this file is");
  field("model.version", version, kGroundModelVersion, kGroundModelVersion, "of the schema");
  field("model.drives", origin.drives, "trained on");
  field("model.command", origin.command, "that wrote this file");
  field("model.date", origin.date, "UTC");
}

template <typename Models, typename Visit>
void visit_numbers(Models& models, Visit&& field) {
  GroundModel::visit(models.ground, field);
  PaperModel::visit(models.paper, field);
}

void check_bounds(const std::string& path, const char* name, double low, double high) {
  if (low <= high) return;
  throw ConfigError(path + ": " + name + ": the lower bound is above the upper one");
}

void check_all_bounds(const std::string& path, const TrainedModels& models) {
  const GroundModel& ground = models.ground;
  const auto check = [&path](const char* name, const LogVariance& v) {
    check_bounds(path, name, v.low_std, v.high_std);
  };
  check("dense_n1", ground.dense_n1);
  check("dense_n3", ground.dense_n3);
  check("dense_height", ground.dense_height);
  check("points", ground.points);
  check("travel", ground.chord);
  check("plane_pitch", ground.plane_pitch);
  check("plane_roll", ground.plane_roll);
  check("plane_height", ground.plane_height);
  const auto check_line = [&path](const char* name, const LinearVariance& v) {
    check_bounds(path, name, v.least, v.most);
  };
  check_line("objects_n3", ground.objects_n3);
  check_line("paper_dense_n1", models.paper.dense_n1);
  check_line("paper_dense_n3", models.paper.dense_n3);
  check_line("paper_dense_h", models.paper.dense_h);
  check_line("paper_points_h", models.paper.points_h);
  check_line("paper_objects_n3", models.paper.objects_n3);
}

double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", kModelDigits, value);
  return std::strtod(text, nullptr);
}

}  // namespace

TrainedModels load_models(const std::string& path) {
  TrainedModels models;
  if (path.empty()) return models;
  ConfigFile file = ConfigFile::load(path);
  std::string schema;
  int version = 0;
  visit_head(schema, version, models, CompleteReader(path, &file));
  visit_numbers(models, CompleteReader(path, &file));
  file.refuse_unread();
  check_all_bounds(path, models);
  return models;
}

std::string models_text(const TrainedModels& models) {
  TrainedModels text_models = models;
  visit_numbers(text_models, [](const char*, double& value, double, double, const char*) {
    value = rounded(value);
  });
  std::string schema = kSchema;
  int version = kGroundModelVersion;
  ConfigWriter writer;
  visit_head(schema, version, text_models, writer);
  visit_numbers(text_models, writer);
  return "# How far plumb-ground trusts its cues. Written by plumb-train fit; the meaning of each "
         "number is in\n# modules/ground/covariance/ground_model.hpp.\n" +
         writer.sections();
}

}  // namespace plumb
