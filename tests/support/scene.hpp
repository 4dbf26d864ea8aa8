/// Renders a street of textured planes with exact truth:
/// the road, walls at the kerbs and a far backdrop.
///
/// Frames:
///   world: cam of a level camera at the start of the street; x right, y down, z forward.
/// Units:
///   Metres. Pixels follow CameraModel, including its radial distortion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/se3.hpp"

namespace plumb::test {

/// A camera with half of KITTI's resolution, to keep rendering fast.
inline CameraModel scene_camera() {
  CameraModel camera;
  camera.width_px = 620;
  camera.height_px = 188;
  camera.fx_px = camera.fy_px = 360.0;
  camera.cx_px = 305.0;
  camera.cy_px = 86.0;
  return camera;
}

struct SceneOptions {
  double camera_height_m = 1.65;
  double wall_left_m = 7.0;
  double wall_right_m = 9.0;
  double backdrop_m = 150.0;  ///< distance from the start of the street
  double contrast_grey = 60.0;
};

/// An image that owns its pixels.
struct RenderedImage {
  std::vector<std::uint8_t> pixels;
  int width_px = 0;
  int height_px = 0;
  [[nodiscard]] ImageView view() const { return {pixels.data(), width_px, height_px, width_px}; }
};

class Scene {
 public:
  explicit Scene(const CameraModel& camera, const SceneOptions& options = {})
      : camera_(camera), options_(options) {
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) rays_.push_back(camera.unproject({u, v}));
    }
  }

  /// Renders an image with sensor noise of `noise_std_grey`, drawn from `seed`.
  [[nodiscard]] RenderedImage render(const Se3& T_world_cam, double noise_std_grey = 0.0,
                                     unsigned seed = 1, double gain = 1.0) const {
    return render_rows([&T_world_cam](int) { return T_world_cam; }, noise_std_grey, seed, gain);
  }

  /// Renders an image with the camera's rolling shutter while the
  /// camera moves by `step` per `image_s`.
  [[nodiscard]] RenderedImage render_rolling(const Se3& T_world_cam, const Se3& step,
                                             double image_s) const {
    const auto pose_of_row = [&](int v) {
      const double share = camera_.row_time_s(v) / image_s;
      return T_world_cam * Se3{exp_so3(share * log_so3(step.R)), share * step.t};
    };
    return render_rows(pose_of_row, 0.0, 1, 1.0);
  }

  [[nodiscard]] const CameraModel& camera() const { return camera_; }

 private:
  template <typename PoseOfRow>
  [[nodiscard]] RenderedImage render_rows(const PoseOfRow& pose_of_row, double noise_std_grey,
                                          unsigned seed, double gain) const {
    RenderedImage image{{}, camera_.width_px, camera_.height_px};
    image.pixels.reserve(rays_.size());
    std::mt19937 generator(seed);
    std::normal_distribution<double> noise(0.0, 1.0);
    auto ray_cam = rays_.begin();
    for (int v = 0; v < camera_.height_px; ++v) {
      const Se3 T_world_cam = pose_of_row(v);
      for (int u = 0; u < camera_.width_px; ++u, ++ray_cam) {
        double grey = gain * shade(T_world_cam.t, T_world_cam.R * *ray_cam);
        if (noise_std_grey > 0.0) grey += noise_std_grey * noise(generator);
        image.pixels.push_back(static_cast<std::uint8_t>(std::clamp(grey + 0.5, 0.0, 255.0)));
      }
    }
    return image;
  }

  struct Hit {
    double range = 1e9;  // in lengths of the ray
    double a = 0.0, b = 0.0;
    std::uint32_t surface = 0;
  };

  static double lattice(std::int64_t x, std::int64_t y, std::uint32_t salt) {
    std::uint64_t z = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL ^
                      static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL ^ salt;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<double>(z >> 40) / static_cast<double>(1 << 24) - 0.5;
  }

  static double smooth_noise(double x, double y, std::uint32_t salt) {
    const double fx = std::floor(x);
    const double fy = std::floor(y);
    const auto ix = static_cast<std::int64_t>(fx);
    const auto iy = static_cast<std::int64_t>(fy);
    const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double a = ease(x - fx);
    const double b = ease(y - fy);
    const double top = (1.0 - a) * lattice(ix, iy, salt) + a * lattice(ix + 1, iy, salt);
    const double low = (1.0 - a) * lattice(ix, iy + 1, salt) + a * lattice(ix + 1, iy + 1, salt);
    return (1.0 - b) * top + b * low;
  }

  // Octaves finer than two pixels are omitted to avoid aliasing.
  double texture(const Hit& hit, double footprint) const {
    double sum = 0.0;
    double wavelength = 4.0;
    for (std::uint32_t k = 0; k < 6; ++k, wavelength *= 0.5) {
      const double keep = std::clamp(wavelength / footprint / 2.0 - 1.0, 0.0, 1.0);
      if (keep <= 0.0) break;
      sum += keep * smooth_noise(hit.a / wavelength, hit.b / wavelength, 16 * hit.surface + k);
    }
    return sum;
  }

  [[nodiscard]] double shade(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
    Hit hit;
    const auto meet = [&](double offset, double along, std::uint32_t surface, int i, int j) {
      if (along == 0.0 || offset / along <= 0.0 || offset / along >= hit.range) return;
      hit.range = offset / along;
      const Eigen::Vector3d p = origin + hit.range * ray;
      hit = {hit.range, p[i], p[j], surface};
    };
    meet(options_.camera_height_m - origin.y(), ray.y(), 1, 0, 2);
    meet(-options_.wall_left_m - origin.x(), ray.x(), 2, 1, 2);
    meet(options_.wall_right_m - origin.x(), ray.x(), 3, 1, 2);
    meet(options_.backdrop_m - origin.z(), ray.z(), 4, 0, 1);
    if (hit.range > 1e8) return 128.0;
    // The footprint of a pixel grows with the slope of the surface against the ray.
    const double slope = hit.surface == 1   ? std::abs(ray.y())
                         : hit.surface == 4 ? 1.0
                                            : std::abs(ray.x());
    const double footprint = hit.range / camera_.fx_px / std::max(0.02, std::min(1.0, slope)) * 0.5;
    return 110.0 + options_.contrast_grey * texture(hit, footprint);
  }

  CameraModel camera_;
  SceneOptions options_;
  std::vector<Eigen::Vector3d> rays_;
};

/// Poses T_world_cam of a drive that moves forward by `speed_m` and turns by `yaw_rad` (right
/// positive) per frame.
inline std::vector<Se3> drive(int num_frames, double speed_m, double yaw_rad = 0.0) {
  std::vector<Se3> poses{Se3{}};
  const Se3 step{exp_so3({0.0, yaw_rad, 0.0}), {0.0, 0.0, speed_m}};
  while (static_cast<int>(poses.size()) < num_frames) poses.push_back(poses.back() * step);
  return poses;
}

}  // namespace plumb::test
