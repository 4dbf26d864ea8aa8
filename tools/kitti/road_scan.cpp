#include "tools/kitti/road_scan.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "modules/datasets/file_bytes.hpp"
#include "modules/datasets/kitti/calibration.hpp"
#include "modules/datasets/kitti/oxts.hpp"

namespace plumb {
namespace {

constexpr int kNumDrawnPlanes = 100;
constexpr int kNumRefinements = 20;
constexpr double kNear_m = 0.06;  // from a drawn plane
constexpr double kTukey_m = 0.1;  // beyond this a point has no weight
constexpr double kLeastDown =
    0.97;  // cosine of 14 degrees between normal and the camera's axis down
constexpr double kLeastHeight_m = 0.3;
constexpr std::size_t kLeastPoints = 100;
constexpr std::uint32_t kRoadLabel = 40;
constexpr std::uint32_t kLaneMarkingLabel = 60;

Se3 transform_of(const std::vector<double>& rows) {
  Se3 T;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) T.R(i, j) = rows[static_cast<std::size_t>(4 * i + j)];
    T.t(i) = rows[static_cast<std::size_t>(4 * i + 3)];
  }
  return T;
}

Se3 rotated(const std::vector<double>& R, const Se3& T) {
  Se3 rotation;
  for (int i = 0; i < 9; ++i) rotation.R(i / 3, i % 3) = R[static_cast<std::size_t>(i)];
  rotation.t.setZero();
  return {rotation.R * T.R, rotation.R * T.t};
}

/// Turns a point up about the axis across its beam.
Eigen::Vector3d raised(const Eigen::Vector3d& p_velo, double beam_rad) {
  const Eigen::Vector3d across = p_velo.cross(Eigen::Vector3d::UnitZ());
  if (beam_rad == 0.0 || across.norm() < 1e-6) return p_velo;
  return Eigen::AngleAxisd(beam_rad, across.normalized()) * p_velo;
}

std::vector<Eigen::Vector3d> candidates_of(const std::vector<Eigen::Vector3d>& points_velo,
                                           const Se3& T_cam_velo, const RoadScanOptions& options) {
  std::vector<Eigen::Vector3d> kept;
  const double beam_rad = options.beam_deg * M_PI / 180.0;
  for (const Eigen::Vector3d& p_velo : points_velo) {
    const Eigen::Vector3d p = T_cam_velo.R * raised(p_velo, beam_rad) + T_cam_velo.t;
    if (p.z() > options.from_m && p.z() < options.to_m && std::abs(p.x()) < options.half_width_m &&
        p.y() > kLeastHeight_m) {
      kept.push_back(p);
    }
  }
  return kept;
}

bool can_be_road(const TruePlane& plane) {
  return plane.normal_cam.y() > kLeastDown && plane.height_m > kLeastHeight_m;
}

double distance_m(const TruePlane& plane, const Eigen::Vector3d& p) {
  return plane.normal_cam.dot(p) - plane.height_m;
}

TruePlane plane_through(const Eigen::Vector3d& point, Eigen::Vector3d normal) {
  normal.normalize();
  if (normal.y() < 0.0) normal = -normal;
  return {normal, normal.dot(point)};
}

std::optional<TruePlane> best_drawn_plane(const std::vector<Eigen::Vector3d>& points) {
  std::mt19937_64 random(1);
  const auto draw = [&] { return points[random() % points.size()]; };
  std::optional<TruePlane> best;
  std::ptrdiff_t most = 0;
  for (int i = 0; i < kNumDrawnPlanes; ++i) {
    const Eigen::Vector3d a = draw(), b = draw(), c = draw();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (normal.norm() < 1e-3) continue;
    const TruePlane plane = plane_through(a, normal);
    if (!can_be_road(plane)) continue;
    const auto near = std::count_if(points.begin(), points.end(), [&](const Eigen::Vector3d& p) {
      return std::abs(distance_m(plane, p)) < kNear_m;
    });
    if (near <= most) continue;
    most = near;
    best = plane;
  }
  return best;
}

