#include "tools/synth/drive.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

constexpr double kWheelbase = 2.7;
constexpr double kTrack = 1.55;
constexpr double kPitchPerAccel = 0.0042;  ///< [rad per m/s2] dive and squat: 0.24 degrees
constexpr double kRollPerAccel = 0.0052;   ///< [rad per m/s2] lean in bends: 0.3 degrees
constexpr double kRoughStep = 0.05;        ///< [m]

/// A spring that follows its reference as a system of second order.
struct Spring {
  double omega;
  double damping;
  double value = 0.0;
  double rate = 0.0;

  void step(double reference, double reference_rate, double dt) {
    rate += dt *
            (omega * omega * (reference - value) + 2.0 * damping * omega * (reference_rate - rate));
    value += dt * rate;
  }
};

/// Makes the unevenness under one wheel track. Its slope is white, because the spectrum of ISO 8608
/// falls with the square of the frequency. A leak bounds the height.
std::vector<double> rough_track(double length_m, double scale, const std::vector<double>& shared,
                                Random& random) {
  constexpr double kSlopeSigma = 0.015;  // per 5 cm: Gd(n0) = 57e-6 m3, class B
  constexpr double kLeak = kRoughStep / 7.0;
  std::vector<double> z{0.0};
  const auto samples = static_cast<std::size_t>(length_m / kRoughStep) + 2;
  while (z.size() < samples) {
    const double slope = 0.8 * shared[z.size()] + 0.6 * random.normal();
    z.push_back(z.back() * (1.0 - kLeak) + scale * kSlopeSigma * kRoughStep * slope);
  }
  return z;
}

double sample_track(const std::vector<double>& z, double s_m) {
  const double x = std::clamp(s_m / kRoughStep, 0.0, static_cast<double>(z.size()) - 1.001);
  const auto i = static_cast<std::size_t>(x);
  return z[i] + (x - static_cast<double>(i)) * (z[i + 1] - z[i]);
}

/// Heave, pitch and roll that follow from the heights of four wheels.
struct Stance {
  double z_m = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

Stance stance_of(
    const std::array<double, 4>& z) {  // front left, front right, rear left, rear right
  const double front = 0.5 * (z[0] + z[1]);
  const double rear = 0.5 * (z[2] + z[3]);
  return {0.5 * (front + rear), -(front - rear) / kWheelbase,
          0.5 * (z[0] + z[2] - z[1] - z[3]) / kTrack};
}

Stance ground_stance(const Terrain& terrain, const RoutePoint& rear_axle) {
  const double c = std::cos(rear_axle.yaw_rad);
  const double s = std::sin(rear_axle.yaw_rad);
  const auto wheel = [&](double x, double y) {
    return terrain.height(rear_axle.p_map.x() + c * x - s * y, rear_axle.p_map.y() + s * x + c * y);
  };
  const double half = 0.5 * kTrack;
  return stance_of(
      {wheel(kWheelbase, half), wheel(kWheelbase, -half), wheel(0.0, half), wheel(0.0, -half)});
}

struct Roughness {
  std::vector<double> left;
  std::vector<double> right;

  Roughness(double length_m, double scale, std::uint64_t seed) {
    Random random(hash_keys(seed, 0x5a5a));
    std::vector<double> shared(static_cast<std::size_t>(length_m / kRoughStep) + 4);
    for (double& value : shared) value = random.normal();
    left = rough_track(length_m, scale, shared, random);
    right = rough_track(length_m, scale, shared, random);
  }
  [[nodiscard]] Stance at(double s_m) const {
    return stance_of({sample_track(left, s_m + kWheelbase), sample_track(right, s_m + kWheelbase),
                      sample_track(left, s_m), sample_track(right, s_m)});
  }
};

Se3 mount_transform(const MountConfig& mount) {
  Eigen::Matrix3d R_veh_axes;  // cam axes in veh when nothing is tilted
  R_veh_axes << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  const Eigen::Matrix3d tilt = exp_so3({0.0, 0.0, mount.yaw_rad}) *
                               exp_so3({0.0, mount.pitch_rad, 0.0}) *
                               exp_so3({mount.roll_rad, 0.0, 0.0});
  return {tilt * R_veh_axes, {mount.ahead_m, 0.0, mount.height_m}};
}

MountConfig knocked(MountConfig mount, const KnockConfig& knock) {
  mount.pitch_rad += knock.pitch_rad;
  mount.roll_rad += knock.roll_rad;
  mount.yaw_rad += knock.yaw_rad;
  return mount;
}

VehicleState mix(const VehicleState& a, const VehicleState& b, double f) {
  const auto m = [f](double x, double y) { return x + f * (y - x); };
  return {m(a.s_m, b.s_m),
          m(a.speed_m_s, b.speed_m_s),
          m(a.accel_m_s2, b.accel_m_s2),
          m(a.yaw_rate_rad_s, b.yaw_rate_rad_s),
          m(a.z_m, b.z_m),
          m(a.heave_m, b.heave_m),
          m(a.pitch_rad, b.pitch_rad),
          m(a.roll_rad, b.roll_rad)};
}

}  // namespace

Drive::Drive(const Terrain& terrain, const DriveConfig& config)
    : terrain_(&terrain),
      config_(config),
      T_veh_cam_(mount_transform(config.mount)),
      T_veh_cam_knocked_(mount_transform(knocked(config.mount, config.knock))) {
  integrate();
}

