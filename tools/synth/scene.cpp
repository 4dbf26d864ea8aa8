#include "tools/synth/scene.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

constexpr double kBehind = 60.0;  ///< [m] whoever drives along further behind is not seen
constexpr double kAhead = 330.0;  ///< [m]

}  // namespace

Scene::Scene(const Terrain& terrain, const Drive& drive, const SceneConfig& config)
    : terrain_(&terrain), drive_(&drive) {
  add_scenery(terrain, config.seed, still_, parked_);
  add_roadside(terrain, config.seed, still_);
  if (!config.tube.empty()) add_tube(terrain, config.tube, config.seed, still_, lamps_);
  if (config.street_lamps_m > 0.0)
    add_street_lamps(terrain, config.street_lamps_m, config.seed, still_, lamps_);
  plan_traffic(config);
}

void Scene::plan_traffic(const SceneConfig& config) {
  Random random(hash_keys(config.seed, 0x7aff));
  const Route& route = terrain_->route();
  const bool motorway = route.setting.guard_rail;
  if (config.lead != "none") {
    Mover lead;
    lead.kind = config.lead == "truck" ? VehicleKind::kTruck : VehicleKind::kCar;
    lead.seed = static_cast<std::uint32_t>(random.next());
    lead.leads = true;
    lead.headway_s = config.lead_headway_s;
    lead.s_m = config.lead_gap_m;
    movers_.push_back(lead);
  }
  const double travelled = route.schedule.s_m.back() - route.schedule.s_m.front();
  const double mean_speed = travelled / std::max(1.0, drive_->duration_s());
  for (int i = 0; i < config.traffic; ++i) {
    Mover mover;
    mover.kind = random.chance(motorway ? 0.25 : 0.08) ? VehicleKind::kTruck
                 : random.chance(0.15)                 ? VehicleKind::kVan
                                                       : VehicleKind::kCar;
    mover.seed = static_cast<std::uint32_t>(random.next());
    if (motorway) {
      const bool overtaking = random.chance(0.6) && mover.kind != VehicleKind::kTruck;
      mover.lateral_m = overtaking ? 3.7 : 0.0;
      mover.speed_m_s =
          mean_speed * (overtaking ? random.uniform(1.05, 1.25) : random.uniform(0.97, 1.02));
      mover.s_m = route.start_m + (overtaking ? random.uniform(-60.0, 60.0)
                                              : 35.0 + 45.0 * i + random.uniform(0.0, 15.0));
    } else {
      if (route.setting.tram_m > 0.0 && random.chance(0.35))
        mover.kind = random.chance(0.4) ? VehicleKind::kTram : VehicleKind::kBus;
      mover.lateral_m = std::min(route.setting.oncoming_m, route.setting.left_m - 1.4);
      mover.speed_m_s = -random.uniform(6.0, 12.0);
      // Spread so that they meet us over the whole drive.
      const double share = (i + random.uniform(0.1, 0.9)) / config.traffic;
      mover.s_m = route.start_m + 30.0 + share * (travelled + 10.0 * drive_->duration_s());
    }
    movers_.push_back(mover);
  }
  plan_company(route, config.company, drive_->duration_s(), config.lead != "none", config.seed,
               movers_);
  plan_people(route, config.company.people, travelled, config.seed, movers_);
}

ObjectPose Scene::pose_of(const Mover& mover, double time_s) const {
  const Route& route = terrain_->route();
  const auto along = [&](double t) { return distance_m(mover, *drive_, t); };
  const auto place = [&](double t) {
    const RoutePoint at = route.at(along(t));
    const Eigen::Vector2d left(-std::sin(at.yaw_rad), std::cos(at.yaw_rad));
    return Eigen::Vector2d(at.p_map + mover.lateral_m * left);
  };
  ObjectPose pose;
  pose.kind = mover.kind;
  pose.size_m = vehicle_size(mover.kind, mover.seed);
  const bool towards_us = mover.speed_m_s < 0.0 && !mover.along;
  const double yaw = route.at(along(time_s)).yaw_rad + (towards_us ? 3.14159265358979 : 0.0);
  pose.T_map_object = stand_on(*terrain_, place(time_s), yaw);
  pose.T_map_object.t.z() += mover.raised_m;
  constexpr double kDt = 0.02;
  const Eigen::Vector2d v = (place(time_s + kDt) - place(time_s - kDt)) / (2.0 * kDt);
  pose.velocity = {v.x(), v.y(), 0.0};
  return pose;
}

void Scene::moving(double time_s, std::vector<Primitive>& solids,
                   std::vector<ObjectPose>& objects) const {
  const double ours = drive_->state(time_s).s_m;
  for (const Mover& mover : movers_) {
    const ObjectPose pose = pose_of(mover, time_s);
    const double s = mover.leads ? 100.0 : distance_m(mover, *drive_, time_s);
    objects.push_back(pose);
    if (s < 8.0 || s > terrain_->route().length_m() - 8.0) continue;  // off the map
    if (mover.along && (s < ours - kBehind || s > ours + kAhead)) continue;
    add_vehicle(pose, mover.seed, static_cast<std::int32_t>(parked_.size() + objects.size() - 1),
                solids);
  }
}

}  // namespace plumb::synth
