#include "tools/kitti/road_scan.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <random>

#include "core/numbers.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

constexpr double kDegree_rad = M_PI / 180.0;

/// KITTI's arrangement without its small angles: the scanner looks along the camera's axis.
Se3 plain_T_cam_velo() {
  Se3 T;
  T.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T.t = {0.0, -0.08, -0.27};
  return T;
}

TruePlane tilted_road(double height_m, double pitch_deg, double roll_deg) {
  const Eigen::Vector3d n(std::tan(roll_deg * kDegree_rad), 1.0, std::tan(pitch_deg * kDegree_rad));
  return {n.normalized(), height_m};
}

/// What 64 beams see of a road with a car ahead of us and kerbs to either side.
std::vector<Eigen::Vector3d> scan_of(const TruePlane& road, double noise_m, double beam_deg = 0.0) {
  const Se3 T = plain_T_cam_velo();
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, noise_m);
  std::vector<Eigen::Vector3d> points;
  for (int beam = 0; beam < 64; ++beam) {
    const double down_rad = (-2.0 + 26.8 * beam / 63.0) * kDegree_rad;
    for (double yaw_deg = -40.0; yaw_deg < 40.0; yaw_deg += 0.2) {
      // The scan states an angle that lies `beam_deg` below the true one.
      const auto direction = [&](double angle_rad) {
        const double yaw_rad = yaw_deg * kDegree_rad;
        return Eigen::Vector3d(std::cos(angle_rad) * std::cos(yaw_rad),
                               std::cos(angle_rad) * std::sin(yaw_rad), -std::sin(angle_rad));
      };
      const Eigen::Vector3d d = T.R * direction(down_rad);
      const double along = road.normal_cam.dot(d);
      double range_m = along > 1e-3 ? (road.height_m - road.normal_cam.dot(T.t)) / along : 60.0;
      const Eigen::Vector3d hit = T.t + range_m * d;
      if (std::abs(hit.x()) > 2.2) range_m *= 0.93;                           // the kerb
      if (hit.z() > 12.0 && std::abs(hit.x()) < 0.9) range_m = 12.0 / d.z();  // the car's rear
      points.push_back((range_m + noise(random)) * direction(down_rad + beam_deg * kDegree_rad));
    }
  }
  return points;
}

TEST(RoadScan, FindsTheRoadBesideKerbsAndACar) {
  const TruePlane truth = tilted_road(1.73, 0.9, -0.5);
  const auto found = fit_road(scan_of(truth, 0.02), plain_T_cam_velo(), {});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->plane.height_m, truth.height_m, 0.005);
  EXPECT_NEAR(degrees(found->plane.pitch_rad() - truth.pitch_rad()), 0.0, 0.05);
  EXPECT_NEAR(degrees(found->plane.roll_rad() - truth.roll_rad()), 0.0, 0.15);
  EXPECT_LT(found->num_inliers, found->num_candidates);
}

TEST(RoadScan, TakesTheErrorOfTheBeamsOut) {
  const TruePlane truth = tilted_road(1.65, 0.0, 0.0);
  const auto scan = scan_of(truth, 0.01, 0.2);
  const auto plain = fit_road(scan, plain_T_cam_velo(), {});
  RoadScanOptions options;
  options.beam_deg = 0.2;
  const auto corrected = fit_road(scan, plain_T_cam_velo(), options);
  ASSERT_TRUE(plain && corrected);
  EXPECT_NEAR(std::abs(degrees(plain->plane.pitch_rad())), 0.2, 0.05);
  EXPECT_NEAR(degrees(corrected->plane.pitch_rad()), 0.0, 0.02);
}

TEST(RoadScan, FindsNoRoadInAWall) {
  std::vector<Eigen::Vector3d> wall;
  for (int i = 0; i < 50; ++i) {
    for (int k = 0; k < 50; ++k) wall.emplace_back(10.0, 0.04 * i - 1.0, 0.05 * k - 2.5);
  }
  EXPECT_FALSE(fit_road(wall, plain_T_cam_velo(), {}));
  EXPECT_FALSE(fit_road({}, plain_T_cam_velo(), {}));
}

TEST(RoadScan, KeepsRoadAndMarkingsWhenLabelsAreGiven) {
  const test::TempFolder folder;
  const float points[][4] = {{1, 0, 0, 0}, {2, 0, 0, 0}, {3, 0, 0, 0}};
  const std::uint32_t labels[] = {40U | (7U << 16U), 10U, 60U};  // road of instance 7, car, marking
  std::ofstream(folder / "s.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(points), sizeof points);
  std::ofstream(folder / "s.label", std::ios::binary)
      .write(reinterpret_cast<const char*>(labels), sizeof labels);
  const auto kept = read_scan(folder / "s.bin", folder / "s.label");
  ASSERT_EQ(kept.size(), 2U);
  EXPECT_EQ(kept[0].x(), 1.0);
  EXPECT_EQ(kept[1].x(), 3.0);
  EXPECT_EQ(read_scan(folder / "s.bin", {}).size(), 3U);
  test::expect_contains(test::input_error_of([&] { (void)read_scan(folder / "s.label", {}); }),
                        "whole points");
  folder.write("short.label", "1234");
  test::expect_contains(
      test::input_error_of([&] { (void)read_scan(folder / "s.bin", folder / "short.label"); }),
      "one label per point");
}

TEST(RoadScan, ReadsCalibrationOfAllThreeDataSets) {
  const test::TempFolder folder;
  folder.write("odometry/calib.txt", "Tr: 0 -1 0 1 0 0 -1 2 1 0 0 3\n");
  folder.write("tracking/calib.txt",
               "R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: 0 -1 0 1 0 0 -1 2 1 0 0 3\n");
  folder.write("raw/calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 1 2 3\n");
  folder.write("raw/calib_cam_to_cam.txt", "R_rect_00: 1 0 0 0 1 0 0 0 1\n");
  for (const char* name : {"odometry", "tracking", "raw"}) {
    const Se3 T = read_T_cam_velo(folder / name);
    EXPECT_EQ(T.t, Eigen::Vector3d(1, 2, 3)) << name;
    EXPECT_EQ(T.R * Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()) << name;
  }
  test::expect_contains(test::input_error_of([&] { (void)read_T_cam_velo(folder / "none"); }),
                        "no calib.txt");
}

TEST(RoadScan, AgreesWithTheGivenPlanesOfARealDrive) {
  const auto drive = test::kitti_sequence("odometry/sequences/04_000-050");
  if (drive.empty()) GTEST_SKIP() << test::kNoKitti;
  const auto given = read_planes(drive / "gt_ground_plane_velodyne.txt");
  const Se3 T_cam_velo = read_T_cam_velo(drive);
  for (int frame = 0; frame < 3; ++frame) {
    const auto scan = drive / "velodyne" / ("00000" + std::to_string(frame) + ".bin");
    const auto found = fit_road(read_scan(scan, {}), T_cam_velo, {});
    ASSERT_TRUE(found) << frame;
    EXPECT_NEAR(found->plane.height_m, given.at(frame).height_m, 0.005);
    EXPECT_NEAR(degrees(found->plane.pitch_rad() - given.at(frame).pitch_rad()), 0.0, 0.05);
  }
}

}  // namespace
}  // namespace plumb
