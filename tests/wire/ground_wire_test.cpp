#include "modules/ground/ground_wire.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>

#include "core/numbers.hpp"
#include "plumb_paths.hpp"
#include "tests/wire/sample_output.hpp"

namespace plumb {
namespace {

std::string refusal(const std::function<void(ground_plane_t*, ego_motion_t*)>& change) {
  ground_plane_t plane{};
  ego_motion_t ego{};
  to_wire(test::sample_ground_output(), &plane);
  to_wire(test::sample_ground_output(), &ego);
  change(&plane, &ego);
  GroundOutput out;
  const char* why = from_wire(plane, ego, &out);
  return why == nullptr ? "" : why;
}
std::string refused_plane(const std::function<void(ground_plane_t*)>& change) {
  return refusal([&](ground_plane_t* plane, ego_motion_t*) { change(plane); });
}
std::string refused_ego(const std::function<void(ego_motion_t*)>& change) {
  return refusal([&](ground_plane_t*, ego_motion_t* ego) { change(ego); });
}

TEST(GroundWire, RoundTripsEveryField) {
  const GroundOutput sent = test::sample_ground_output();
  ground_plane_t plane{};
  ego_motion_t ego{};
  to_wire(sent, &plane);
  to_wire(sent, &ego);
  GroundOutput back;
  ASSERT_EQ(nullptr, from_wire(plane, ego, &back));
  EXPECT_EQ(sent.seq, back.seq);
  EXPECT_EQ(sent.capture_us, back.capture_us);
  EXPECT_EQ(sent.plane.status, back.plane.status);
  EXPECT_EQ(sent.plane.normal_cam, back.plane.normal_cam);
  EXPECT_EQ(sent.plane.height_m, back.plane.height_m);
  EXPECT_EQ(sent.plane.pitch_rad, back.plane.pitch_rad);
  EXPECT_EQ(sent.plane.roll_rad, back.plane.roll_rad);
  EXPECT_EQ(sent.plane.cov, back.plane.cov);
  for (std::size_t i = 0; i < kNumCues; ++i) {
    EXPECT_EQ(sent.plane.cues[i].status, back.plane.cues[i].status);
    EXPECT_EQ(sent.plane.cues[i].height, back.plane.cues[i].height);
    EXPECT_EQ(sent.plane.cues[i].n1, back.plane.cues[i].n1);
    EXPECT_EQ(sent.plane.cues[i].n3, back.plane.cues[i].n3);
    EXPECT_EQ(sent.plane.cues[i].height_var, back.plane.cues[i].height_var);
    EXPECT_EQ(sent.plane.cues[i].n1_var, back.plane.cues[i].n1_var);
    EXPECT_EQ(sent.plane.cues[i].n3_var, back.plane.cues[i].n3_var);
    EXPECT_EQ(sent.plane.cues[i].quality, back.plane.cues[i].quality);
    EXPECT_EQ(sent.plane.cues[i].innovation, back.plane.cues[i].innovation);
    EXPECT_EQ(sent.plane.cues[i].test_ratio, back.plane.cues[i].test_ratio);
  }
  EXPECT_EQ(sent.ego.status, back.ego.status);
  EXPECT_EQ(sent.ego.reason, back.ego.reason);
  EXPECT_EQ(sent.ego.reset_counter, back.ego.reset_counter);
  EXPECT_TRUE(sent.ego.T_prev_cam.R.isApprox(back.ego.T_prev_cam.R, 1e-14));
  EXPECT_EQ(sent.ego.T_prev_cam.t, back.ego.T_prev_cam.t);
  EXPECT_EQ(sent.ego.cov_prev_cam, back.ego.cov_prev_cam);
  EXPECT_EQ(sent.ego.velocity_ground_m_s, back.ego.velocity_ground_m_s);
  EXPECT_EQ(sent.ego.speed_std_m_s, back.ego.speed_std_m_s);
  EXPECT_EQ(sent.ego.rate_ground_rad_s, back.ego.rate_ground_rad_s);
  EXPECT_EQ(sent.ego.yaw_rate_std_rad_s, back.ego.yaw_rate_std_rad_s);
  EXPECT_EQ(sent.ego.accel_forward_m_s2, back.ego.accel_forward_m_s2);
  EXPECT_EQ(sent.ego.accel_forward_std_m_s2, back.ego.accel_forward_std_m_s2);
  EXPECT_EQ(sent.ego.T_world_cam.t, back.ego.T_world_cam.t);
  EXPECT_EQ(sent.ego.cov_world_cam, back.ego.cov_world_cam);
  EXPECT_EQ(sent.ego.distance_m, back.ego.distance_m);
  EXPECT_EQ(sent.ego.log_scale, back.ego.log_scale);
  EXPECT_EQ(sent.ego.log_scale_std, back.ego.log_scale_std);
}

TEST(GroundWire, RefusesAnInvalidPlaneWhoseStatusSaysThatItIsValid) {
  EXPECT_EQ("", refused_plane([](ground_plane_t*) {}));
  const std::string none = "ground plane: its status says that the plane is valid, but it is not";
  EXPECT_EQ(none, refused_plane([](ground_plane_t* m) { m->normal_cam[1] = 0.9; }));
  EXPECT_EQ(none, refused_plane([](ground_plane_t* m) { m->normal_cam[0] = kNan; }));
  EXPECT_EQ(none, refused_plane([](ground_plane_t* m) { m->height_m = 0.0; }));
  EXPECT_EQ(none, refused_plane([](ground_plane_t* m) { m->height_m = kInf; }));
  EXPECT_EQ(none, refused_plane([](ground_plane_t* m) { m->pitch_rad = kNan; }));
  EXPECT_EQ("", refused_plane([](ground_plane_t* m) {
              m->status = ground_plane_t::STATUS_INVALID;
              m->height_m = 0.0;
            }))
      << "an invalid plane may contain any values";
}

TEST(GroundWire, RefusesUnknownNumbersInThePlane) {
  EXPECT_EQ("ground plane: unknown status", refused_plane([](auto* m) { m->status = 4; }));
  EXPECT_EQ("ground plane: unknown reason", refused_plane([](auto* m) { m->reason = -1; }));
  const std::string wrong_number = "ground plane: wrong number of cues";
  EXPECT_EQ(wrong_number, refused_plane([](auto* m) { m->num_cues = 5; })) << "4 are there";
  EXPECT_EQ(wrong_number, refused_plane([](auto* m) { m->num_cues = -1; }));
  EXPECT_EQ(wrong_number, refused_plane([](auto* m) {
              m->num_cues = ground_plane_t::MAX_CUES + 1;
              m->cues.resize(ground_plane_t::MAX_CUES + 1);
            }));
  EXPECT_EQ("ground plane: unknown cue status",
            refused_plane([](auto* m) { m->cues[2].status = 4; }));
  EXPECT_EQ("ground plane: not a covariance", refused_plane([](auto* m) { m->cov[0][0] = -1.0; }));
  EXPECT_EQ("", refused_plane([](auto* m) { m->cues[0].height = kNan; })) << "not observed";
}

TEST(GroundWire, TakesMoreOrFewerCuesThanThisProgramKnows) {
  ground_plane_t plane{};
  ego_motion_t ego{};
  to_wire(test::sample_ground_output(), &plane);
  to_wire(test::sample_ground_output(), &ego);
  ASSERT_EQ(plane.cues.size(), kNumCues);
  GroundOutput read;
  plane.num_cues = 1;
  plane.cues.resize(1);
  ASSERT_EQ(from_wire(plane, ego, &read), nullptr);
  EXPECT_EQ(read.plane.cues[kCueDense].status, CueStatus::kGated);
  EXPECT_EQ(read.plane.cues[kCuePoints].status, CueStatus::kAbsent);
  EXPECT_TRUE(std::isnan(read.plane.cues[kCuePoints].height));
  plane.num_cues = ground_plane_t::MAX_CUES;
  plane.cues.resize(ground_plane_t::MAX_CUES);
  plane.cues.back().status = static_cast<std::int8_t>(CueStatus::kFailed);
  EXPECT_EQ(from_wire(plane, ego, &read), nullptr);
  plane.cues.back().status = 9;
  EXPECT_STREQ(from_wire(plane, ego, &read), "ground plane: unknown cue status");
}

/// "const int8_t CUE_DENSE = 0;" lines of ground_plane_t.lcm, in order: the message names its cues
/// as kCueTable does.
TEST(GroundWire, TheMessageNamesTheCuesOfTheTable) {
  std::ifstream file(std::string(PLUMB_SOURCE_DIR) + "/lcmtypes/ground_plane_t.lcm");
  ASSERT_TRUE(file.good());
  std::size_t num = 0;
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(" CUE_");
    if (line.find("const int8_t") == std::string::npos || at == std::string::npos) continue;
    ASSERT_LT(num, kNumCues) << line;
    std::string name = kCueTable[num].name;
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(line.substr(at + 5, name.size() + 1), name + " ") << line;
    EXPECT_NE(line.find("= " + std::to_string(num) + ";"), std::string::npos) << line;
    ++num;
  }
  EXPECT_EQ(num, kNumCues);
}

TEST(GroundWire, RefusesAMotionThatIsNone) {
  EXPECT_EQ("ego motion: unknown status", refused_ego([](auto* m) { m->status = 6; }));
  EXPECT_EQ("ego motion: unknown reason", refused_ego([](auto* m) { m->reason = 29; }));
  EXPECT_EQ("ego motion: a pose is not a pose",
            refused_ego([](auto* m) { m->q_world_cam[3] = 2; }));
  EXPECT_EQ("ego motion: not a covariance",
            refused_ego([](auto* m) { m->cov_world_cam[5][0] = kNan; }));
  const std::string number = "ego motion: a velocity, rate or scale is not a number";
  EXPECT_EQ(number, refused_ego([](auto* m) { m->velocity_ground_m_s[0] = kNan; }));
  EXPECT_EQ(number, refused_ego([](auto* m) { m->speed_std_m_s = -1.0; }));
  EXPECT_EQ(number, refused_ego([](auto* m) { m->rate_ground_rad_s[2] = kInf; }));
  EXPECT_EQ(number, refused_ego([](auto* m) { m->log_scale = kNan; }));
  EXPECT_EQ("", refused_ego([](auto* m) { m->accel_forward_m_s2 = kNan; })) << "not observable";
}

TEST(GroundWire, TakesInvalidRatesWhenTheMotionSaysSo) {
  ground_plane_t plane{};
  ego_motion_t ego{};
  to_wire(test::sample_ground_output(), &plane);
  to_wire(test::sample_ground_output(), &ego);
  ego.log_scale = ego.velocity_ground_m_s[0] = kNan;
  GroundOutput read;
  EXPECT_NE(from_wire(plane, ego, &read), nullptr);
  for (const auto status : {ego_motion_t::STATUS_INITIALIZING, ego_motion_t::STATUS_LOST}) {
    ego.status = status;
    EXPECT_EQ(from_wire(plane, ego, &read), nullptr);
    EXPECT_EQ(static_cast<std::int8_t>(read.ego.status), status);
  }
}

TEST(GroundWire, TakesAStandstillBeforeAnyScaleIsKnown) {
  EXPECT_EQ("", refused_ego([](auto* m) {
              m->status = ego_motion_t::STATUS_STANDSTILL;
              m->log_scale_std = kNan;
            }));
}

TEST(GroundWire, RefusesMessagesOfDifferentImages) {
  const std::string apart = "ground plane and ego motion are of different images";
  EXPECT_EQ(apart, refused_ego([](auto* m) { m->seq = 43; }));
  EXPECT_EQ(apart, refused_plane([](auto* m) { m->utime += 1; }));
}

TEST(GroundWire, AWithheldPlaneIsSoundAndNotValid) {
  ground_plane_t plane{};
  ego_motion_t ego{};
  to_wire(test::sample_ground_output(), &plane);
  to_wire(test::sample_ground_output(), &ego);
  withhold_plane(&plane);
  GroundOutput out;
  EXPECT_EQ(from_wire(plane, ego, &out), nullptr);
  EXPECT_EQ(out.plane.status, GroundStatus::kInitializing);
  EXPECT_TRUE(std::isnan(out.plane.height_m));
  EXPECT_TRUE(std::isnan(out.plane.cov(2, 2)));
}

}  // namespace
}  // namespace plumb
