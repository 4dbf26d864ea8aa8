#include "tools/synth/options.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <thread>
#include <tuple>
#include <utility>

#include "core/numbers.hpp"
#include "platform/command_line.hpp"
#include "tools/synth/random.hpp"
#include "tools/synth/route.hpp"

namespace plumb::synth {
namespace {

constexpr double kUnset = 1e8;

void parse_size(const std::string& text, CameraModel& camera) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 ||
      height < 48 || width > 4096 || height > 3072) {
    throw UsageError("--size " + text + " is not WIDTHxHEIGHT between 64x48 and 4096x3072");
  }
  camera.width_px = width;
  camera.height_px = height;
}

/// The two numbers of FROM:TO; equal when the text is empty.
std::pair<double, double> parse_span(const char* option, const std::string& text,
                                     const char* unit) {
  double from = 0.0;
  double to = 0.0;
  if (text.empty()) return {from, to};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf:%lf%c", &from, &to, &rest) != 2 || from < 0.0 || to <= from) {
    throw UsageError(std::string(option) + " " + text + " is not FROM:TO in " + unit);
  }
  return {from, to};
}

DarkSpan parse_dark_span(const char* option, const std::string& text, double light, double fade_s) {
  const auto [from, to] = parse_span(option, text, "seconds");
  return {from, to, light, fade_s};
}

std::vector<std::string> route_names() {
  std::vector<std::string> names;
  for (const auto& [name, text] : builtin_routes()) names.push_back(name);
  return names;
}

void declare_drive(CommandLine& app, Options& o) {
  SynthConfig& c = o.config;
  app.add_option("--route", c.route, "built-in route (--list-routes)")
      .check(one_of(route_names()))
      .type_name("NAME")
      .capture_default_str();
  app.add_option("--poses", c.poses, "KITTI pose file to drive along instead of a route");
  app.add_option("--start", c.first_row, "first row of the pose file")
      .check(at_least(0))
      .capture_default_str();
  app.add_option("--end", c.last_row, "last row of the pose file, -1 = its end")
      .capture_default_str();
  app.add_option("--source-rate", c.source_rate_hz, "rows per second of the pose file")
      .check(within(1.0, 200.0))
      .capture_default_str();
  app.add_option("--frames", c.frames, "frames to render (less when the pose file is shorter)")
      .check(within(1, 100000))
      .capture_default_str();
  app.add_option("--rate", c.rate_hz, "frames per second")
      .check(within(1.0, 120.0))
      .capture_default_str();
  app.add_option("--seed", c.seed, "seed of everything random").capture_default_str();
  app.add_option("--suspension", c.drive.suspension,
                 "scale of the motion on the springs, 0 = rigid")
      .check(within(0.0, 5.0))
      .capture_default_str();
  app.add_option("--turntable", c.drive.yaw_rate_rad_s,
                 "added rotation about the camera's vertical, rad/s")
      .check(within(-3.0, 3.0))
      .capture_default_str();
  app.add_option("--turntable-span", o.turntable_span,
                 "FROM:TO in s: turn and turn back in this time only [turn all the time]");
  app.add_option("--bumps", c.bumps, "number of speed bumps")
      .check(within(0, 100))
      .capture_default_str();
  app.add_flag("--flat", c.flat, "no slopes, no crown: the road is one plane");
  app.add_option("--traffic", c.scene.traffic, "number of moving vehicles")
      .check(within(0, 200))
      .capture_default_str();
  app.add_option("--lead", c.scene.lead, "vehicle ahead of us")
      .check(one_of({"none", "car", "truck"}))
      .capture_default_str();
  app.add_option("--lead-gap", c.scene.lead_gap_m, "distance to that vehicle at rest, m")
      .check(within(1.0, 100.0))
      .capture_default_str();
  app.add_option("--lead-headway", c.scene.lead_headway_s, "time headway of that vehicle, s")
      .check(within(0.0, 5.0))
      .capture_default_str();
}

