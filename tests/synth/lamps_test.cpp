#include "tools/synth/lamps.hpp"

#include <gtest/gtest.h>

#include "tests/synth/small_studio.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector3d;

Patch road_patch(const Terrain& terrain, double x, double y) {
  return {
      {x, y, terrain.height(x, y)}, Vector3d::UnitZ(), Vector3d::UnitX(), 0.01, Vector3d::Zero()};
}

class LampsTest : public testing::Test {
 protected:
  LampsTest() : route_(flat_route()), terrain_(route_) {}

  static Route flat_route() {
    Route route = make_builtin_route("straight", 20.0, 3);
    route.flat = true;
    return route;
  }
  /// A place on the lane's centre.
  [[nodiscard]] Patch on_lane(double s_m) const {
    const RoutePoint p = route_.at(s_m);
    return road_patch(terrain_, p.p_map.x(), p.p_map.y());
  }

  Route route_;
  Terrain terrain_;
};

TEST_F(LampsTest, HeadlightsLightTheRoadAheadAndNothingBehindOrAbove) {
  const Lamps lamps(terrain_, {}, {}, true);
  Reflectance road;
  road.albedo = 0.15F;
  const Se3 T_map_veh;  // at the origin, along x
  const auto light = [&](double x, double z) {
    Patch patch = road_patch(terrain_, x, 0.0);
    patch.p_map.z() = z;
    return lamps.answer(road, patch, T_map_veh);
  };
  EXPECT_GT(light(15.0, 0.0), 0.01F);
  EXPECT_GT(light(15.0, 0.0), 3.0F * light(50.0, 0.0));
  EXPECT_EQ(light(-10.0, 0.0), 0.0F);
  road.n_map = -Vector3d::UnitX();  // a wall that faces us
  EXPECT_GT(light(25.0, 0.4), 10.0F * light(25.0, 4.0)) << "the beam has a cut-off";
}

TEST_F(LampsTest, AStreetLampLightsWhatIsBelowItByDayAsWell) {
  const Patch below = on_lane(100.0);
  const Lamps lamps(terrain_, {}, {{below.p_map + Vector3d(0.0, 0.0, 8.0), 20.0}}, false);
  Reflectance road;
  EXPECT_GT(lamps.answer(road, below, Se3{}), 3.0F * lamps.answer(road, on_lane(115.0), Se3{}));
  EXPECT_EQ(lamps.answer(road, on_lane(160.0), Se3{}), 0.0F);
}

TEST_F(LampsTest, TheTubeKeepsTheSkyOut) {
  const Lamps lamps(terrain_, {100.0, 200.0}, {}, false);
  EXPECT_EQ(lamps.sky_share(on_lane(90.0).p_map), 1.0F);
  EXPECT_LT(lamps.sky_share(on_lane(150.0).p_map), 0.05F);
  EXPECT_GT(lamps.sky_share(on_lane(102.0).p_map), 0.2F) << "light falls in at the portal";
}

TEST(Tube, HidesTheSkyOnceWeAreInside) {
  SynthConfig config = test::small_config("motorway", 80);
  config.scene.tube = {30.0, 400.0};
  const Studio studio(config);
  FrameRenderer renderer(studio.world(), config.render);
  RenderedFrame frame;
  const auto sky_pixels = [&](double t) {
    renderer.render(t, frame);
    int count = 0;
    for (int u = 0; u < frame.width_px; ++u)
      count += frame.distance_m[static_cast<std::size_t>(u)] == 0.0F ? 1 : 0;
    return count;
  };
  EXPECT_GT(sky_pixels(0.2), 500) << "in front of the portal";
  EXPECT_EQ(sky_pixels(4.0), 0) << "70 m inside";
  EXPECT_EQ(studio.tube_exposure(0.2), 1.0);
  EXPECT_GT(studio.tube_exposure(4.0), 3.0);
}

}  // namespace
}  // namespace plumb::synth
