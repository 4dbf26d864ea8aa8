#include "tools/synth/lamps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLampReach = 28.0;  ///< [m]
constexpr double kLampCell = 14.0;   ///< [m]
constexpr double kLampAhead = 3.5;   ///< [m] headlights before the rear axle
constexpr double kLampHeight = 0.66;
constexpr double kLampsApart = 1.3;

/// Strength of a low beam in a direction. Below the cut-off it falls so fast that the road is lit
/// evenly.
double beam(double forward, double left, double up) {
  if (forward <= 0.0) return 0.0;
  const double side = std::atan2(left, forward);
  const double rise = std::atan2(up, forward);
  const double even = std::pow(std::min(1.0, 0.02 / std::max(1e-6, std::abs(rise))), 2.2);
  const double cut = std::clamp(0.5 - (rise + 0.006) / 0.006, 0.02, 1.0);
  return 3000.0 * cut * even * std::exp(-std::pow(side / 0.35, 2));
}

}  // namespace

Lamps::Lamps(const Terrain& terrain, const Tube& tube, std::vector<Lamp> lamps, bool night)
    : terrain_(terrain), tube_(tube), lamps_(std::move(lamps)), night_(night) {
  if (lamps_.empty()) return;
  Vector2d low = lamps_.front().p_map.head<2>();
  Vector2d high = low;
  for (const Lamp& lamp : lamps_) {
    low = low.cwiseMin(lamp.p_map.head<2>());
    high = high.cwiseMax(lamp.p_map.head<2>());
  }
  origin_ = low.array() - kLampReach;
  nx_ = static_cast<int>((high.x() - low.x() + 2.0 * kLampReach) / kLampCell) + 1;
  ny_ = static_cast<int>((high.y() - low.y() + 2.0 * kLampReach) / kLampCell) + 1;
  cells_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const Vector2d at = (lamps_[i].p_map.head<2>() - origin_) / kLampCell;
    const int reach = static_cast<int>(std::ceil(kLampReach / kLampCell));
    for (int y = static_cast<int>(at.y()) - reach; y <= static_cast<int>(at.y()) + reach; ++y) {
      for (int x = static_cast<int>(at.x()) - reach; x <= static_cast<int>(at.x()) + reach; ++x) {
        if (x < 0 || y < 0 || x >= nx_ || y >= ny_) continue;
        cells_[static_cast<std::size_t>(y * nx_ + x)].push_back(static_cast<int>(i));
      }
    }
  }
}

const std::vector<int>* Lamps::near(double x, double y) const {
  const int cx = static_cast<int>(std::floor((x - origin_.x()) / kLampCell));
  const int cy = static_cast<int>(std::floor((y - origin_.y()) / kLampCell));
  if (cx < 0 || cy < 0 || cx >= nx_ || cy >= ny_) return nullptr;
  return &cells_[static_cast<std::size_t>(cy * nx_ + cx)];
}

double Lamps::headlights(const Reflectance& surface, const Patch& patch,
                         const Se3& T_map_veh) const {
  const Vector3d p_veh = T_map_veh.R.transpose() * (patch.p_map - T_map_veh.t);
  const Vector3d n_veh = T_map_veh.R.transpose() * surface.n_map;
  double sum = 0.0;
  for (const double side : {-0.5, 0.5}) {
    const Vector3d to = p_veh - Vector3d(kLampAhead, side * kLampsApart, kLampHeight);
    const double d2 = to.squaredNorm() + 1.0;
    const double facing = std::max(0.0, -n_veh.dot(to) / std::sqrt(d2));
    sum += beam(to.x(), to.y(), to.z()) * facing / d2;
  }
  return sum;
}

float Lamps::answer(const Reflectance& surface, const Patch& patch, const Se3& T_map_veh) const {
  double light = night_ ? headlights(surface, patch, T_map_veh) : 0.0;
  if (const std::vector<int>* some = near(patch.p_map.x(), patch.p_map.y())) {
    for (const int i : *some) {
      const Lamp& lamp = lamps_[static_cast<std::size_t>(i)];
      const Vector3d to = lamp.p_map - patch.p_map;
      const double d2 = to.squaredNorm() + 0.5;
      if (d2 > kLampReach * kLampReach || to.z() <= 0.0) continue;
      const double d = std::sqrt(d2);
      const double edge = 1.0 - d2 / (kLampReach * kLampReach);
      light += lamp.strength * std::max(0.0, surface.n_map.dot(to) / d) * (to.z() / d) * edge / d2;
    }
  }
  const double glow = surface.always_glows || night_ ? static_cast<double>(surface.glow) : 0.0;
  return static_cast<float>(static_cast<double>(surface.albedo) * light + glow);
}

float Lamps::sky_share(const Vector3d& p_map) const {
  if (tube_.empty()) return 1.0F;
  const RoadCoordinate road = terrain_.road_coordinate(p_map.x(), p_map.y());
  if (!road.valid || road.s_m < tube_.from_m || road.s_m > tube_.to_m) return 1.0F;
  const Setting& setting = terrain_.route().setting;
  if (road.d_m > setting.left_m + kTubeWall || road.d_m < -setting.right_m - kTubeWall) return 1.0F;
  const double inside = std::min(road.s_m - tube_.from_m, tube_.to_m - road.s_m);
  return static_cast<float>(0.03 + 0.5 * std::exp(-inside / 7.0));
}

}  // namespace plumb::synth
