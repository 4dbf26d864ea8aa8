#include "tools/synth/truth.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/synth/small_studio.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(RoadPlane, NormalPointsDownAndHeightIsTheMount) {
  SynthConfig config = test::small_config("straight", 30);
  config.flat = true;
  config.drive.suspension = 0.0;
  config.drive.mount.pitch_rad = 0.03;
  config.drive.mount.roll_rad = 0.01;
  const Studio studio(config);
  const PlaneTruth plane = road_plane(studio.terrain(), studio.drive().T_map_cam(1.0));
  EXPECT_NEAR(plane.height_m, 1.65, 1e-6);
  EXPECT_GT(plane.n_cam.y(), 0.99);
  // The nose is down by 0.03, so that the optical axis dips into the road and the downward normal
  // has a component along it.
  EXPECT_NEAR(plane.n_cam.z(), 0.03, 1e-3);
  // The right side is down by 0.01, so that x dips as well.
  EXPECT_NEAR(plane.n_cam.x(), 0.01, 1e-3);
  EXPECT_LT(plane.rms_m, 1e-6);
}

TEST(RoadPlane, FollowsAKnockFromTheFirstFrameAfterIt) {
  SynthConfig config = test::small_config("straight", 30);
  config.flat = true;
  config.drive.suspension = 0.0;
  config.drive.knock.at_s = 1.0;
  config.drive.knock.pitch_rad = 0.03;
  const Studio studio(config);
  const auto pitch_rad = [&](double time_s) {
    const PlaneTruth plane = road_plane(studio.terrain(), studio.drive().T_map_cam(time_s));
    EXPECT_NEAR(plane.height_m, 1.65, 1e-6);
    return std::asin(plane.n_cam.z());
  };
  // The whole exposure and readout of a frame lie on one side.
  for (const double off_s : {-0.04, 0.0, 0.04}) {
    EXPECT_NEAR(pitch_rad(studio.time_s(9) + off_s), 0.0, 1e-6);
    EXPECT_NEAR(pitch_rad(studio.time_s(10) + off_s), 0.03, 1e-6);
  }
}

TEST(RoadPlane, RenderedRoadPointsSatisfyIt) {
  SynthConfig config = test::small_config("straight", 30);
  config.drive.mount.pitch_rad = 0.02;
  const Studio studio(config);
  const double t = studio.time_s(12);
  const Se3 T_map_cam = studio.drive().T_map_cam(t);
  const PlaneTruth plane = road_plane(studio.terrain(), T_map_cam);
  FrameRenderer renderer(studio.world(), config.render);
  RenderedFrame frame;
  renderer.render(t, frame);
  double sum = 0.0;
  double square = 0.0;
  int n = 0;
  for (int v = 95; v < frame.height_px; ++v) {
    for (int u = 150; u < 450; ++u) {
      const std::size_t k = static_cast<std::size_t>(v * frame.width_px + u);
      if (frame.object[k] != FrameRenderer::kRoad) continue;
      const Vector3d p = static_cast<double>(frame.distance_m[k]) *
                         config.render.camera.unproject(Vector2d(u, v)).normalized();
      if (p.z() < 5.0 || p.z() > 20.0 || std::abs(p.x()) > 1.7) continue;
      const double e = plane.n_cam.dot(p) - plane.height_m;
      sum += e;
      square += e * e;
      ++n;
    }
  }
  ASSERT_GT(n, 1000);
  EXPECT_NEAR(sum / n, 0.0, 0.01);
  EXPECT_LT(std::sqrt(square / n), 0.02);
}

TEST(Labels, BoxesHoldExactlyTheObjectsPixels) {
  SynthConfig config = test::small_config("city", 60);
  config.scene.traffic = 4;
  const Studio studio(config);
  const double t = studio.time_s(8);
  FrameRenderer renderer(studio.world(), config.render);
  RenderedFrame frame;
  renderer.render(t, frame);
  const std::vector<Label> labels =
      make_labels(frame, renderer.visible(), config.render.camera, studio.drive().T_map_cam(t), 20);
  ASSERT_FALSE(labels.empty());
  std::map<std::int32_t, Label> by_object;
  for (const Label& label : labels) by_object[label.object] = label;
  std::map<std::int32_t, std::array<int, 4>> extent;
  for (int v = 0; v < frame.height_px; ++v) {
    for (int u = 0; u < frame.width_px; ++u) {
      const std::int32_t object = frame.object[static_cast<std::size_t>(v * frame.width_px + u)];
      if (object < 0 || by_object.count(object) == 0) continue;
      const Label& label = by_object[object];
      EXPECT_GE(u + 1.0, label.left_px);
      EXPECT_LE(u - 1.0, label.right_px);
      EXPECT_GE(v + 1.0, label.top_px);
      EXPECT_LE(v - 1.0, label.bottom_px);
      auto [it, fresh] = extent.try_emplace(object, std::array<int, 4>{u, v, u, v});
      it->second = {std::min(it->second[0], u), std::min(it->second[1], v),
                    std::max(it->second[2], u), std::max(it->second[3], v)};
    }
  }
  int tight = 0;
  for (const Label& label : labels) {
    if (label.occluded != 0 || label.truncated != 0) continue;
    const auto& e = extent[label.object];
    const double slack = 2.5 + 0.08 * (label.bottom_px - label.top_px);  // a fifth may be hidden
    EXPECT_NEAR(label.left_px, e[0], slack);
    EXPECT_NEAR(label.top_px, e[1], slack);
    EXPECT_NEAR(label.right_px, e[2], slack);
    EXPECT_NEAR(label.bottom_px, e[3], slack);
    ++tight;
  }
  EXPECT_GT(tight, 0);
}

TEST(Labels, BottomCentreProjectsIntoTheBoxAndRowsHaveSeventeenFields) {
  SynthConfig config = test::small_config("straight", 60);
  config.scene.lead = "truck";
  const Studio studio(config);
  const double t = studio.time_s(8);
  FrameRenderer renderer(studio.world(), config.render);
  RenderedFrame frame;
  renderer.render(t, frame);
  bool found = false;
  for (const Label& label : make_labels(frame, renderer.visible(), config.render.camera,
                                        studio.drive().T_map_cam(t), 20)) {
    const std::string row = label_row(8, label);
    EXPECT_EQ(std::count(row.begin(), row.end(), ' '), 16) << row;
    if (label.kind != VehicleKind::kTruck || label.truncated != 0) continue;
    found = true;
    // It drives ahead of us, so it looks along our optical axis, where rotation_y is -pi/2.
    EXPECT_NEAR(label.rotation_y_rad, -1.5708, 0.1);
    const Vector2d foot = config.render.camera.project(label.p_cam);
    EXPECT_GT(foot.x(), label.left_px);
    EXPECT_LT(foot.x(), label.right_px);
    EXPECT_LT(foot.y(), label.bottom_px + 1.0);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace plumb::synth