void Drive::integrate() {
  const Route& route = terrain_->route();
  const std::vector<double>& s = route.schedule.s_m;
  const double dt = Schedule::kTimeStep;
  const std::size_t n = s.size();
  const Roughness roughness(route.length_m(), route.setting.roughness * config_.suspension,
                            config_.seed);
  Spring heave{2.0 * std::numbers::pi * 1.25, 0.35};
  Spring pitch{2.0 * std::numbers::pi * 1.5, 0.35};
  Spring roll{2.0 * std::numbers::pi * 1.4, 0.3};
  Stance before;
  Stance ground_before;
  states_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = i > 0 ? i - 1 : 0;
    const std::size_t b = std::min(i + 1, n - 1);
    VehicleState& state = states_[i];
    state.s_m = s[i];
    state.speed_m_s = (s[b] - s[a]) / (static_cast<double>(b - a) * dt);
    state.accel_m_s2 = b == a + 2 ? (s[b] - 2.0 * s[i] + s[a]) / (dt * dt) : 0.0;
    const RoutePoint point = route.at(s[i]);
    const double path_rate_rad_s = point.curvature * state.speed_m_s;
    state.yaw_rate_rad_s = path_rate_rad_s + turntable_rate_rad_s(static_cast<double>(i) * dt);

    const Stance ground = ground_stance(*terrain_, point);
    const Stance rough = roughness.at(s[i]);
    const double lean = kRollPerAccel * path_rate_rad_s * state.speed_m_s;
    const double dive = -kPitchPerAccel * state.accel_m_s2;
    const Stance wish{ground.z_m + rough.z_m,
                      ground.pitch_rad + rough.pitch_rad + config_.suspension * dive,
                      ground.roll_rad + rough.roll_rad + config_.suspension * lean};
    if (i == 0 || config_.suspension <= 0.0) {
      heave.value = wish.z_m;
      pitch.value = wish.pitch_rad;
      roll.value = wish.roll_rad;
      if (i > 0) heave.rate = (ground.z_m - ground_before.z_m) / dt;
    } else {
      heave.step(wish.z_m, (wish.z_m - before.z_m) / dt, dt);
      pitch.step(wish.pitch_rad, (wish.pitch_rad - before.pitch_rad) / dt, dt);
      roll.step(wish.roll_rad, (wish.roll_rad - before.roll_rad) / dt, dt);
    }
    before = wish;
    ground_before = ground;
    state.z_m = heave.value;
    state.heave_m = heave.value - ground.z_m;
    state.pitch_rad = pitch.value;
    state.roll_rad = roll.value;
  }
}

double Drive::duration_s() const {
  return Schedule::kTimeStep * static_cast<double>(states_.size() - 1);
}

VehicleState Drive::state(double time_s) const {
  const double x =
      std::clamp(time_s / Schedule::kTimeStep, 0.0, static_cast<double>(states_.size()) - 1.001);
  const auto i = static_cast<std::size_t>(x);
  return mix(states_[i], states_[i + 1], x - static_cast<double>(i));
}

double Drive::turntable_rate_rad_s(double time_s) const {
  if (config_.turn_to_s <= config_.turn_from_s) return config_.yaw_rate_rad_s;
  if (time_s < config_.turn_from_s || time_s > config_.turn_to_s) return 0.0;
  const bool there = time_s < 0.5 * (config_.turn_from_s + config_.turn_to_s);
  return there ? config_.yaw_rate_rad_s : -config_.yaw_rate_rad_s;
}

double Drive::turntable_rad(double time_s) const {
  if (config_.turn_to_s <= config_.turn_from_s) return config_.yaw_rate_rad_s * time_s;
  const double t = std::clamp(time_s, config_.turn_from_s, config_.turn_to_s);
  return config_.yaw_rate_rad_s * std::min(t - config_.turn_from_s, config_.turn_to_s - t);
}

Se3 Drive::T_map_veh(double time_s) const {
  const VehicleState now = state(time_s);
  const RoutePoint rear_axle = terrain_->route().at(now.s_m);
  const double yaw = rear_axle.yaw_rad;
  Se3 T_map_veh;
  T_map_veh.R = exp_so3({0.0, 0.0, yaw}) * exp_so3({0.0, now.pitch_rad, 0.0}) *
                exp_so3({now.roll_rad, 0.0, 0.0});
  // Heave and pitch act at mid wheelbase; the reference point is under the rear axle.
  const Eigen::Vector3d middle(0.5 * kWheelbase, 0.0, 0.0);
  const Eigen::Vector3d level = exp_so3({0.0, 0.0, yaw}) * middle;
  T_map_veh.t = Eigen::Vector3d(rear_axle.p_map.x(), rear_axle.p_map.y(), now.z_m) + level -
                T_map_veh.R * middle;
  // The turntable turns the vehicle about its camera, which stays where it is.
  const Eigen::Matrix3d turn = exp_so3({0.0, 0.0, turntable_rad(time_s)});
  const Eigen::Vector3d centre = T_map_veh * T_veh_cam_.t;
  T_map_veh.R = turn * T_map_veh.R;
  T_map_veh.t = centre + turn * (T_map_veh.t - centre);
  return T_map_veh;
}

Se3 Drive::T_map_cam(double time_s) const {
  const bool is_knocked = config_.knock.at_s > 0.0 && time_s >= config_.knock.at_s;
  return T_map_veh(time_s) * (is_knocked ? T_veh_cam_knocked_ : T_veh_cam_);
}

}  // namespace plumb::synth
