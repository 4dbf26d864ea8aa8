/// Vehicles and people around us: how each goes along the route.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/synth/drive.hpp"
#include "tools/synth/vehicle.hpp"

namespace plumb::synth {

/// How a moving vehicle goes along the route.
struct Mover {
  VehicleKind kind = VehicleKind::kCar;
  std::uint32_t seed = 0;
  double lateral_m = 0.0;  ///< left of the driven lane's centre
  bool leads = false;      ///< keeps ahead of us: goes where we are `headway_s` later, plus `s_m`
  bool along = false;      ///< drives as we do `headway_s` later, plus `s_m` and `speed_m_s`
  double headway_s = 0.0;
  double s_m = 0.0;        ///< at time zero, or the gap when it leads or drives along
  double speed_m_s = 0.0;  ///< along the route, negative when it comes towards us; relative to ours
                           ///< when it drives along
  double swing_m = 0.0;    ///< how far it drops back and catches up
  double swing_rad_s = 0.0;
  double swing_rad = 0.0;  ///< at time zero
  double raised_m = 0.0;   ///< above the road, on a pavement
};

/// Who drives along with us.
struct CompanyConfig {
  double dense_gap_m = 0.0;     ///< mean gap between vehicles on every lane of ours; 0 = none
  double trucks = 0.15;         ///< share of trucks among them
  std::string wall = "none";    ///< lanes beside ours full of trucks: none, left, right or both
  double wall_speed_m_s = 3.0;  ///< of these trucks, relative to ours
  int people = 0;               ///< on the pavements
};

/// The distance of a mover along the route.
[[nodiscard]] double distance_m(const Mover& mover, const Drive& drive, double time_s);

/// Plans those who drive along. `duration_s` is that of the drive, `leader` whether someone is
/// ahead of us already.
void plan_company(const Route& route, const CompanyConfig& config, double duration_s, bool leader,
                  std::uint64_t seed, std::vector<Mover>& movers);

/// Plans people on the pavements from the start of the route to `travelled_m` beyond.
void plan_people(const Route& route, int people, double travelled_m, std::uint64_t seed,
                 std::vector<Mover>& movers);

}  // namespace plumb::synth
