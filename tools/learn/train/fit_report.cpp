#include "tools/learn/train/fit_report.hpp"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const VarianceScore& score) {
  return {{"num", score.num}, {"nees", score.nees}, {"log_likelihood", score.log_likelihood}};
}

Json to_json(const ConfidenceFit& fit) {
  Json json = {{"name", fit.name},
               {"offset", fit.line.offset},
               {"slope", fit.line.slope},
               {"bins", Json::array()}};
  for (const ConfidenceBin& bin : fit.bins)
    json["bins"].push_back({{"confidence", bin.centre}, {"variance", bin.variance}});
  return json;
}

Json model_json(const TrainedModels& models) {
  Json json;
  TrainedModels copy = models;
  const auto add = [&json](const char* key, double& value, double, double, const char*) {
    json[key] = value;
  };
  GroundModel::visit(copy.ground, add);
  PaperModel::visit(copy.paper, add);
  return json;
}

}  // namespace

std::string to_text(const std::vector<HeldOutScore>& scores) {
  std::string text =
      "Held-out drives: mean squared error over variance (1 is right), and mean ln likelihood,\n"
      "of a model that did not see the drive, and of the covariances set by hand (of the plane: "
      "the filter's alone)\n";
  text += format("%-13s %-20s %5s  %-19s  %-19s\n", "error of", "drive", "n", "learned", "by hand");
  std::map<Target, std::array<double, 5>> means;
  for (const Target target : kTargets) {
    std::array<double, 5> mean{};
    for (const HeldOutScore& s : scores) {
      if (s.target != target) continue;
      text += format("%-13s %-20s %5d  %6.2f %11.3f  %6.2f %11.3f\n", target_name(target),
                     s.drive.c_str(), s.learned.num, s.learned.nees, s.learned.log_likelihood,
                     s.hand.nees, s.hand.log_likelihood);
      mean[0] += 1.0;
      mean[1] += s.learned.nees;
      mean[2] += s.learned.log_likelihood;
      mean[3] += s.hand.nees;
      mean[4] += s.hand.log_likelihood;
    }
    if (mean[0] < 1.0) continue;
    text += format("%-13s %-20s %5s  %6.2f %11.3f  %6.2f %11.3f\n", target_name(target),
                   "mean over drives", "", mean[1] / mean[0], mean[2] / mean[0], mean[3] / mean[0],
                   mean[4] / mean[0]);
  }
  return text;
}

std::string to_text(const std::vector<OutputScore>& scores) {
  std::string text =
      "What was reported: mean squared error over variance, error and stated 1-sigma (rms)\n";
  std::string quantity;
  for (const OutputScore& s : scores) {
    if (s.quantity != quantity) text += (quantity = s.quantity) + "\n";
    text += format("  %-20s %5d  %7.2f   %8.5f  %8.5f\n", s.drive.c_str(), s.score.num,
                   s.score.nees, s.rms_error, s.mean_std);
  }
  return text;
}

std::string to_text(const std::vector<CueScore>& scores) {
  std::string text = "Cues: frames used, frames rejected by the gate, mean test ratio\n";
  std::string cue;
  for (const CueScore& s : scores) {
    if (s.cue != cue) text += (cue = s.cue) + "\n";
    text += format("  %-20s %5d %5d  %8.4f\n", s.drive.c_str(), s.num_used, s.num_rejected,
                   s.mean_test_ratio);
  }
  return text;
}

std::string to_text(const std::vector<ConfidenceFit>& fits) {
  std::string text = "Lines: variance = offset + slope * confidence\n";
  for (const ConfidenceFit& fit : fits) {
    text += format("  %-9s %4zu bins  offset %.4g  slope %.4g  [%.4g, %.4g]  mean %.4g\n", fit.name,
                   fit.bins.size(), fit.line.offset, fit.line.slope, fit.line.least, fit.line.most,
                   fit.line.mean);
  }
  return text;
}

void write_json(const FitReport& report, const std::filesystem::path& path) {
  Json json = {{"model", model_json(report.models)},
               {"held_out", Json::array()},
               {"outputs", Json::array()},
               {"cues", Json::array()},
               {"paper", Json::array()}};
  for (const ConfidenceFit& fit : report.paper) json["paper"].push_back(to_json(fit));
  for (const HeldOutScore& s : report.held_out) {
    json["held_out"].push_back({{"drive", s.drive},
                                {"target", target_name(s.target)},
                                {"learned", to_json(s.learned)},
                                {"hand", to_json(s.hand)}});
  }
  for (const OutputScore& s : report.outputs) {
    json["outputs"].push_back({{"drive", s.drive},
                               {"quantity", s.quantity},
                               {"score", to_json(s.score)},
                               {"rms_error", s.rms_error},
                               {"mean_std", s.mean_std}});
  }
  for (const CueScore& s : report.cues) {
    json["cues"].push_back({{"drive", s.drive},
                            {"cue", s.cue},
                            {"num_used", s.num_used},
                            {"num_rejected", s.num_rejected},
                            {"mean_test_ratio", s.mean_test_ratio}});
  }
  std::ofstream file(path);
  file << json.dump(2) << "\n";
  file.close();
  if (!file) throw InputError("cannot write " + path.string());
}

}  // namespace plumb
