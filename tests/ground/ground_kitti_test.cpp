/// Tests VO and ground on real drives against lidar planes and poses. Without the drives, the tests
/// are skipped.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>

#include "modules/ground/ground.hpp"
#include "modules/vo/vo.hpp"
#include "tests/support/count_malloc.hpp"
#include "tests/support/kitti_data.hpp"

namespace plumb {
namespace {

struct LidarPlane {
  Eigen::Vector3d normal_cam;
  double height_m = 0.0;
};

CameraModel read_camera(const std::filesystem::path& folder) {
  std::ifstream file(folder / "calib.txt");
  std::string name;
  double p[12] = {};
  file >> name;
  for (double& value : p) file >> value;
  CameraModel camera;
  camera.fx_px = p[0];
  camera.cx_px = p[2];
  camera.fy_px = p[5];
  camera.cy_px = p[6];
  camera.residual_k1 = 0.0256;
  camera.residual_k2 = -0.0076;
  return camera;
}

std::map<int, LidarPlane> read_planes(const std::filesystem::path& folder) {
  std::map<int, LidarPlane> planes;
  std::ifstream file(folder / "gt_ground_plane_velodyne.txt");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream row(line);
    int frame = 0;
    LidarPlane plane;
    row >> frame >> plane.normal_cam.x() >> plane.normal_cam.y() >> plane.normal_cam.z() >>
        plane.height_m;
    planes[frame] = plane;
  }
  return planes;
}

std::vector<Eigen::Vector3d> read_positions(const std::filesystem::path& folder) {
  std::vector<Eigen::Vector3d> positions;
  std::ifstream file(folder / "poses.txt");
  double p[12];
  while (file >> p[0]) {
    for (int i = 1; i < 12; ++i) file >> p[i];
    positions.emplace_back(p[3], p[7], p[11]);
  }
  return positions;
}

std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "image_0")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct Errors {
  int num_planes = 0;
  double height_sum = 0.0;
  double height_worst = 0.0;
  double pitch_sum = 0.0;
  double pitch_square = 0.0;

  void add(const PlaneOutput& seen, const LidarPlane& truth) {
    const double height = std::abs(seen.height_m / truth.height_m - 1.0);
    const double pitch = seen.pitch_rad - std::atan2(truth.normal_cam.z(), truth.normal_cam.y());
    ++num_planes;
    height_sum += height;
    height_worst = std::max(height_worst, height);
    pitch_sum += pitch;
    pitch_square += pitch * pitch;
  }
  [[nodiscard]] double pitch_std_deg() const {
    const double mean = pitch_sum / num_planes;
    return std::sqrt(pitch_square / num_planes - mean * mean) * 57.29578;
  }
};

/// Smallest eigenvalue of the correlation matrix. When it is negative, no distribution has this
/// covariance.
double least_correlation(const Matrix6d& cov) {
  const Vector6d scale = cov.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6d correlation = scale.asDiagonal() * cov * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(correlation, Eigen::EigenvaluesOnly)
      .eigenvalues()(0);
}

class GroundOnKitti : public testing::TestWithParam<std::string> {};

TEST_P(GroundOnKitti, AgreesWithLidarAndPosesAndAllocatesNothing) {
  const std::filesystem::path folder = test::kitti_sequence(GetParam());
  if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
  const std::map<int, LidarPlane> planes = read_planes(folder);
  const std::vector<Eigen::Vector3d> positions = read_positions(folder);
  const std::vector<std::filesystem::path> files = list_images(folder);
  ASSERT_EQ(files.size(), positions.size());
  CameraModel camera = read_camera(folder);
  std::unique_ptr<VisualOdometry> vo;
  std::unique_ptr<GroundEstimator> ground;
  NullProbe probe;
  Errors errors;
  std::int64_t num_mallocs = 0;
  double distance_m = 0.0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const cv::Mat image = cv::imread(files.at(k).string(), cv::IMREAD_GRAYSCALE);
    ASSERT_FALSE(image.empty()) << files[k];
    if (ground == nullptr) {
      camera.width_px = image.cols;
      camera.height_px = image.rows;
      vo = std::make_unique<VisualOdometry>(VoConfig{}, camera, 1);
      ground = std::make_unique<GroundEstimator>(GroundConfig{}, camera);
    }
    const auto seq = static_cast<std::int64_t>(k);
    const ImageView view{image.data, image.cols, image.rows,
                         static_cast<std::ptrdiff_t>(image.step[0])};
    const VoOutput& motion = vo->update({seq * 100'000, seq, view}, probe);
    const auto before = test::g_num_mallocs.load();
    const GroundOutput& out = ground->update({&motion, view}, probe);
    num_mallocs += test::g_num_mallocs.load() - before;
    distance_m = out.ego.distance_m;
    if (out.ego.status == EgoStatus::kOk) {
      EXPECT_GT(least_correlation(out.ego.cov_prev_cam), 0.0) << k;
      EXPECT_GT(least_correlation(out.ego.cov_world_cam), 0.0) << k;
    }
    const auto truth = planes.find(static_cast<int>(k));
    if (truth != planes.end() && out.plane.status == GroundStatus::kOk) {
      errors.add(out.plane, truth->second);
    }
  }
  EXPECT_EQ(num_mallocs, 0);
  EXPECT_GE(errors.num_planes, static_cast<int>(positions.size()) - 5);
  EXPECT_LT(errors.height_sum / errors.num_planes, 0.02);
  EXPECT_LT(errors.height_worst, 0.07);
  EXPECT_LT(errors.pitch_std_deg(), 0.2);
  double path_m = 0.0;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    path_m += (positions[k] - positions[k - 1]).norm();
  }
  EXPECT_NEAR(distance_m, path_m, 0.02 * path_m);
}

INSTANTIATE_TEST_SUITE_P(Drives, GroundOnKitti,
                         testing::Values("odometry/sequences/04_000-050", "raw/drive0009_000-050"));

}  // namespace
}  // namespace plumb
