/// Tests rotation and direction of translation on real images against the truth of the drive, and
/// that nothing is allocated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <vector>

#include "modules/vo/vo.hpp"
#include "tests/support/count_malloc.hpp"
#include "tests/support/kitti_data.hpp"

namespace plumb {
namespace {

struct Sequence {
  CameraModel camera;
  std::vector<cv::Mat> images;
  std::vector<Se3> T_world_cam;
};

Sequence load(const std::filesystem::path& folder) {
  Sequence s;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "image_0")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files)
    s.images.push_back(cv::imread(file.string(), cv::IMREAD_GRAYSCALE));
  std::ifstream calib(folder / "calib.txt");
  std::string name;
  double p[12];
  calib >> name;
  for (double& x : p) calib >> x;
  s.camera = {s.images[0].cols, s.images[0].rows, p[0], p[5], p[2], p[6], 0.0256, -0.0076, 1.65};
  std::ifstream poses(folder / "poses.txt");
  while (poses >> p[0]) {
    for (int i = 1; i < 12; ++i) poses >> p[i];
    Se3 T;
    T.R << p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10];
    T.t << p[3], p[7], p[11];
    s.T_world_cam.push_back(T);
  }
  return s;
}

TEST(Kitti, RotationDriftStaysSmallAndNothingIsAllocated) {
  const auto folder = test::kitti_sequence("odometry/sequences/07_000-159");
  if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
  const Sequence s = load(folder);
  ASSERT_EQ(s.images.size(), s.T_world_cam.size());
  VisualOdometry odometry(VoConfig{}, s.camera, 1);
  NullProbe probe;
  Se3 T_start_cam;
  std::size_t start = 0;
  double distance_m = 0.0;
  double worst_direction_rad = 0.0;
  const std::int64_t before = test::g_num_mallocs;
  for (std::size_t i = 0; i < s.images.size(); ++i) {
    const auto seq = static_cast<std::int64_t>(i);
    const cv::Mat& m = s.images[i];
    const VoOutput& out =
        odometry.update({100'000 * (seq + 1),
                         seq,
                         {m.data, m.cols, m.rows, static_cast<std::ptrdiff_t>(m.step[0])}},
                        probe);
    if (start == 0) {
      ASSERT_LT(i, 8U) << "should have started by now";
      if (out.status == VoStatus::kOk) start = i;
      continue;
    }
    ASSERT_EQ(out.status, VoStatus::kOk) << i;
    T_start_cam = T_start_cam * out.T_prev_cam;
    const Se3 truth = s.T_world_cam[i - 1].inverse() * s.T_world_cam[i];
    distance_m += truth.t.norm();
    const double cosine = out.T_prev_cam.t.normalized().dot(truth.t.normalized());
    worst_direction_rad = std::max(worst_direction_rad, std::acos(std::min(1.0, cosine)));
  }
  if (test::kCountsMallocs) {
    EXPECT_EQ(test::g_num_mallocs - before, 0);
  }
  const Se3 truth = s.T_world_cam[start].inverse() * s.T_world_cam.back();
  const double rotation_rad = log_so3(T_start_cam.R.transpose() * truth.R).norm();
  EXPECT_LT(rotation_rad * 57.2958 / distance_m, 0.01);  // deg/m
  EXPECT_LT(worst_direction_rad, 0.1);
}

}  // namespace
}  // namespace plumb
