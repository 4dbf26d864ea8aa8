#include "tests/ground/road_scene.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::test {
namespace {

/// Repeatable random value of a grid point, in [-1, 1].
double grid_value(int x, int z, std::uint32_t octave) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 374761393U +
                    static_cast<std::uint32_t>(z) * 668265263U + octave * 2246822519U;
  h = (h ^ (h >> 13U)) * 1274126177U;
  h ^= h >> 16U;
  return static_cast<double>(h & 0xffffU) / 32767.5 - 1.0;
}

double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

double value_noise(double x, double z, std::uint32_t octave) {
  const double fx = std::floor(x), fz = std::floor(z);
  const int ix = static_cast<int>(fx), iz = static_cast<int>(fz);
  const double a = smooth(x - fx), b = smooth(z - fz);
  const double near = (1 - a) * grid_value(ix, iz, octave) + a * grid_value(ix + 1, iz, octave);
  const double far =
      (1 - a) * grid_value(ix, iz + 1, octave) + a * grid_value(ix + 1, iz + 1, octave);
  return (1 - b) * near + b * far;
}

/// Octaves from 1 m down to 6 cm; those finer than a pixel's footprint fade out.
double texture(double x, double z, double footprint_m) {
  double value = 0.0;
  double wavelength = 1.0;
  for (std::uint32_t octave = 0; octave < 5; ++octave, wavelength *= 0.5) {
    const double ratio = footprint_m / wavelength;
    value += std::exp(-2.0 * ratio * ratio) * value_noise(x / wavelength, z / wavelength, octave);
  }
  return 110.0 + 25.0 * value;
}

/// Mean over 2n+1 neighbours along an axis with the given stride.
std::vector<double> box_blur(const std::vector<double>& from, int width, int height, int radius,
                             bool along_rows) {
  std::vector<double> to(from.size());
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      double sum = 0.0;
      for (int k = -radius; k <= radius; ++k) {
        const int x = along_rows ? std::clamp(u + k, 0, width - 1) : u;
        const int y = along_rows ? v : std::clamp(v + k, 0, height - 1);
        sum += from[static_cast<std::size_t>(y * width + x)];
      }
      to[static_cast<std::size_t>(v * width + u)] = sum / (2 * radius + 1);
    }
  }
  return to;
}

/// Mean grey value of what a pixel sees, before exposure.
double radiance(const CameraModel& camera, const Se3& T_world_cam, int u, int v) {
  const Eigen::Vector3d ray = T_world_cam.R * camera.unproject(Eigen::Vector2d(u, v));
  const double range = (kRoadHeight - T_world_cam.t.y()) / ray.y();
  if (!(ray.y() > 1e-3) || range > 80.0) return 200.0;
  const Eigen::Vector3d p = T_world_cam.t + range * ray;
  return texture(p.x(), p.z(), range / camera.fx_px * std::sqrt(1.0 / ray.y()));
}

}  // namespace

CameraModel scene_camera() {
  CameraModel camera;
  camera.width_px = 640;
  camera.height_px = 240;
  camera.fx_px = camera.fy_px = 360.0;
  camera.cx_px = 321.3;
  camera.cy_px = 88.7;
  camera.residual_k1 = 0.01;
  camera.residual_k2 = -0.004;
  camera.camera_height_m = kRoadHeight;
  return camera;
}

GreyImage render(const CameraModel& camera, const Se3& T_world_cam, const Shutter& shutter,
                 std::uint32_t seed) {
  GreyImage image(camera.width_px, camera.height_px);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  const int width = camera.width_px, height = camera.height_px;
  std::vector<double> scene(static_cast<std::size_t>(width * height));
  constexpr double kImage_s = 0.1;
  for (int v = 0; v < height; ++v) {
    const double share = camera.row_time_s(v) / kImage_s;
    const Se3 moved{exp_so3(share * log_so3(shutter.step.R)), share * shutter.step.t};
    const Se3 T_world_row = T_world_cam * moved;
    for (int u = 0; u < width; ++u) {
      scene[static_cast<std::size_t>(v * width + u)] = radiance(camera, T_world_row, u, v);
    }
  }
  if (shutter.blur_px > 0) {
    scene = box_blur(scene, width, height, shutter.blur_px, true);
    scene = box_blur(scene, width, height, shutter.blur_px, false);
  }
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double grey = shutter.gain * scene[static_cast<std::size_t>(v * width + u)] +
                          shutter.bias + shutter.noise_grey * noise(random);
      image.row(v)[u] = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
    }
  }
  return image;
}

