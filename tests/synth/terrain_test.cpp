#include "tools/synth/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/synth/small_studio.hpp"
#include "tools/synth/ground_ray.hpp"

namespace plumb::synth {
namespace {

TEST(Terrain, LaneCentreIsItsDistanceFromTheEdge) {
  const Route route = make_builtin_route("city", 30.0, 3);
  const Terrain terrain(route);
  int checked = 0;
  for (double s = 60.0; s < 300.0; s += 1.7) {
    const RoutePoint p = route.at(s);
    const double edge = terrain.edge_distance(p.p_map.x(), p.p_map.y());
    EXPECT_LT(edge, -route.setting.right_m + 0.15) << s;
    const RoadCoordinate here = terrain.road_coordinate(p.p_map.x(), p.p_map.y());
    ASSERT_TRUE(here.valid);
    if (std::abs(here.s_m - s) > 20.0) continue;  // the route crosses itself here
    EXPECT_NEAR(here.d_m, 0.0, 0.05) << s;
    EXPECT_NEAR(here.s_m, s, 0.2);
    ++checked;
  }
  EXPECT_GT(checked, 50);
}

TEST(Terrain, RaysMeetTheSurfaceTheyShould) {
  const Route route = make_builtin_route("straight", 30.0, 4);
  const Terrain terrain(route);
  const RoutePoint at = route.at(route.start_m + 100.0);
  const Eigen::Vector3d eye(at.p_map.x(), at.p_map.y(),
                            terrain.height(at.p_map.x(), at.p_map.y()) + 1.65);
  GroundRays rays;
  rays.build(terrain, eye, at.yaw_rad, 0.9);
  int hits = 0;
  for (double tilt = 0.02; tilt < 0.3; tilt += 0.013) {
    for (double turn = -0.5; turn < 0.5; turn += 0.07) {
      const double yaw = at.yaw_rad + turn;
      const Ray ray{eye, Eigen::Vector3d(std::cos(yaw), std::sin(yaw), -tilt).normalized()};
      GroundHit hit;
      if (!rays.intersect(ray, hit)) continue;
      ++hits;
      const Eigen::Vector3d p = ray.origin + hit.t * ray.direction;
      const double edge = terrain.edge_distance(p.x(), p.y());
      if (hit.part == GroundPart::kRoad) {
        EXPECT_LE(edge, 1e-6);
        EXPECT_NEAR(p.z(), terrain.height(p.x(), p.y()), 1e-3);
      }
      if (hit.part == GroundPart::kKerbFace) {
        EXPECT_NEAR(edge, 0.0, 0.02);
      }
      // Nothing solid lies between, so that the ray stays above the road's level on its way.
      for (double t = 0.5; t < hit.t - 0.5; t += 0.5) {
        const Eigen::Vector3d q = ray.origin + t * ray.direction;
        ASSERT_GT(q.z(), terrain.height(q.x(), q.y()) - 1e-3);
      }
    }
  }
  EXPECT_GT(hits, 200);
}

TEST(Terrain, NothingStandsOnTheRoadEvenWhereARouteCrossesItself) {
  SynthConfig config = test::small_config("loop", 900);
  const Studio studio(config);
  ASSERT_GT(studio.scene().still().size(), 500U);
  for (const Primitive& solid : studio.scene().still()) {
    if (solid.object >= 0 || solid.shape == Shape::kLeaves)
      continue;  // parked vehicles and crowns may reach over
    const double edge = studio.terrain().edge_distance(solid.centre.x(), solid.centre.y());
    EXPECT_GT(edge, solid.material == Material::kMetal ? -0.2 : 0.3)
        << static_cast<int>(solid.material);
  }
}

}  // namespace
}  // namespace plumb::synth
