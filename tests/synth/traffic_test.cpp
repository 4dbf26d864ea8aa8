#include "tools/synth/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/synth/small_studio.hpp"

namespace plumb::synth {
namespace {

struct Freeway {
  Route route = make_builtin_route("freeway", 12.0, 5);
  Terrain terrain{route};
  Drive drive{terrain, DriveConfig{}};
};

std::map<int, std::vector<Mover>> by_lane(const std::vector<Mover>& movers) {
  std::map<int, std::vector<Mover>> lanes;
  for (const Mover& mover : movers)
    lanes[static_cast<int>(std::lround(mover.lateral_m / 3.7))].push_back(mover);
  return lanes;
}

TEST(Traffic, DenseTrafficDrivesAlongOnEveryLaneAndNobodyTouches) {
  const Freeway road;
  CompanyConfig config;
  config.dense_gap_m = 15.0;
  std::vector<Mover> movers;
  plan_company(road.route, config, 12.0, false, 5, movers);
  const auto lanes = by_lane(movers);
  ASSERT_EQ(lanes.size(), 4U);
  for (const auto& [lane, members] : lanes) {
    EXPECT_GT(members.size(), 5U) << lane;
    for (double t = 0.5; t < 11.0; t += 0.7) {
      double last_end = -1e9;
      for (const Mover& mover : members) {
        const double length = vehicle_size(mover.kind, mover.seed).x();
        const double s = distance_m(mover, road.drive, t);
        EXPECT_GT(s - 0.5 * length, last_end) << "lane " << lane << " at " << t;
        last_end = s + 0.5 * length;
        const double speed = (distance_m(mover, road.drive, t + 0.1) - s) / 0.1;
        EXPECT_NEAR(speed, road.drive.state(t).speed_m_s, 5.0);
        if (lane == 0) {
          EXPECT_GT(s - 0.5 * length, road.drive.state(t).s_m + 5.0);
        }
      }
    }
  }
}

TEST(Traffic, AWallOfTrucksPassesAtItsSpeed) {
  const Freeway road;
  CompanyConfig config;
  config.wall = "left";
  config.wall_speed_m_s = 6.0;
  std::vector<Mover> movers;
  plan_company(road.route, config, 12.0, false, 5, movers);
  const auto lanes = by_lane(movers);
  ASSERT_EQ(lanes.size(), 1U);
  EXPECT_EQ(lanes.begin()->first, 1);
  const auto ahead = [&](double t) {
    return std::count_if(movers.begin(), movers.end(), [&](const Mover& mover) {
      return distance_m(mover, road.drive, t) > road.drive.state(t).s_m + 8.0;
    });
  };
  EXPECT_EQ(ahead(0.0), 0);
  EXPECT_NEAR(static_cast<double>(ahead(11.0)), 66.0 / 22.5, 1.2);
}

TEST(Traffic, RoutesWithOneLaneRefuseAWall) {
  SynthConfig config = test::small_config("city", 5);
  config.scene.company.wall = "left";
  EXPECT_THROW(const Studio studio(config), UsageError);
}

TEST(Traffic, PeopleStayOnThePavement) {
  const Route route = make_builtin_route("inner-city", 10.0, 5);
  std::vector<Mover> movers;
  plan_people(route, 50, 80.0, 5, movers);
  ASSERT_EQ(movers.size(), 50U);
  for (const Mover& mover : movers) {
    const double beyond =
        std::max(mover.lateral_m - route.setting.left_m, -mover.lateral_m - route.setting.right_m);
    EXPECT_GT(beyond, 0.3);
    EXPECT_LT(beyond, route.setting.sidewalk_m);
  }
}

}  // namespace
}  // namespace plumb::synth
