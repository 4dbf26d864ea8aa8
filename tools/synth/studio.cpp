#include "tools/synth/studio.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

constexpr double kTubeGain = 4.0;     ///< by which the exposure opens in a tube
constexpr double kExposureLag = 0.8;  ///< [s]
constexpr double kLeadIn = 0.1;  ///< [s] before the first frame, so that its exposure has a past

/// Says why a route has no lane for a wall of trucks.
void refuse_missing_lanes(const Route& route, const CompanyConfig& company) {
  const bool left = company.wall == "left" || company.wall == "both";
  const bool right = company.wall == "right" || company.wall == "both";
  if ((left && route.setting.lanes_left == 0) || (right && route.setting.lanes_right == 0))
    throw UsageError("--wall " + company.wall + ": route '" + route.name +
                     "' has no such lane; freeway and jam have both");
}

Route make_route(const SynthConfig& config) {
  const double duration_s = config.frames / config.rate_hz + kLeadIn + 0.5;
  Route route = config.poses.empty() ? make_builtin_route(config.route, duration_s, config.seed)
                                     : make_pose_route(config.poses, config.first_row,
                                                       config.last_row, config.source_rate_hz,
                                                       config.drive.mount.ahead_m, config.seed);
  route.flat = config.flat;
  const double travelled = route.schedule.s_m.back() - route.start_m;
  for (int i = 0; i < config.bumps; ++i) {
    route.bumps.push_back({route.start_m + 15.0 + (i + 0.5) * travelled / config.bumps, 0.08, 1.8});
  }
  refuse_missing_lanes(route, config.scene.company);
  return route;
}

Tube placed(const Tube& tube, double start_m) {
  return tube.empty() ? tube : Tube{start_m + tube.from_m, start_m + tube.to_m};
}

/// The exposure's span in a tube: begins to open when we are in, and closes when we leave.
DarkSpan exposure_in_tube(const Tube& tube, const Route& route) {
  if (tube.empty()) return {};
  const std::vector<double>& s = route.schedule.s_m;
  const auto time_at = [&](double s_m) {
    const auto found = std::lower_bound(s.begin(), s.end(), route.start_m + s_m);
    return Schedule::kTimeStep * static_cast<double>(found - s.begin()) - kLeadIn;
  };
  return {time_at(tube.from_m), time_at(tube.to_m) + kExposureLag, kTubeGain, kExposureLag};
}

/// The time of the knock: half a frame before the first frame at or after the wanted time, so that
/// no exposure and no readout sees the knock itself.
DriveConfig knocked_between_frames(const SynthConfig& config) {
  DriveConfig drive = config.drive;
  if (drive.knock.at_s <= 0.0) return drive;
  const double first_frame = std::ceil(drive.knock.at_s * config.rate_hz - 1e-9);
  drive.knock.at_s = (first_frame - 0.5) / config.rate_hz + kLeadIn;
  return drive;
}

}  // namespace

double DarkSpan::factor(double time_s) const {
  if (to_s <= from_s) return 1.0;
  const double ramp = std::max(fade_s, 1e-9);
  const double inside =
      std::clamp(std::min((time_s - from_s) / ramp, (to_s - time_s) / ramp), 0.0, 1.0);
  return 1.0 + inside * (light - 1.0);
}

Studio::Studio(const SynthConfig& config)
    : config_(config),
      route_(make_route(config)),
      terrain_(route_),
      drive_(terrain_, knocked_between_frames(config)),
      scene_(terrain_, drive_, config.scene),
      textures_(config.seed),
      lighting_(config.light, textures_),
      ground_(terrain_, textures_, config.ground),
      lamps_(terrain_, placed(config.scene.tube, route_.start_m), scene_.lamps(),
             config.light.night),
      tube_exposure_(exposure_in_tube(config.scene.tube, route_)),
      attached_(config.attached, textures_, config.render.camera.width_px,
                config.render.camera.height_px) {
  still_shadows_.build(scene_.still(), lighting_.to_sun(), 2.0);
}

int Studio::num_frames() const {
  const int lasting =
      static_cast<int>(std::floor((drive_.duration_s() - kLeadIn - 0.05) * config_.rate_hz)) + 1;
  return std::min(config_.frames, lasting);
}

}  // namespace plumb::synth