/// One step of least squares, with every point's weight after its distance from `plane`.
TruePlane refined(const std::vector<Eigen::Vector3d>& points, const TruePlane& plane) {
  double sum = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const double r = distance_m(plane, p) / kTukey_m;
    if (std::abs(r) >= 1.0) continue;
    const double weight = (1.0 - r * r) * (1.0 - r * r);
    sum += weight;
    mean += weight * p;
    squares += weight * p * p.transpose();
  }
  mean /= sum;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares / sum -
                                                              mean * mean.transpose());
  return plane_through(mean, solver.eigenvectors().col(0));
}

RoadScan summary_of(const std::vector<Eigen::Vector3d>& points, const TruePlane& plane) {
  RoadScan scan{plane, static_cast<int>(points.size()), 0, 0.0};
  for (const Eigen::Vector3d& p : points) {
    const double r = distance_m(plane, p);
    if (std::abs(r) >= kTukey_m) continue;
    ++scan.num_inliers;
    scan.rms_m += r * r;
  }
  scan.rms_m = std::sqrt(scan.rms_m / std::max(1, scan.num_inliers));
  return scan;
}

bool is_road_label(std::uint32_t word) {
  const std::uint32_t label = word & 0xFFFFU;
  return label == kRoadLabel || label == kLaneMarkingLabel;
}

}  // namespace

Se3 read_T_cam_velo(const std::filesystem::path& drive) {
  const std::filesystem::path odometry = drive / "calib.txt";
  if (std::filesystem::exists(odometry)) {
    const CalibrationFile file(odometry);
    if (file.has("Tr")) return transform_of(file.numbers("Tr", 12));
    return rotated(file.numbers("R0_rect", 9), transform_of(file.numbers("Tr_velo_to_cam", 12)));
  }
  const RawCalibration raw = find_raw_calibration(drive);
  if (raw.velo_to_cam.empty() || raw.cam_to_cam.empty()) {
    throw InputError("no calib.txt in " + drive.string() +
                     ", nor calib_velo_to_cam.txt and calib_cam_to_cam.txt there or above");
  }
  return rotated(CalibrationFile(raw.cam_to_cam).numbers("R_rect_00", 9),
                 CalibrationFile(raw.velo_to_cam).rigid("R", "T"));
}

std::vector<Eigen::Vector3d> read_scan(const std::filesystem::path& scan,
                                       const std::filesystem::path& labels) {
  const std::vector<std::uint8_t> bytes = read_bytes(scan);
  constexpr std::size_t kPointBytes = 4 * sizeof(float);
  if (bytes.empty() || bytes.size() % kPointBytes != 0)
    throw InputError(scan.string() + " is not a scan: it does not consist of whole points");
  const std::size_t num_points = bytes.size() / kPointBytes;
  std::vector<std::uint8_t> words;
  if (!labels.empty()) {
    words = read_bytes(labels);
    if (words.size() != num_points * sizeof(std::uint32_t))
      throw InputError(labels.string() + " does not have one label per point of " + scan.string());
  }
  std::vector<Eigen::Vector3d> points;
  points.reserve(num_points);
  for (std::size_t i = 0; i < num_points; ++i) {
    float xyz[3];
    std::memcpy(xyz, &bytes[i * kPointBytes], sizeof xyz);
    std::uint32_t word = kRoadLabel;
    if (!words.empty()) std::memcpy(&word, &words[i * sizeof word], sizeof word);
    if (is_road_label(word) && std::isfinite(xyz[0] + xyz[1] + xyz[2]))
      points.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  return points;
}

std::optional<RoadScan> fit_road(const std::vector<Eigen::Vector3d>& points_velo,
                                 const Se3& T_cam_velo, const RoadScanOptions& options) {
  const std::vector<Eigen::Vector3d> points = candidates_of(points_velo, T_cam_velo, options);
  if (points.size() < kLeastPoints) return {};
  std::optional<TruePlane> plane = best_drawn_plane(points);
  if (!plane) return {};
  for (int i = 0; i < kNumRefinements; ++i) plane = refined(points, *plane);
  const RoadScan scan = summary_of(points, *plane);
  if (!can_be_road(*plane) || scan.num_inliers < static_cast<int>(kLeastPoints)) return {};
  return scan;
}

}  // namespace plumb
