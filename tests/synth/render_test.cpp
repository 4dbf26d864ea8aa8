#include "tools/synth/renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth/small_studio.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

RenderedFrame render(const Studio& studio, double time_s) {
  FrameRenderer renderer(studio.world(), studio.config().render);
  RenderedFrame frame;
  renderer.render(time_s, frame);
  return frame;
}

/// Computes the place in the map that a pixel shows, from the camera model alone.
Vector3d place_of(const RenderedFrame& frame, const CameraModel& camera, const Se3& T_map_cam,
                  int u, int v) {
  const double distance =
      static_cast<double>(frame.distance_m[static_cast<std::size_t>(v * frame.width_px + u)]);
  return T_map_cam * Vector3d(distance * camera.unproject(Vector2d(u, v)).normalized());
}

double bilinear(const RenderedFrame& frame, const Vector2d& px) {
  const int u = static_cast<int>(px.x());
  const int v = static_cast<int>(px.y());
  const double fx = px.x() - u;
  const double fy = px.y() - v;
  const auto at = [&](int x, int y) {
    return static_cast<double>(frame.radiance[static_cast<std::size_t>(y * frame.width_px + x)]);
  };
  return (1.0 - fy) * ((1.0 - fx) * at(u, v) + fx * at(u + 1, v)) +
         fy * ((1.0 - fx) * at(u, v + 1) + fx * at(u + 1, v + 1));
}

TEST(Renderer, RoadPixelsLieOnTheTerrainWithDistortionAndRollingShutter) {
  SynthConfig config = test::small_config("straight", 40);
  config.render.camera.residual_k1 = 0.02;
  config.render.readout_s = 0.02;
  const Studio studio(config);
  const double t = studio.time_s(20);
  const RenderedFrame frame = render(studio, t);
  int road = 0;
  for (int v = 100; v < frame.height_px; v += 7) {
    const double row_time = t + 0.02 * (v / (frame.height_px - 1.0) - 0.5);
    const Se3 T_map_cam = studio.drive().T_map_cam(row_time);
    for (int u = 3; u < frame.width_px; u += 11) {
      if (frame.object[static_cast<std::size_t>(v * frame.width_px + u)] != FrameRenderer::kRoad)
        continue;
      const Vector3d p = place_of(frame, config.render.camera, T_map_cam, u, v);
      EXPECT_NEAR(p.z(), studio.terrain().height(p.x(), p.y()), 2e-3) << u << ' ' << v;
      ++road;
    }
  }
  EXPECT_GT(road, 100);
}

/// The place of a lane line is known. Its middle must be where the camera model projects it.
TEST(Renderer, LaneLineIsWhereItProjects) {
  SynthConfig config = test::small_config("motorway", 30);
  config.flat = true;
  config.render.plain = true;
  config.render.exposure_s = 0.0;
  config.render.edge_samples = 16;
  config.ground.road_contrast = 0.0;
  config.ground.marking_wear = 0.0;
  config.render.camera.residual_k1 = -0.01;
  const Studio studio(config);
  const double t = studio.time_s(10);
  const RenderedFrame frame = render(studio, t);
  const Se3 T_cam_map = studio.drive().T_map_cam(t).inverse();
  const double from_s = studio.drive().state(t).s_m;
  int measured = 0;
  for (double ahead = 8.0; ahead < 25.0; ahead += 1.0) {
    const RoutePoint at = studio.terrain().route().at(from_s + ahead);
    const Vector2d left(-std::sin(at.yaw_rad), std::cos(at.yaw_rad));
    const auto project = [&](double d) {
      const Vector2d p = at.p_map + d * left;
      return config.render.camera.project(T_cam_map * Vector3d(p.x(), p.y(), 0.0));
    };
    const Vector2d middle = project(-2.1);
    const Vector2d side = project(-2.9);
    const Vector2d step = (side - middle).normalized();
    if (middle.x() < 20 || middle.x() > frame.width_px - 20 || middle.y() > frame.height_px - 4)
      continue;
    double weight = 0.0;
    double sum = 0.0;
    const double background = bilinear(frame, middle + 8.0 * step);
    for (double x = -6.0; x <= 6.0; x += 0.05) {
      const double w = std::max(0.0, bilinear(frame, middle + x * step) - background);
      weight += w;
      sum += w * x;
    }
    if (weight < 0.5) continue;
    EXPECT_NEAR(sum / weight, 0.0, 0.2) << "at " << ahead << " m";
    ++measured;
  }
  EXPECT_GT(measured, 6);
}

