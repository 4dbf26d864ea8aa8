#include "modules/datasets/kitti/oxts.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/kitti/calibration.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;
constexpr double kEarthRadius_m = 6378137.0;
constexpr std::size_t kNumOxtsFields = 30;

fs::path first_existing(const fs::path& drive, const char* name) {
  const fs::path absolute = fs::absolute(drive / ".").lexically_normal().parent_path();
  for (const fs::path& candidate : {absolute / name, absolute.parent_path() / name}) {
    if (fs::exists(candidate)) return candidate;
  }
  return {};
}

Se3 T_mercator_imu(const std::vector<double>& oxts, double mercator_scale) {
  Se3 T;
  T.t.x() = mercator_scale * kEarthRadius_m * oxts[1] * kDegree;
  T.t.y() = mercator_scale * kEarthRadius_m * std::log(std::tan((90.0 + oxts[0]) * kDegree / 2.0));
  T.t.z() = oxts[2];
  T.R = (Eigen::AngleAxisd(oxts[5], Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(oxts[4], Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(oxts[3], Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
  return T;
}

std::optional<std::vector<double>> read_oxts(const fs::path& folder, std::int64_t number) {
  const fs::path file = folder / format("%010lld.txt", static_cast<long long>(number));
  if (!fs::exists(file)) return {};
  const std::vector<NumberRow> rows = read_number_rows(file, kNumOxtsFields, kNumOxtsFields);
  if (rows.size() != 1) throw InputError(file.string() + ": expected one row");
  if (std::abs(rows.front().values[0]) > 85.0) {
    throw InputError(file.string() + ":1: latitude is outside [-85, 85]");
  }
  return rows.front().values;
}

}  // namespace

RawCalibration find_raw_calibration(const fs::path& drive) {
  return {first_existing(drive, "calib_cam_to_cam.txt"),
          first_existing(drive, "calib_velo_to_cam.txt"),
          first_existing(drive, "calib_imu_to_velo.txt")};
}

Se3 read_T_cam_imu(const RawCalibration& files) {
  const CalibrationFile cam_to_cam(files.cam_to_cam);
  const std::vector<double> r = cam_to_cam.numbers("R_rect_00", 9);
  Se3 T_rect_cam;
  for (int i = 0; i < 9; ++i) T_rect_cam.R(i / 3, i % 3) = r[static_cast<std::size_t>(i)];
  const Se3 T_cam_velo = CalibrationFile(files.velo_to_cam).rigid("R", "T");
  const Se3 T_velo_imu = CalibrationFile(files.imu_to_velo).rigid("R", "T");
  return T_rect_cam * T_cam_velo * T_velo_imu;
}

std::vector<std::optional<Se3>> read_oxts_poses(const fs::path& data_folder,
                                                const std::vector<NumberedImage>& images,
                                                const Se3& T_cam_imu) {
  std::vector<std::optional<Se3>> poses;
  std::optional<double> mercator_scale;
  std::optional<Se3> T_world_mercator;
  const Se3 T_imu_cam = T_cam_imu.inverse();
  for (const NumberedImage& image : images) {
    poses.emplace_back();
    const std::optional<std::vector<double>> oxts = read_oxts(data_folder, image.number);
    if (!oxts) continue;
    if (!mercator_scale) mercator_scale = std::cos(oxts->front() * kDegree);
    const Se3 T_mercator_cam = T_mercator_imu(*oxts, *mercator_scale) * T_imu_cam;
    if (!T_world_mercator) T_world_mercator = T_mercator_cam.inverse();
    poses.back() = *T_world_mercator * T_mercator_cam;
  }
  return poses;
}

}  // namespace plumb