void declare_company(CommandLine& app, Options& o) {
  SynthConfig& c = o.config;
  app.add_option("--dense", c.scene.company.dense_gap_m,
                 "mean gap between vehicles that drive along on every lane of ours, m; 0 = none")
      .check(within(0.0, 200.0))
      .capture_default_str();
  app.add_option("--dense-trucks", c.scene.company.trucks, "share of trucks among them")
      .check(within(0.0, 1.0))
      .capture_default_str();
  app.add_option("--wall", c.scene.company.wall, "lanes beside ours that are full of trucks")
      .check(one_of({"none", "left", "right", "both"}))
      .capture_default_str();
  app.add_option("--wall-speed", c.scene.company.wall_speed_m_s,
                 "speed of these trucks relative to ours, m/s")
      .check(within(-20.0, 20.0))
      .capture_default_str();
  app.add_option("--people", c.scene.company.people, "people on the pavements")
      .check(within(0, 500))
      .capture_default_str();
}

void declare_camera(CommandLine& app, Options& o) {
  SynthConfig& c = o.config;
  app.add_option("--size", o.size, "image size").capture_default_str();
  app.add_option("--focal", o.focal_px, "focal length in pixels, 0 = KITTI's field of view")
      .check(within(0.0, 10000.0))
      .capture_default_str();
  app.add_option("--camera-height", c.drive.mount.height_m,
                 "height of the camera above the road, m")
      .check(within(0.3, 4.0))
      .capture_default_str();
  app.add_option("--stated-height", c.stated_height_m,
                 "height that calib.txt claims, m; 0 = the true one")
      .check(within(0.0, 4.0))
      .capture_default_str();
  app.add_option("--mount-pitch", o.mount_pitch_deg,
                 "degrees nose down [drawn from the seed, standard deviation 0.5]")
      .check(within(-15.0, 15.0));
  app.add_option("--mount-roll", o.mount_roll_deg,
                 "degrees right side down [drawn from the seed, standard deviation 0.5]")
      .check(within(-15.0, 15.0));
  app.add_option("--mount-yaw", o.mount_yaw_deg,
                 "degrees to the left [drawn from the seed, standard deviation 0.3]")
      .check(within(-15.0, 15.0));
  app.add_option("--knock-at", c.drive.knock.at_s,
                 "time at which the camera is turned on its mount, s; 0 = never")
      .check(within(0.0, 10000.0))
      .capture_default_str();
  app.add_option("--knock-pitch", o.knock_pitch_deg, "angle of that turn, degrees nose down")
      .check(within(-15.0, 15.0))
      .capture_default_str();
  app.add_option("--knock-roll", o.knock_roll_deg, "angle of that turn, degrees right side down")
      .check(within(-15.0, 15.0))
      .capture_default_str();
  app.add_option("--knock-yaw", o.knock_yaw_deg, "angle of that turn, degrees to the left")
      .check(within(-15.0, 15.0))
      .capture_default_str();
}

void declare_attached(CommandLine& app, Options& o) {
  AttachedConfig& c = o.config.attached;
  app.add_option("--dashboard", c.dashboard, "share of the picture's height that it hides")
      .check(within(0.0, 0.6))
      .capture_default_str();
  app.add_option("--bonnet", c.bonnet, "the same of the bonnet, above the dashboard")
      .check(within(0.0, 0.4))
      .capture_default_str();
  app.add_option("--reflections", c.reflections,
                 "dashboard reflected in the windscreen; 1 = as bright as a dark road")
      .check(within(0.0, 5.0))
      .capture_default_str();
  app.add_flag("--stamp", o.config.stamp, "print a time stamp into the picture");
  app.add_option("--compression", o.config.compression,
                 "step of a video codec's quantiser, grey levels; 0 = none")
      .check(within(0.0, 100.0))
      .capture_default_str();
}

