/// Results whose fields all have distinct values, so that a lost or swapped field is detected.
#pragma once

#include "modules/ground/ground.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::test {

inline Se3 sample_pose(double k) {
  return {exp_so3({0.01 * k, -0.2, 0.03}), {0.1 * k, -0.02, 1.0 / 3.0}};
}

template <int kSize>
inline Eigen::Matrix<double, kSize, kSize> sample_covariance() {
  Eigen::Matrix<double, kSize, kSize> m;
  for (int r = 0; r < kSize; ++r)
    for (int c = 0; c < kSize; ++c) m(r, c) = r == c ? 1.0 + r : 0.01 * (r + c) / 3.0;
  return m;
}

inline VoOutput sample_vo_output() {
  VoOutput o;
  o.capture_us = 1'234'567'890'123;
  o.seq = 42;
  o.status = VoStatus::kOk;
  o.reason = VoReason::kRestarted;
  o.scale_epoch = 3;
  o.scale_carry_std = 0.05;
  o.prev_seq = 41;
  o.interval_s = 0.104;
  o.interval_std_s = 0.0015;
  o.session = 17;
  o.capture_mono_us = 987'654'321;
  o.T_prev_cam = sample_pose(1.0);
  o.cov_prev_cam = sample_covariance<6>();
  for (std::size_t i = 0; i < kMaxWindowPoses; ++i)
    (void)o.window.push_back({41 - static_cast<std::int64_t>(i), sample_pose(2.0 + double(i))});
  o.num_tracked = 401;
  o.num_inliers = 388;
  o.num_new = 17;
  o.is_keyframe = true;
  o.median_flow_px = 12.5;
  o.median_parallax_px = 6.25;
  o.rms_residual_px = 0.375;
  o.attached_share = 0.125;
  for (std::size_t i = 0; i < kMaxRoadPoints; ++i) {
    const auto k = static_cast<float>(i);
    (void)o.road_points.push_back({{0.1F * k, 1.65F / 3.0F, 5.0F + k},
                                   {600.0F + k, 300.0F},
                                   0.01F,
                                   static_cast<std::int16_t>(2 + i % 9)});
  }
  for (std::size_t i = 0; i < kMaxFeatures; ++i) {
    const auto k = static_cast<float>(i);
    (void)o.features.push_back({{0.25F + k, 300.0F - k}, static_cast<FeatureKind>(i % 4)});
  }
  return o;
}

inline GroundOutput sample_ground_output() {
  GroundOutput o;
  o.capture_us = 1'234'567'890'123;
  o.seq = 42;
  o.plane.status = GroundStatus::kOk;
  o.plane.reason = GroundReason::kNone;
  o.plane.normal_cam = Eigen::Vector3d(0.01, 1.0, 0.02).normalized();
  o.plane.height_m = 1.65;
  o.plane.pitch_rad = -0.02;
  o.plane.roll_rad = 0.01;
  o.plane.cov = sample_covariance<3>();
  for (std::size_t i = 0; i < kNumCues; ++i) {
    const double k = 1.0 + static_cast<double>(i);
    o.plane.cues[i] = {
        CueStatus::kGated,   1.5 * k, 0.1 * k, 0.2 * k, 0.3 * k, 0.4 * k, 0.5 * k, 0.9,
        {0.6 * k, 0.7, 0.8}, 1.1 * k};
  }
  o.ego.status = EgoStatus::kScaleHeld;
  o.ego.reason = VoReason::kLowParallax;
  o.ego.reset_counter = 5;
  o.ego.T_prev_cam = sample_pose(1.0);
  o.ego.cov_prev_cam = sample_covariance<6>();
  o.ego.velocity_ground_m_s = {9.0, 0.1, -0.2};
  o.ego.speed_std_m_s = 0.3;
  o.ego.rate_ground_rad_s = {0.01, 0.02, 0.03};
  o.ego.yaw_rate_std_rad_s = 0.004;
  o.ego.accel_forward_m_s2 = 0.5;
  o.ego.accel_forward_std_m_s2 = 0.6;
  o.ego.T_world_cam = sample_pose(7.0);
  o.ego.cov_world_cam = sample_covariance<6>();
  o.ego.distance_m = 321.0;
  o.ego.log_scale = -0.7;
  o.ego.log_scale_std = 0.01;
  return o;
}

}  // namespace plumb::test
