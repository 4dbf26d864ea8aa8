/// The gate under test, a clock, and what it has sent.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/numbers.hpp"
#include "modules/can/can_gate.hpp"
#include "tests/can/recording_sink.hpp"

namespace plumb::test {

inline constexpr double kInvalid = static_cast<double>(CanValidity::kInvalid);
inline constexpr double kDegraded = static_cast<double>(CanValidity::kDegraded);
inline constexpr double kValid = static_cast<double>(CanValidity::kValid);

inline CanEgo make_ego(std::int64_t seq, CanEgoStatus status = CanEgoStatus::kOk) {
  CanEgo ego;
  ego.seq = seq;
  ego.status = status;
  ego.speed_m_s = 12.5;
  ego.speed_std_m_s = 0.1;
  ego.lateral_speed_m_s = -0.2;
  ego.yaw_rate_rad_s = 0.1;
  ego.yaw_rate_std_rad_s = 0.001;
  ego.accel_m_s2 = -1.5;
  ego.accel_std_m_s2 = 0.2;
  ego.x_m = 100.0;
  ego.y_m = -20.0;
  ego.z_m = 1.0;
  ego.heading_rad = 0.5;
  ego.distance_m = 120.0;
  ego.scale_std_ratio = 0.02;
  return ego;
}

inline CanPlane make_plane(std::int64_t seq, CanPlaneStatus status = CanPlaneStatus::kOk) {
  CanPlane plane;
  plane.seq = seq;
  plane.status = status;
  plane.pitch_rad = 0.01;
  plane.roll_rad = -0.02;
  plane.height_m = 1.65;
  plane.pitch_std_rad = 0.002;
  plane.roll_std_rad = 0.003;
  plane.height_std_m = 0.02;
  plane.cues_used = 3;
  return plane;
}

class GateFixture : public ::testing::Test {
 protected:
  CanConfig config_;
  CanGate gate_{config_};
  RecordingSink sink_;
  std::int64_t now_us_ = 1'000'000;

  void give(std::int64_t seq) {
    gate_.on_ground_plane(make_plane(seq), now_us_);
    gate_.on_ego_motion(make_ego(seq), now_us_);
  }
  void tick(int num_ticks = 1) {
    for (int i = 0; i < num_ticks; ++i) {
      gate_.tick(now_us_, sink_);
      now_us_ += CanGate::kTickUs;
    }
  }
  /// Ego motion's frame counters in the order of transmission, repeats removed.
  std::vector<int> frames_sent(const char* message = "PLB_EgoMotion") {
    std::vector<int> result;
    for (const CanValues& v : sink_.all(message)) {
      const int counter = static_cast<int>(v.frame_counter);
      if (std::isnan(v.ego_validity) && std::isnan(v.plane_validity)) continue;
      if (result.empty() || result.back() != counter) result.push_back(counter);
    }
    return result;
  }
  void expect_all_ego_values_absent(const CanValues& v) {
    for (const double value :
         {v.standstill, v.speed_m_s, v.yaw_rate_rad_s, v.speed_std_m_s, v.lateral_speed_m_s,
          v.accel_m_s2, v.accel_std_m_s2, v.yaw_rate_std_rad_s, v.x_m, v.y_m, v.z_m, v.heading_rad,
          v.distance_m, v.scale_std_ratio}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
  void expect_all_plane_values_absent(const CanValues& v) {
    for (const double value :
         {v.pitch_rad, v.roll_rad, v.height_m, v.pitch_std_rad, v.roll_std_rad, v.height_std_m}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
};

}  // namespace plumb::test
