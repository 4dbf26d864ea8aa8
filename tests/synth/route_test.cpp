#include "tools/synth/route.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/support/temp_folder.hpp"

namespace plumb::synth {
namespace {

double largest_step(const Route& route) {
  double largest = 0.0;
  const std::vector<double>& s = route.schedule.s_m;
  for (std::size_t i = 1; i < s.size(); ++i) largest = std::max(largest, s[i] - s[i - 1]);
  return largest / Schedule::kTimeStep;
}

TEST(Route, EveryBuiltInRouteMovesForwardAndIsLongEnough) {
  for (const auto& [name, text] : builtin_routes()) {
    const Route route = make_builtin_route(name, 30.0, 5);
    ASSERT_GE(static_cast<double>(route.schedule.s_m.size()) * Schedule::kTimeStep, 30.0) << name;
    for (std::size_t i = 1; i < route.schedule.s_m.size(); ++i) {
      ASSERT_GE(route.schedule.s_m[i], route.schedule.s_m[i - 1] - 1e-9) << name;
    }
    EXPECT_LT(route.schedule.s_m.back(), route.length_m() - 100.0)
        << name << ": the view must not end at the road's end";
    EXPECT_LT(largest_step(route), 30.0) << name;
  }
}

TEST(Route, MotorwayIsFastAndCityTurnsCorners) {
  EXPECT_GT(largest_step(make_builtin_route("motorway", 20.0, 1)), 25.0);
  const Route city = make_builtin_route("city", 40.0, 1);
  double sharpest = 0.0;
  for (const RoutePoint& p : city.points) sharpest = std::max(sharpest, std::abs(p.curvature));
  EXPECT_GT(sharpest, 1.0 / 14.0);
  EXPECT_LT(sharpest, 1.0 / 6.0);
}

TEST(Route, StopAndGoStandsStillAndMovesAgain) {
  const Route route = make_builtin_route("stop-and-go", 40.0, 2);
  int standing = 0;
  int moving = 0;
  for (std::size_t i = 1; i < route.schedule.s_m.size(); ++i) {
    const double v = (route.schedule.s_m[i] - route.schedule.s_m[i - 1]) / Schedule::kTimeStep;
    standing += v < 1e-6 ? 1 : 0;
    moving += v > 4.0 ? 1 : 0;
  }
  EXPECT_GT(standing, 1000);
  EXPECT_GT(moving, 1000);
}

TEST(Route, UnknownNameIsRefused) {
  EXPECT_THROW((void)make_builtin_route("nowhere", 10.0, 1), std::invalid_argument);
}

/// Writes a pose file of a drive once around a square; its height drifts by 2 m.
std::filesystem::path write_square(const test::TempFolder& folder) {
  const std::filesystem::path file = folder / "square.txt";
  std::ofstream out(file);
  double x = 0.0;
  double z = 0.0;
  double yaw = 0.0;
  for (int i = 0; i < 460; ++i) {
    out << std::cos(yaw) << " 0 " << std::sin(yaw) << ' ' << x << " 0 1 0 " << -0.0045 * i << ' '
        << -std::sin(yaw) << " 0 " << std::cos(yaw) << ' ' << z << '\n';
    if (i % 100 >= 85) yaw += 1.5707963 / 15.0;
    x += std::sin(yaw);
    z += std::cos(yaw);
  }
  return file;
}

TEST(Route, PoseRouteFollowsTheFileAndGivesOnePlaceOneHeight) {
  const test::TempFolder folder;
  const Route route = make_pose_route(write_square(folder), 0, -1, 10.0, 1.68, 1);
  const double travelled = route.schedule.s_m.back() - route.schedule.s_m.front();
  EXPECT_NEAR(travelled, 458.0, 12.0);
  // The first side and the fifth lie on each other.
  const RoutePoint first = route.at(route.start_m + 20.0);
  double best = 1e9;
  double height = 0.0;
  for (double s = route.start_m + 300.0; s < route.start_m + travelled; s += 0.5) {
    const RoutePoint p = route.at(s);
    if ((p.p_map - first.p_map).norm() < best) {
      best = (p.p_map - first.p_map).norm();
      height = p.z_m;
    }
  }
  ASSERT_LT(best, 6.0);
  EXPECT_NEAR(height, first.z_m, 0.15) << "the file says " << 0.0045 * 380;
}

TEST(Route, ATruthThatRisesAtRestMakesNoHill) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "settling.txt";
  {
    std::ofstream out(file);
    double z_m = 0.0, y_m = 0.0;
    for (int i = 0; i < 200; ++i) {
      out << "1 0 0 0 0 1 0 " << y_m << " 0 0 1 " << z_m << "\n";
      const bool at_rest = i >= 60 && i < 90;
      z_m += at_rest ? 0.02 : 0.8;
      y_m -= at_rest ? 0.19 : 0.04;  // y points down: a street of 5 %
    }
  }
  const Route route = make_pose_route(file, 0, -1, 10.0, 1.68, 1);
  double steepest = 0.0;
  for (double s = route.start_m; s < route.start_m + 120.0; s += 1.0) {
    steepest = std::max(steepest, std::abs(route.at(s + 1.0).z_m - route.at(s).z_m));
  }
  EXPECT_LT(steepest, 0.12);
  EXPECT_NEAR(route.at(route.start_m + 120.0).z_m - route.at(route.start_m).z_m, 6.0, 0.5);
}

TEST(Route, PoseFileErrorsNameFileAndLine) {
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "bad_poses.txt";
  std::ofstream(file) << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 zero\n";
  try {
    (void)make_pose_route(file, 0, -1, 10.0, 1.68, 1);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("bad_poses.txt:2"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)make_pose_route("/nonexistent/poses.txt", 0, -1, 10.0, 1.68, 1),
               std::invalid_argument);
  EXPECT_THROW((void)make_pose_route(write_square(folder), 10, 9000, 10.0, 1.68, 1),
               std::invalid_argument);
}

TEST(SmoothSamples, KeepsStraightLines) {
  std::vector<double> line;
  for (int i = 0; i < 50; ++i) line.push_back(3.0 + 0.5 * i);
  const std::vector<double> before = line;
  smooth_samples(line, 6.0);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(line[i], before[i], 1e-9) << i;
}

}  // namespace
}  // namespace plumb::synth