void declare_sensor(CommandLine& app, Options& o) {
  SynthConfig& c = o.config;
  app.add_option("--residual-k1", c.render.camera.residual_k1,
                 "radial distortion left in the images, of r^2")
      .check(within(-0.1, 0.1))
      .capture_default_str();
  app.add_option("--residual-k2", c.render.camera.residual_k2, "the same, of r^4")
      .check(within(-0.1, 0.1))
      .capture_default_str();
  app.add_option("--exposure", c.render.exposure_s, "exposure time, s: motion blur")
      .check(within(0.0, 0.1))
      .capture_default_str();
  app.add_option("--rolling-shutter", c.render.readout_s, "time from the first row to the last, s")
      .check(within(0.0, 0.1))
      .capture_default_str();
  app.add_option("--blur", c.sensor.blur_px, "lens blur, sigma in pixels")
      .check(within(0.0, 5.0))
      .capture_default_str();
  app.add_option("--gain", c.sensor.gain, "grey levels per unit of light")
      .check(within(1.0, 5000.0))
      .capture_default_str();
  app.add_option("--gamma", c.sensor.gamma,
                 "exponent of the tone curve; below 1 lifts what is dark")
      .check(within(0.2, 3.0))
      .capture_default_str();
  app.add_option("--noise", c.sensor.read_noise, "read noise, grey levels")
      .check(within(0.0, 50.0))
      .capture_default_str();
  app.add_option("--shot-noise", c.sensor.shot_noise, "noise variance per grey level")
      .check(within(0.0, 5.0))
      .capture_default_str();
  app.add_option("--vignetting", c.sensor.vignetting, "loss of light in the corners")
      .check(within(0.0, 0.9))
      .capture_default_str();
  app.add_option("--exposure-drift", c.sensor.gain_drift,
                 "slow drift of the exposure, standard deviation of its logarithm")
      .check(within(0.0, 1.0))
      .capture_default_str();
  app.add_option("--exposure-step", c.sensor.step_factor,
                 "factor by which the exposure jumps back and forth")
      .check(within(0.1, 10.0))
      .capture_default_str();
  app.add_option("--exposure-step-every", c.sensor.step_every_s,
                 "s between jumps; 0 = 4 s when --exposure-step is given")
      .check(within(0.0, 1000.0));
  app.add_option("--samples", c.render.edge_samples,
                 "extra rays per pixel where the picture changes")
      .check(within(0, 64))
      .capture_default_str();
}

void declare_weather(CommandLine& app, Options& o) {
  SynthConfig& c = o.config;
  app.add_option("--sun-elevation", o.sun_deg, "elevation of the sun, degrees")
      .check(within(2.0, 90.0))
      .capture_default_str();
  app.add_option("--sun-azimuth", o.sun_azimuth_deg,
                 "degrees to the left of the first heading [drawn from the seed]")
      .check(within(-360.0, 360.0));
  app.add_flag("--overcast", o.overcast, "no direct sun");
  app.add_option("--road-contrast", c.ground.road_contrast, "scale of the contrast of the asphalt")
      .check(within(0.0, 3.0))
      .capture_default_str();
  app.add_option("--marking-wear", c.ground.marking_wear, "0 fresh, 1 nearly gone")
      .check(within(0.0, 1.5))
      .capture_default_str();
  app.add_option("--wet", c.ground.wetness, "0 dry .. 1 covered by water")
      .check(within(0.0, 1.0))
      .capture_default_str();
  app.add_option("--haze", c.light.haze_m, "distance over which contrast falls to 1/e, m")
      .check(within(10.0, 1e6))
      .capture_default_str();
  app.add_option("--tunnel", o.tunnel, "FROM:TO in s: a tunnel with a tenth of the light");
  app.add_option("--tube", o.tube,
                 "FROM:TO in m of the drive: a tunnel with walls, a roof and lamps");
  app.add_flag("--night", o.night, "no sun and hardly any sky: headlights and lamps");
  app.add_option("--street-lamps", c.scene.street_lamps_m,
                 "distance between street lamps, m; 0 = none")
      .check(within(0.0, 500.0))
      .capture_default_str();
  app.add_option("--covered", o.covered, "FROM:TO in s: the lens is covered");
}

/// Takes the sun away, and at night the sky as well.
void darken(Options& o) {
  LightConfig& light = o.config.light;
  if (o.overcast) {
    light.sun = 0.0;
    light.sky = 1.3;
    light.clouds = 1.0;
  }
  if (o.night) {
    light.night = true;
    light.sun = 0.0;
    light.sky = 0.004;
  }
}

}  // namespace