TEST(Renderer, SuccessiveFramesOfAFlatRoadWarpByThePlaneHomography) {
  SynthConfig config = test::small_config("straight", 40);
  config.flat = true;
  config.render.plain = true;
  config.render.exposure_s = 0.0;
  config.ground.marking_wear = 0.0;
  const Studio studio(config);
  const double t0 = studio.time_s(20);
  const double t1 = studio.time_s(21);
  const RenderedFrame a = render(studio, t0);
  const RenderedFrame b = render(studio, t1);
  const PlaneTruth plane = road_plane(studio.terrain(), studio.drive().T_map_cam(t1));
  const Se3 T_a_b = studio.drive().T_map_cam(t0).inverse() * studio.drive().T_map_cam(t1);
  // One Gauss-Newton step finds a common shift in a. Dividing by the mean removes the gain.
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Vector2d g = Vector2d::Zero();
  int used = 0;
  for (int v = 112; v < 180; ++v) {
    for (int u = 200; u < 400; ++u) {
      if (b.object[static_cast<std::size_t>(v * b.width_px + u)] != FrameRenderer::kRoad) continue;
      const Vector3d ray = config.render.camera.unproject(Vector2d(u, v));
      const Vector3d p_b = ray * (plane.height_m / plane.n_cam.dot(ray));
      const Vector2d px = config.render.camera.project(T_a_b * p_b);
      if (px.x() < 2 || px.y() < 2 || px.x() > a.width_px - 3 || px.y() > a.height_px - 3) continue;
      if (a.object[static_cast<std::size_t>(static_cast<int>(px.y()) * a.width_px +
                                            static_cast<int>(px.x()))] != FrameRenderer::kRoad)
        continue;
      const Vector2d gradient(bilinear(a, px + Vector2d(1, 0)) - bilinear(a, px - Vector2d(1, 0)),
                              bilinear(a, px + Vector2d(0, 1)) - bilinear(a, px - Vector2d(0, 1)));
      const double residual =
          bilinear(a, px) -
          static_cast<double>(b.radiance[static_cast<std::size_t>(v * b.width_px + u)]);
      H += 0.25 * gradient * gradient.transpose();
      g += 0.5 * gradient * residual;
      ++used;
    }
  }
  ASSERT_GT(used, 3000);
  const Vector2d shift = H.inverse() * g;
  EXPECT_LT(shift.norm(), 0.1) << shift.transpose();
}

TEST(Renderer, MovingVehiclesAreWhereTheirPoseSays) {
  SynthConfig config = test::small_config("straight", 40);
  config.scene.lead = "car";
  const Studio studio(config);
  const double t = studio.time_s(15);
  FrameRenderer renderer(studio.world(), config.render);
  RenderedFrame frame;
  renderer.render(t, frame);
  const auto lead = static_cast<std::int32_t>(frame.objects.size() - 1);
  const ObjectPose& pose = frame.objects.back();
  const Se3 T_map_cam = studio.drive().T_map_cam(t);
  int pixels = 0;
  for (int v = 0; v < frame.height_px; ++v) {
    for (int u = 0; u < frame.width_px; ++u) {
      if (frame.object[static_cast<std::size_t>(v * frame.width_px + u)] != lead) continue;
      const Vector3d p =
          pose.T_map_object.inverse() * place_of(frame, config.render.camera, T_map_cam, u, v);
      EXPECT_LT(std::abs(p.x()), 0.5 * pose.size_m.x() + 0.02);
      EXPECT_LT(std::abs(p.y()), 0.5 * pose.size_m.y() + 0.03);
      EXPECT_LT(p.z(), pose.size_m.z() + 0.02);
      EXPECT_GT(p.z(), -0.02);
      ++pixels;
    }
  }
  EXPECT_GT(pixels, 200);
}

TEST(Renderer, LongExposureBlursANearRoad) {
  const auto detail = [](double exposure_s) {
    SynthConfig config = test::small_config("motorway", 20);
    config.render.exposure_s = exposure_s;
    config.render.plain = true;
    const Studio studio(config);
    const RenderedFrame frame = render(studio, studio.time_s(10));
    double sum = 0.0;
    for (int v = 150; v < 185; ++v) {
      for (int u = 280; u < 330; ++u) {
        const std::size_t k = static_cast<std::size_t>(v * frame.width_px + u);
        sum += std::abs(static_cast<double>(
            frame.radiance[k + static_cast<std::size_t>(frame.width_px)] - frame.radiance[k]));
      }
    }
    return sum;
  };
  EXPECT_LT(detail(0.02), 0.6 * detail(0.0));
}

}  // namespace
}  // namespace plumb::synth
