/// A window of frames and tracks with exact truth, for the tests of the estimators.
#pragma once

#include <random>
#include <vector>

#include "core/camera_model.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo::test {

struct SyntheticWindow {
  static constexpr int kWidth = 64;  // the images are not used
  static constexpr int kHeight = 64;
  Eigen::Vector2d focal_px{720.0, 720.0};
  Window window{kWidth, kHeight};
  TrackTable tracks{600};
  std::vector<Se3> T_cam_world;  // truth, by slot
  std::vector<double> rho;       // truth, by track index

  /// Places `num_keyframes` keyframes one unit apart on a gentle curve. Every track is hosted by
  /// one of the first half of them and is seen by every later one.
  SyntheticWindow(int num_keyframes, int num_tracks, double noise_px, unsigned seed = 3) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::normal_distribution<double> normal(0.0, 1.0);
    const std::vector<std::uint8_t> blank(kWidth * kHeight, 0);
    Se3 T_world_cam;
    for (int i = 0; i < num_keyframes; ++i) {
      T_cam_world.push_back(T_world_cam.inverse());
      const int slot = window.add(i, T_cam_world.back());
      window.make_keyframe(slot, {blank.data(), kWidth, kHeight, kWidth});
      T_world_cam = T_world_cam * Se3{exp_so3({0.002, 0.01, -0.001}), {0.02, 0.01, 1.0}};
    }
    rho.resize(static_cast<std::size_t>(num_tracks));
    for (int i = 0; i < num_tracks; ++i) {
      const int index = tracks.add();
      Track& track = tracks[index];
      track.host = i % std::max(1, num_keyframes / 2);
      const double z = 12.0 + 30.0 * unit(generator);
      track.host_xy = {1.2 * unit(generator) - 0.6, 0.5 * unit(generator) - 0.25};
      track.rho = rho[static_cast<std::size_t>(index)] = 1.0 / z;
      track.rho_std = 1e-6;
      track.prior_rho = track.rho;
      track.prior_std = 0.3;
      track.observe(track.host, track.host_xy);
      for (int slot = track.host + 1; slot < num_keyframes; ++slot) {
        const Se3 T = T_cam_world[static_cast<std::size_t>(slot)] *
                      T_cam_world[static_cast<std::size_t>(track.host)].inverse();
        const Eigen::Vector3d Y = T.R * track.host_xy.homogeneous() + track.rho * T.t;
        Eigen::Vector2d xy = Y.head<2>() / Y.z();
        xy += Eigen::Vector2d(normal(generator), normal(generator)) * (noise_px / focal_px.x());
        track.observe(slot, xy);
        track.xy = xy;
      }
    }
  }

  [[nodiscard]] int last_slot() const { return static_cast<int>(T_cam_world.size()) - 1; }
};

}  // namespace plumb::vo::test
