#include "modules/datasets/kitti/calibration.hpp"

#include <cmath>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"

namespace plumb {

CalibrationFile::CalibrationFile(const std::filesystem::path& path) : path_(path) {
  int line = 0;
  for (const std::string& text : read_lines(path)) {
    ++line;
    const auto colon = text.find(':');
    if (colon == std::string::npos || text.front() == '#') continue;
    const auto words = split_words(std::string_view(text).substr(0, colon));
    if (words.size() != 1) continue;
    Entry& entry = entries_[std::string(words.front())];
    entry.line = line;
    ++entry.count;
    entry.text = text.substr(colon + 1);
  }
}

std::vector<double> CalibrationFile::numbers(const std::string& key, std::size_t count) const {
  const auto found = entries_.find(key);
  if (found == entries_.end()) throw InputError(path_.string() + ": " + key + " is missing");
  const Entry& entry = found->second;
  const std::string at = path_.string() + ":" + std::to_string(entry.line) + ": " + key;
  if (entry.count > 1) throw InputError(at + " is given twice");
  std::vector<double> values;
  for (const std::string_view word : split_words(entry.text)) {
    const std::optional<double> value = parse_number(word);
    if (!value) throw InputError(at + ": '" + std::string(word) + "' is not a finite number");
    values.push_back(*value);
  }
  if (values.size() != count) {
    throw InputError(at + " has " + std::to_string(values.size()) + " numbers, expected " +
                     std::to_string(count));
  }
  return values;
}

std::optional<double> CalibrationFile::optional_number(const std::string& key) const {
  if (!has(key)) return {};
  return numbers(key, 1).front();
}

Se3 CalibrationFile::rigid(const std::string& r_key, const std::string& t_key) const {
  const std::vector<double> r = numbers(r_key, 9);
  const std::vector<double> t = numbers(t_key, 3);
  Se3 T;
  for (int i = 0; i < 9; ++i) T.R(i / 3, i % 3) = r[static_cast<std::size_t>(i)];
  T.t = {t[0], t[1], t[2]};
  if ((T.R.transpose() * T.R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-3) {
    throw InputError(path_.string() + ": " + r_key + " is not a rotation");
  }
  return T;
}

RectifiedCamera read_projection(const CalibrationFile& file, const std::string& key) {
  const std::vector<double> p = file.numbers(key, 12);
  const bool pinhole = p[1] == 0.0 && p[4] == 0.0 && p[8] == 0.0 && p[9] == 0.0 && p[10] == 1.0;
  if (p[0] <= 0.0 || p[5] <= 0.0 || !pinhole) {
    throw InputError(file.path().string() + ": " + key +
                     " is not the projection of a rectified pinhole camera");
  }
  RectifiedCamera camera;
  camera.model.fx_px = p[0];
  camera.model.fy_px = p[5];
  camera.model.cx_px = p[2];
  camera.model.cy_px = p[6];
  // P = K [I | t] means p_cam = p_left + t, so the camera is at -t.
  const double tz = p[11];
  camera.t_left_cam_m = {-(p[3] - p[2] * tz) / p[0], -(p[7] - p[6] * tz) / p[5], -tz};
  return camera;
}

}  // namespace plumb
