/// A fixture with the gate under test, a clock, and the frames that were sent.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/numbers.hpp"
#include "modules/can/can_wire.hpp"
#include "tests/can/from_wire.hpp"
#include "tests/can/recording_sink.hpp"

namespace plumb::test {

inline constexpr double kInvalid = static_cast<double>(CanValidity::kInvalid);
inline constexpr double kDegraded = static_cast<double>(CanValidity::kDegraded);
inline constexpr double kValid = static_cast<double>(CanValidity::kValid);

inline ego_motion_t make_ego(std::int64_t seq, std::int8_t status = ego_motion_t::STATUS_OK) {
  ego_motion_t m{};
  m.seq = seq;
  m.status = status;
  m.velocity_ground_m_s[0] = 12.5;
  m.velocity_ground_m_s[1] = -0.2;
  m.speed_std_m_s = 0.1;
  m.rate_ground_rad_s[2] = 0.1;
  m.yaw_rate_std_rad_s = 0.001;
  m.accel_forward_m_s2 = -1.5;
  m.accel_forward_std_m_s2 = 0.2;
  m.q_world_cam[0] = std::cos(-0.25);  // heading 0.5 to the left
  m.q_world_cam[2] = std::sin(-0.25);
  m.t_world_cam_m[0] = 20.0;
  m.t_world_cam_m[1] = -1.0;
  m.t_world_cam_m[2] = 100.0;
  m.distance_m = 120.0;
  m.log_scale_std = 0.02;
  return m;
}

inline ground_plane_t make_plane(std::int64_t seq, std::int8_t status = ground_plane_t::STATUS_OK) {
  ground_plane_t m{};
  m.seq = seq;
  m.status = status;
  m.pitch_rad = 0.01;
  m.roll_rad = -0.02;
  m.height_m = 1.65;
  const double stds[] = {0.002, 0.003, 0.02 / 1.65};
  for (int i = 0; i < 3; ++i) m.cov[i][i] = stds[i] * stds[i];
  m.num_cues = 3;
  m.cues.resize(3);
  m.cues[2].status = ground_cue_t::STATUS_ABSENT;
  return m;
}

/// Converts a message for the bus. A broken one fails the test.
template <typename Message>
CanSample sample_of(const Message& message) {
  CanSample sample;
  EXPECT_EQ(from_wire(message, default_messages(), &sample), nullptr);
  return sample;
}

class GateFixture : public ::testing::Test {
 protected:
  CanConfig config_;
  CanGate gate_{config_, default_messages()};
  RecordingSink sink_;
  std::int64_t now_us_ = 1'000'000;

  void give(std::int64_t seq) {
    hear(make_plane(seq));
    hear(make_ego(seq));
  }
  /// The image was taken just now, unless the message says otherwise.
  void hear(ground_plane_t plane) {
    if (plane.capture_mono_us == 0) plane.capture_mono_us = now_us_;
    gate_.on_ground_plane(sample_of(plane), now_us_);
  }
  void hear(ego_motion_t ego) {
    if (ego.capture_mono_us == 0) ego.capture_mono_us = now_us_;
    gate_.on_ego_motion(sample_of(ego), now_us_);
  }
  void tick(int num_ticks = 1) {
    for (int i = 0; i < num_ticks; ++i) {
      gate_.tick(now_us_, sink_);
      now_us_ += CanGate::kTickUs;
    }
  }
  /// Ego motion's frame counters in the order of transmission, without repeats.
  std::vector<int> frames_sent(const char* message = "EgoMotion") {
    std::vector<int> result;
    for (const Reading& v : sink_.all(message)) {
      const int counter = static_cast<int>(v.frame_counter());
      if (std::isnan(v.validity())) continue;
      if (result.empty() || result.back() != counter) result.push_back(counter);
    }
    return result;
  }
  void expect_all_ego_values_absent(const Reading& v) {
    for (const double value :
         {v["EgoMotion_Standstill"], v["EgoMotion_Speed"], v["EgoMotion_YawRate"],
          v["EgoMotion_SpeedStd"], v["EgoDetail_SpeedY"], v["EgoDetail_AccelX"],
          v["EgoDetail_AccelXStd"], v["EgoDetail_YawRateStd"], v["OdomX_PosX"], v["OdomY_PosY"],
          v["OdomY_PosZ"], v["OdomX_Heading"], v["OdomDist_Distance"], v["OdomDist_ScaleStd"]}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
  void expect_all_plane_values_absent(const Reading& v) {
    for (const double value :
         {v["GroundPlane_Pitch"], v["GroundPlane_Roll"], v["GroundPlane_Height"],
          v["GroundDetail_PitchStd"], v["GroundDetail_RollStd"], v["GroundDetail_HeightStd"]}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
};

}  // namespace plumb::test
