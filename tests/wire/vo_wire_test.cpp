#include "modules/vo/vo_wire.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "core/numbers.hpp"
#include "tests/wire/sample_output.hpp"

namespace plumb {
namespace {

std::string refusal(const std::function<void(vo_motion_t*)>& change) {
  static vo_motion_t message;
  static VoOutput out;
  to_wire(test::sample_vo_output(), &message);
  change(&message);
  const char* why = from_wire(message, &out);
  return why == nullptr ? "" : why;
}

TEST(VoWire, RoundTripsToTheSameBits) {
  // R -> q -> R may change the last bit once; after that the message is a fixed point.
  static vo_motion_t first;
  static vo_motion_t second;
  static VoOutput back;
  to_wire(test::sample_vo_output(), &first);
  ASSERT_EQ(nullptr, from_wire(first, &back));
  EXPECT_EQ(42, back.seq);
  EXPECT_EQ(VoStatus::kOk, back.status);
  EXPECT_EQ(VoReason::kRestarted, back.reason);
  ASSERT_EQ(kMaxWindowPoses, back.window.size());
  ASSERT_EQ(kMaxRoadPoints, back.road_points.size());
  EXPECT_TRUE(back.is_keyframe);
  to_wire(back, &second);
  EXPECT_EQ(
      0, std::memcmp(first.road_points_cam, second.road_points_cam, sizeof first.road_points_cam));
  ASSERT_EQ(kMaxFeatures, back.features.size());
  EXPECT_EQ(FeatureKind::kAttached, back.features[3].kind);
  EXPECT_EQ(0, std::memcmp(first.features_px, second.features_px, sizeof first.features_px));
  EXPECT_EQ(0, std::memcmp(first.features_kind, second.features_kind, sizeof first.features_kind));
  EXPECT_EQ(0, std::memcmp(first.cov_prev_cam, second.cov_prev_cam, sizeof first.cov_prev_cam));
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(first.q_prev_cam[i], second.q_prev_cam[i], 1e-15);
  EXPECT_EQ(0, std::memcmp(first.t_window_cam, second.t_window_cam, sizeof first.t_window_cam));
}

TEST(VoWire, KeepsRotationAndTranslationOfAPose) {
  const VoOutput output = test::sample_vo_output();
  static vo_motion_t message;
  static VoOutput back;
  to_wire(output, &message);
  ASSERT_EQ(nullptr, from_wire(message, &back));
  EXPECT_TRUE(back.T_prev_cam.R.isApprox(output.T_prev_cam.R, 1e-14));
  EXPECT_EQ(back.T_prev_cam.t, output.T_prev_cam.t);
  EXPECT_GE(message.q_prev_cam[0], 0.0) << "the sign of the quaternion is unique";
}

TEST(VoWire, ClearsRowsBeyondTheCounts) {
  static vo_motion_t message;
  to_wire(test::sample_vo_output(), &message);
  to_wire(VoOutput{}, &message);
  EXPECT_EQ(0, message.num_road_points);
  EXPECT_EQ(0.0F, message.road_points_cam[5][2]);
  EXPECT_EQ(0, message.window_seq[3]);
}

TEST(VoWire, AcceptsWhatALostEstimatorSends) {
  static vo_motion_t message;
  static VoOutput back;
  VoOutput lost;
  lost.reason = VoReason::kNoCalibration;
  lost.scale_carry_std = kNan;
  to_wire(lost, &message);
  EXPECT_EQ(nullptr, from_wire(message, &back));
  EXPECT_EQ(VoStatus::kLost, back.status);
}

TEST(VoWire, RefusesCountsAndNumbersOutOfRange) {
  EXPECT_EQ("", refusal([](vo_motion_t*) {}));
  EXPECT_EQ("VO motion: unknown status", refusal([](vo_motion_t* m) { m->status = 6; }));
  EXPECT_EQ("VO motion: unknown status", refusal([](vo_motion_t* m) { m->status = -1; }));
  EXPECT_EQ("VO motion: unknown reason", refusal([](vo_motion_t* m) { m->reason = 29; }));
  const std::string interval =
      "VO motion: the interval between the images is not positive and finite";
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double value : {0.0, -0.1, infinite, -infinite}) {
    EXPECT_EQ(interval, refusal([value](vo_motion_t* m) { m->interval_s = value; })) << value;
  }
  EXPECT_EQ("", refusal([](vo_motion_t* m) { m->interval_s = m->interval_std_s = kNan; }));
  for (const double value : {-0.1, infinite, kNan}) {
    EXPECT_EQ("VO motion: the standard deviation of the interval is negative or not finite",
              refusal([value](vo_motion_t* m) { m->interval_std_s = value; }))
        << value;
  }
  const std::string points = "VO motion: number of road points is out of range";
  EXPECT_EQ(points, refusal([](vo_motion_t* m) { m->num_road_points = 385; }));
  EXPECT_EQ(points, refusal([](vo_motion_t* m) { m->num_road_points = -1; }));
  EXPECT_EQ(points, refusal([](vo_motion_t* m) { m->num_road_points = 32767; }));
  const std::string features = "VO motion: number of features is out of range";
  EXPECT_EQ(features, refusal([](vo_motion_t* m) { m->num_features = 1001; }));
  EXPECT_EQ(features, refusal([](vo_motion_t* m) { m->num_features = -1; }));
  const std::string window = "VO motion: number of window poses is out of range";
  EXPECT_EQ(window, refusal([](vo_motion_t* m) { m->num_window = 13; }));
  EXPECT_EQ(window, refusal([](vo_motion_t* m) { m->num_window = -128; }));
  EXPECT_EQ("VO motion: a feature count is negative",
            refusal([](vo_motion_t* m) { m->num_inliers = -1; }));
}

TEST(VoWire, RefusesInvalidPoses) {
  const std::string pose = "VO motion: the relative pose is not a pose";
  EXPECT_EQ(pose, refusal([](vo_motion_t* m) { m->q_prev_cam[0] = kNan; }));
  EXPECT_EQ(pose, refusal([](vo_motion_t* m) { m->q_prev_cam[2] += 0.01; }));
  EXPECT_EQ(pose, refusal([](vo_motion_t* m) {
              for (double& q : m->q_prev_cam) q = 0.0;
            }));
  EXPECT_EQ(pose, refusal([](vo_motion_t* m) { m->t_prev_cam[1] = kInf; }));
  EXPECT_EQ("VO motion: a window pose is not a pose",
            refusal([](vo_motion_t* m) { m->t_window_cam[11][2] = kNan; }));
  EXPECT_EQ("VO motion: window poses are not newest first",
            refusal([](vo_motion_t* m) { m->window_seq[4] = 100; }));
}

TEST(VoWire, RefusesInvalidCovariancesAndPoints) {
  const std::string cov = "VO motion: the covariance is not a covariance";
  EXPECT_EQ(cov, refusal([](vo_motion_t* m) { m->cov_prev_cam[2][3] = kNan; }));
  EXPECT_EQ(cov, refusal([](vo_motion_t* m) { m->cov_prev_cam[2][2] = -1e-9; }));
  const std::string carry =
      "VO motion: the standard deviation of the scale is negative or infinite";
  EXPECT_EQ("", refusal([](vo_motion_t* m) { m->scale_carry_std = kNan; }));
  EXPECT_EQ(carry, refusal([](vo_motion_t* m) { m->scale_carry_std = kInf; }));
  EXPECT_EQ(carry, refusal([](vo_motion_t* m) { m->scale_carry_std = -0.1; }));
  const std::string point = "VO motion: a road point is not a point before the camera";
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(point, refusal([=](vo_motion_t* m) { m->road_points_cam[383][0] = nan; }));
  EXPECT_EQ(point, refusal([](vo_motion_t* m) { m->road_points_cam[0][2] = -1.0F; }));
  EXPECT_EQ(point, refusal([=](vo_motion_t* m) { m->road_points_px[7][1] = nan; }));
  EXPECT_EQ(point, refusal([=](vo_motion_t* m) { m->road_points_rel_std[7] = nan; }));
  EXPECT_EQ(point, refusal([](vo_motion_t* m) { m->road_points_num_obs[7] = -1; }));
  const std::string feature = "VO motion: a feature has no place in the image or no known kind";
  EXPECT_EQ(feature, refusal([=](vo_motion_t* m) { m->features_px[999][1] = nan; }));
  EXPECT_EQ(feature, refusal([](vo_motion_t* m) { m->features_kind[0] = 4; }));
  EXPECT_EQ(feature, refusal([](vo_motion_t* m) { m->features_kind[7] = -1; }));
  EXPECT_EQ("VO motion: the tracking summary is not finite",
            refusal([=](vo_motion_t* m) { m->median_flow_px = nan; }));
}

TEST(VoWire, IgnoresRowsBeyondTheCounts) {
  EXPECT_EQ("", refusal([](vo_motion_t* m) {
              m->num_road_points = 3;
              m->road_points_cam[3][0] = std::numeric_limits<float>::quiet_NaN();
              m->num_features = 2;
              m->features_kind[2] = 17;
              m->num_window = 1;
              m->q_window_cam[1][0] = kNan;
            }));
}

}  // namespace
}  // namespace plumb
