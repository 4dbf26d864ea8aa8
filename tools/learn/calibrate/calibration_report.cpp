#include "tools/learn/calibrate/calibration_report.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

struct MountLine {
  const char* name;
  const char* unit;
  double per_unit;
  MountValue Mount::*value;
};

constexpr MountLine kMountLines[] = {
    {"pitch", "deg", degrees(1.0), &Mount::pitch_rad},
    {"roll", "deg", degrees(1.0), &Mount::roll_rad},
    {"yaw", "deg", degrees(1.0), &Mount::yaw_rad},
    {"height", "m", 1.0, &Mount::height_m},
};

std::string line_of(const FittedParameter& p) {
  const CameraParameter& c = *p.parameter;
  const std::string name = format("  %-7s", c.key);
  if (p.observed)
    return name + format(" %9.5g%s +- %.2g (stated %.5g)  %s", p.value, c.unit, p.std, p.stated,
                         c.meaning);
  const std::string why = std::isnan(p.std) ? std::string("the residual has no least")
                                            : format("deviation %.2g%s, %.2g%s is needed", p.std,
                                                     c.unit, c.needed_std, c.unit);
  return name + format(" %9.5g%s kept as stated: not observed, ", p.stated, c.unit) + why;
}

std::string line_of(const MountLine& line, const Mount& mount) {
  const MountValue& m = mount.*line.value;
  const std::string name = format("  %-7s", line.name);
  if (!m.observed()) return name + " not observed: " + m.missing;
  return name + format(" %9.3f %s +- %.3f  (%d frames)", line.per_unit * m.value, line.unit,
                       line.per_unit * m.std, m.num_frames);
}

void close(std::ofstream* file, const std::string& path) {
  file->close();
  if (!*file) throw InputError("cannot write " + path);
}

}  // namespace

std::string to_text(const CalibrationReport& report) {
  std::string text = "lens, by VO's residual over whole drives\n";
  for (const FittedParameter& p : report.lens.parameters) text += line_of(p) + "\n";
  text += format("  residual %.4f px, %.4f px as stated (%d runs)\n", report.lens.residual_px,
                 report.lens.stated_residual_px, report.lens.num_runs);
  text +=
      "mount: camera against road (pitch nose down, roll right side down) and travel (yaw left), "
      "positive\n";
  for (const MountLine& line : kMountLines) text += line_of(line, report.mount) + "\n";
  return text;
}

void write_json(const CalibrationReport& report, const std::string& path) {
  nlohmann::ordered_json json;
  json["logs"] = report.logs;
  for (const FittedParameter& p : report.lens.parameters) {
    auto& entry = json["lens"][p.parameter->key];
    entry["value"] = p.value;
    entry["stated"] = p.stated;
    entry["std"] = p.std;  // null when there is none
    entry["observed"] = p.observed;
  }
  json["residual_px"] = report.lens.residual_px;
  json["stated_residual_px"] = report.lens.stated_residual_px;
  for (const MountLine& line : kMountLines) {
    const MountValue& m = report.mount.*line.value;
    auto& entry = json["mount"][std::string(line.name) + "_" + line.unit];
    entry["observed"] = m.observed();
    entry["num_frames"] = m.num_frames;
    if (m.observed()) {
      entry["value"] = line.per_unit * m.value;
      entry["std"] = line.per_unit * m.std;
    } else {
      entry["why"] = m.missing;
    }
  }
  std::ofstream file(path);
  file << json.dump(2) << "\n";
  close(&file, path);
}

void write_camera_config(const CalibrationReport& report, const std::string& path) {
  std::ofstream file(path);
  file << "# Written by plumb-calibrate.\n#\n";
  std::string text = to_text(report);
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    file << "# " << text.substr(begin, end - begin) << "\n";
    begin = end + 1;
  }
  file << "\n[camera]\n";
  for (const FittedParameter& p : report.lens.parameters) {
    if (!p.observed) continue;
    const std::string key = p.parameter->key;
    if (key == "k1" || key == "k2") file << "residual_" << key << format(" = %.6f\n", p.value);
    if (key == "focal")
      file << format("rectified_fx_px = %.3f\nrectified_fy_px = %.3f\n", p.value, p.value);
    if (key == "row") file << format("rectified_cy_px = %.3f\n", p.value);
  }
  if (report.mount.height_m.observed())
    file << format("camera_height_m = %.4f\n", report.mount.height_m.value);
  close(&file, path);
}

}  // namespace plumb
