/// EGO_MOTION and GROUND_PLANE of a steady drive straight ahead, as plumb-ground sends them.
#pragma once

#include <cmath>

#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"

namespace plumb::test {

/// One image of the drive; tests change what they need.
struct Drive {
  std::int64_t seq = 0;
  std::int64_t utime = 1'000'000;
  std::int64_t session = 0;
  double interval_s = 0.1;
  double speed_m_s = 10.0;
  double distance_m = 0.0;
  std::int32_t reset_counter = 0;

  /// Goes on to the next image.
  void step() {
    ++seq;
    utime += std::llround(interval_s * 1e6);
    distance_m += std::abs(speed_m_s) * interval_s;
  }

  [[nodiscard]] ego_motion_t ego() const {
    ego_motion_t m{};
    m.seq = seq;
    m.session = session;
    m.utime = m.capture_mono_us = utime;
    m.reset_counter = reset_counter;
    m.q_prev_cam[0] = m.q_world_cam[0] = 1.0;
    m.t_prev_cam_m[2] = speed_m_s * interval_s;
    m.velocity_ground_m_s[0] = speed_m_s;
    m.speed_std_m_s = 0.1;
    m.yaw_rate_std_rad_s = 0.001;
    m.accel_forward_std_m_s2 = 0.2;
    m.t_world_cam_m[2] = m.distance_m = distance_m;
    m.log_scale_std = 0.02;
    return m;
  }

  [[nodiscard]] ground_plane_t plane() const {
    ground_plane_t m{};
    m.seq = seq;
    m.session = session;
    m.utime = m.capture_mono_us = utime;
    m.normal_cam[1] = 1.0;
    m.pitch_rad = 0.01;
    m.roll_rad = -0.02;
    m.height_m = 1.65;
    for (int i = 0; i < 3; ++i) m.cov[i][i] = 1e-5;
    return m;
  }
};

}  // namespace plumb::test
