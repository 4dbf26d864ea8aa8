#include "tools/synth/traffic.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

constexpr double kSeenBehind = 30.0;  ///< [m] a vehicle there may show when it overtakes
constexpr double kSeenAhead = 200.0;  ///< [m]

/// Where we are at a time, carried on with the last speed beyond either end of the drive.
double own_distance_m(const Drive& drive, double time_s) {
  const double inside = std::clamp(time_s, 0.0, drive.duration_s());
  const VehicleState state = drive.state(inside);
  return state.s_m + state.speed_m_s * (time_s - inside);
}

VehicleKind draw_kind(const Setting& setting, double trucks, Random& random) {
  const double dice = random.uniform();
  if (setting.tram_m > 0.0)
    return dice < 0.15 ? VehicleKind::kTram : dice < 0.4 ? VehicleKind::kBus : VehicleKind::kCar;
  if (dice < 0.5 * trucks) return VehicleKind::kArticulated;
  if (dice < trucks) return VehicleKind::kTruck;
  return random.chance(0.15) ? VehicleKind::kVan : VehicleKind::kCar;
}

/// Fills one lane with vehicles from `from_m` to `to_m`, which count from us.
template <typename Kind, typename Gap>
void fill_lane(const Mover& like, double from_m, double to_m, const Kind& kind, const Gap& gap_m,
               Random& random, std::vector<Mover>& movers) {
  for (double s = from_m; s < to_m;) {
    Mover mover = like;
    mover.kind = kind();
    mover.seed = static_cast<std::uint32_t>(random.next());
    const double length = vehicle_size(mover.kind, mover.seed).x();
    mover.s_m = s + 0.5 * length;
    mover.lateral_m += 0.15 * random.normal();
    mover.swing_rad_s = 6.283185307179586 / random.uniform(9.0, 20.0);
    mover.swing_rad = random.uniform(0.0, 6.283185307179586);
    movers.push_back(mover);
    s += length + gap_m();
  }
}

bool has_wall(const CompanyConfig& config, int lane) {
  if (config.wall == "both") return std::abs(lane) == 1;
  return (config.wall == "left" && lane == 1) || (config.wall == "right" && lane == -1);
}

void plan_wall(int lane, const Setting& setting, const CompanyConfig& config, double duration_s,
               Random& random, std::vector<Mover>& movers) {
  Mover like;
  like.along = true;
  like.lateral_m = lane * setting.lane_m;
  like.speed_m_s = config.wall_speed_m_s;
  like.swing_m = 0.4;
  const double reach = std::abs(like.speed_m_s) * duration_s;
  // Trucks that overtake begin behind our bumper, those that we overtake a little ahead.
  const double from = like.speed_m_s > 0.0 ? -kSeenBehind - reach : 15.0;
  const double to = like.speed_m_s > 0.0 ? 0.0 : kSeenAhead + reach;
  fill_lane(
      like, from, to, [] { return VehicleKind::kArticulated; },
      [&] { return random.uniform(4.0, 9.0); }, random, movers);
}

}  // namespace

double distance_m(const Mover& mover, const Drive& drive, double time_s) {
  if (mover.along) {
    return own_distance_m(drive, time_s + mover.headway_s) -
           own_distance_m(drive, mover.headway_s) + own_distance_m(drive, 0.0) + mover.s_m +
           mover.speed_m_s * time_s +
           mover.swing_m * std::sin(mover.swing_rad + mover.swing_rad_s * time_s);
  }
  if (!mover.leads) return mover.s_m + mover.speed_m_s * time_s;
  return drive.state(time_s + mover.headway_s).s_m + mover.s_m +
         0.5 * vehicle_size(mover.kind, mover.seed).x() + 3.0;
}

void plan_company(const Route& route, const CompanyConfig& config, double duration_s, bool leader,
                  std::uint64_t seed, std::vector<Mover>& movers) {
  const Setting& setting = route.setting;
  for (int lane = -setting.lanes_right; lane <= setting.lanes_left; ++lane) {
    Random random(hash_keys(seed, 0xde45, static_cast<std::uint64_t>(lane + 8)));
    if (has_wall(config, lane)) {
      plan_wall(lane, setting, config, duration_s, random, movers);
      continue;
    }
    if (config.dense_gap_m <= 0.0 || (lane == 0 && leader)) continue;
    Mover like;
    like.along = true;
    like.lateral_m = lane * setting.lane_m;
    // The further left, the faster; our own lane keeps its distance.
    like.speed_m_s = lane == 0 ? 0.0 : 0.7 * lane + random.uniform(-1.0, 1.0);
    like.headway_s = lane == 0 ? 0.4 : random.uniform(-1.5, 0.9);
    like.swing_m = std::min(1.5, 0.2 * config.dense_gap_m);
    const double reach = std::abs(like.speed_m_s) * duration_s;
    const double from = lane == 0 ? 3.0 + config.dense_gap_m * random.uniform(0.7, 1.2)
                                  : -kSeenBehind - reach + random.uniform(0.0, 10.0);
    const auto gap = [&] { return config.dense_gap_m * random.uniform(0.5, 1.5); };
    const auto kind = [&] { return draw_kind(setting, config.trucks, random); };
    fill_lane(like, from, kSeenAhead + reach, kind, gap, random, movers);
  }
}

void plan_people(const Route& route, int people, double travelled_m, std::uint64_t seed,
                 std::vector<Mover>& movers) {
  Random random(hash_keys(seed, 0x9e09));
  const Setting& setting = route.setting;
  for (int i = 0; i < people; ++i) {
    Mover mover;
    mover.kind = VehicleKind::kPerson;
    mover.seed = static_cast<std::uint32_t>(random.next());
    const double beside = random.uniform(0.4, std::max(0.5, setting.sidewalk_m - 0.4));
    mover.lateral_m = random.chance(0.5) ? setting.left_m + beside : -(setting.right_m + beside);
    mover.speed_m_s = (random.chance(0.5) ? 1.0 : -1.0) * random.uniform(0.9, 1.7);
    mover.s_m = route.start_m + random.uniform(0.0, travelled_m + 70.0);
    mover.raised_m = setting.kerb_m;
    movers.push_back(mover);
  }
}

}  // namespace plumb::synth
