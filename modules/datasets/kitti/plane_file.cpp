#include "modules/datasets/kitti/plane_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"

namespace plumb {
namespace {

constexpr std::size_t kManyColumns = 64;

}  // namespace

// With R_ground_veh = Rz Ry(pitch) Rx(roll), the downward direction in the camera's axes is
// (n3, -n1, -n2) = (sin pitch, -cos pitch sin roll, -cos pitch cos roll). The estimator has its own
// code for this (modules/ground). The truth does not share it,
// so that a wrong sign there is detected.
double TruePlane::pitch_rad() const { return std::asin(std::clamp(normal_cam.z(), -1.0, 1.0)); }

double TruePlane::roll_rad() const { return std::atan2(normal_cam.x(), normal_cam.y()); }

std::map<std::int64_t, TruePlane> read_planes(const std::filesystem::path& path) {
  std::map<std::int64_t, TruePlane> planes;
  for (const NumberRow& row : read_number_rows(path, 5, kManyColumns)) {
    const std::string at = path.string() + ":" + std::to_string(row.line) + ": ";
    TruePlane plane;
    plane.normal_cam = {row.values[1], row.values[2], row.values[3]};
    plane.height_m = row.values[4];
    if (std::abs(plane.normal_cam.norm() - 1.0) > 0.01 || plane.normal_cam.y() <= 0.0) {
      throw InputError(at + "columns 2-4 are not a unit normal that points down");
    }
    if (plane.height_m <= 0.0) throw InputError(at + "height in column 5 is not above zero");
    plane.normal_cam.normalize();
    const auto frame = static_cast<std::int64_t>(row.values[0]);
    if (!planes.emplace(frame, plane).second) {
      throw InputError(at + "frame " + std::to_string(frame) + " is given twice");
    }
  }
  return planes;
}

}  // namespace plumb