void declare(CommandLine& app, Options& o) {
  o.config.sensor.step_factor = 1.0;
  app.add_option("--out", o.config.out, "folder to write, in KITTI odometry layout");
  app.add_option("--threads", o.threads, "workers, 0 = one per core")
      .check(within(0, 256))
      .capture_default_str();
  app.add_flag("--force", o.force,
               "write into a folder that is not empty, and replace a drive there");
  app.add_flag("--quiet", o.quiet, "print nothing");
  declare_drive(app, o);
  declare_company(app, o);
  declare_camera(app, o);
  declare_sensor(app, o);
  declare_attached(app, o);
  declare_weather(app, o);
}

void complete(Options& o) {
  SynthConfig& c = o.config;
  if (c.out.empty()) throw UsageError("--out DIR is required");
  CameraModel& camera = c.render.camera;
  parse_size(o.size, camera);
  camera.fx_px = o.focal_px > 0.0 ? o.focal_px : 721.5377 * camera.width_px / 1242.0;
  camera.fy_px = camera.fx_px;
  camera.cx_px = 0.4908 * camera.width_px;  // as in KITTI: not the middle
  camera.cy_px = 0.4609 * camera.height_px;
  camera.camera_height_m = c.drive.mount.height_m;
  if (c.last_row >= 0 && c.last_row <= c.first_row)
    throw UsageError("--end must be greater than --start");
  if (c.poses.empty() && (c.first_row != 0 || c.last_row != -1))
    throw UsageError("--start and --end go with --poses");
  c.tunnel = parse_dark_span("--tunnel", o.tunnel, 0.1, 0.4);
  c.covered = parse_dark_span("--covered", o.covered, 0.0, 0.05);
  std::tie(c.scene.tube.from_m, c.scene.tube.to_m) = parse_span("--tube", o.tube, "metres");
  std::tie(c.drive.turn_from_s, c.drive.turn_to_s) =
      parse_span("--turntable-span", o.turntable_span, "seconds");
  if (c.drive.knock.at_s <= 0.0 &&
      (o.knock_pitch_deg != 0.0 || o.knock_roll_deg != 0.0 || o.knock_yaw_deg != 0.0)) {
    throw UsageError("--knock-pitch, --knock-roll and --knock-yaw go with --knock-at");
  }
  if (c.sensor.step_factor != 1.0 && c.sensor.step_every_s <= 0.0) c.sensor.step_every_s = 4.0;

  Random random(hash_keys(c.seed, 0x3072));
  const auto tilt = [&](double wish_deg, double sigma_deg) {
    const double drawn = sigma_deg * random.normal();
    return kDegree * (std::abs(wish_deg) < kUnset ? wish_deg : drawn);
  };
  c.drive.mount.pitch_rad = tilt(o.mount_pitch_deg, 0.5);
  c.drive.mount.roll_rad = tilt(o.mount_roll_deg, 0.5);
  c.drive.mount.yaw_rad = tilt(o.mount_yaw_deg, 0.3);
  c.drive.knock.pitch_rad = kDegree * o.knock_pitch_deg;
  c.drive.knock.roll_rad = kDegree * o.knock_roll_deg;
  c.drive.knock.yaw_rad = kDegree * o.knock_yaw_deg;
  const double drawn_azimuth = random.uniform(0.0, 360.0);
  c.light.sun_azimuth_rad =
      kDegree *
      (o.sun_azimuth_deg >= 0.0 || o.sun_azimuth_deg < -1.0 ? o.sun_azimuth_deg : drawn_azimuth);
  c.light.sun_elevation_rad = kDegree * o.sun_deg;
  c.light.sky_tone = random.uniform(0.4, 1.0);
  c.light.clouds = random.uniform(0.0, 0.7);
  darken(o);
  c.drive.seed = c.seed;
  c.scene.seed = c.seed;
  c.ground.seed = c.seed;
  c.sensor.seed = c.seed;
  c.attached.seed = c.seed;
  if (o.threads == 0)
    o.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace plumb::synth