TruePlane plane_in(const Se3& T_world_cam) {
  return {T_world_cam.R.transpose() * Eigen::Vector3d::UnitY(), kRoadHeight - T_world_cam.t.y()};
}

std::vector<Se3> Drive::poses(int num_frames) const {
  std::vector<Se3> out;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int k = 0; k < num_frames; ++k) {
    const double heading = turn_left_rad * k;  // a left turn is about -y
    const double pitch = mount_pitch_rad + pitch_amplitude_rad * std::sin(0.7 * k);
    const Eigen::Matrix3d R_world_car = exp_so3(Eigen::Vector3d(0.0, -heading, 0.0));
    // Nose down turns z towards y, which is a rotation about -x. Right side down turns x towards y,
    // which is a rotation about z.
    const Eigen::Matrix3d R_car_cam =
        exp_so3(Eigen::Vector3d(-pitch, 0, 0)) * exp_so3(Eigen::Vector3d(0, 0, mount_roll_rad));
    out.push_back({R_world_car * R_car_cam, position});
    const double middle = -(heading + 0.5 * turn_left_rad);
    position += step_m * Eigen::Vector3d(std::sin(middle), 0.0, std::cos(middle));
  }
  return out;
}

void script_vo(const std::vector<Se3>& poses, int k, const VoScript& script, VoOutput* vo) {
  *vo = VoOutput{};
  vo->seq = k;
  vo->capture_us = 100'000LL * k + 1'000'000;
  vo->prev_seq = k - 1;
  vo->interval_s = 0.1;
  vo->status = k < script.first_ok_frame ? VoStatus::kInitializing : VoStatus::kOk;
  if (vo->status != VoStatus::kOk) return;
  const Se3 T_cam_world = poses[static_cast<std::size_t>(k)].inverse();
  for (int m = 1; m <= std::min<int>(k, kMaxWindowPoses); ++m) {
    Se3 T = (T_cam_world * poses[static_cast<std::size_t>(k - m)]).inverse();
    T.t /= script.metres_per_vo;
    (void)vo->window.push_back({k - m, T});
  }
  vo->T_prev_cam = vo->window[0].T_window_cam;
  vo->cov_prev_cam.diagonal() << 1e-6, 1e-6, 1e-6, 1e-8, 1e-8, 1e-8;

  std::mt19937 random(static_cast<std::uint32_t>(k + 1));
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 1.0);
  const CameraModel camera = scene_camera();
  const TruePlane plane = plane_in(poses[static_cast<std::size_t>(k)]);
  for (int i = 0; i < script.num_points + script.num_outliers; ++i) {
    const bool outlier = i >= script.num_points;
    const double z = 4.0 + 12.0 * uniform(random);
    const double x = 3.0 * uniform(random) - 1.5;
    const double above = outlier ? 0.8 * uniform(random) : 0.0;
    const Eigen::Vector3d& n = plane.normal_cam;
    const double y = (plane.height_m - above - n.x() * x - n.z() * z) / n.y();
    const double scatter = std::exp(script.point_rel_std * normal(random));
    const Eigen::Vector3d p = Eigen::Vector3d(x, y, z) * scatter / script.metres_per_vo;
    RoadPoint point;
    point.p_cam = p.cast<float>();
    point.px = camera.project(p).cast<float>();
    point.rel_std = static_cast<float>(script.point_rel_std);
    point.num_obs = 5;
    (void)vo->road_points.push_back(point);
  }
}

}  // namespace plumb::test
