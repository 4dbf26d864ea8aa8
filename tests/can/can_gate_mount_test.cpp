// The mount's status: when it reaches the bus, when it is not available, and what of MOUNT is believed.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/can/can_wire.hpp"
#include "tests/can/gate_fixture.hpp"

namespace plumb {
namespace {

using namespace test;  // NOLINT: the fixture and its samples

constexpr std::int64_t kStaleUs = 3'000'000;

mount_t make_mount(std::int8_t status) {
  mount_t m{};
  m.status = status;
  m.reason = mount_t::REASON_TURNING;
  m.progress = status >= mount_t::STATUS_STEADY ? 1.0 : 0.35;
  const bool has_reference = status >= mount_t::STATUS_STEADY;
  for (int i = 0; i < 3; ++i) {
    m.reference_rad[i] = has_reference ? 0.01 : kNan;
    m.recent_rad[i] = 0.01 + 0.02 * (i + 1);
  }
  return m;
}

class GateMount : public GateFixture {
 protected:
  void hear(std::int8_t status) {
    CanMount mount;
    ASSERT_TRUE(from_wire(make_mount(status), &mount));
    gate_.on_mount(mount, now_us_);
  }
  std::vector<CanValues> sent() { return sink_.all("PLB_Mount"); }
};

TEST_F(GateMount, IsNotAvailableWhileMountNeverCame) {
  for (int seq = 0; seq < 300; ++seq) {
    give(seq);
    tick();
  }
  ASSERT_EQ(sent().size(), 3U) << "once a second";
  for (const CanValues& v : sent()) {
    for (const double value : {v.mount_status, v.mount_reason, v.mount_progress, v.mount_pitch_rad,
                               v.mount_roll_rad, v.mount_yaw_rad}) {
      EXPECT_TRUE(std::isnan(value));
    }
  }
}

TEST_F(GateMount, IsSentAtTheNextTickAndThenByItsCycle) {
  tick(30);
  sink_.sent.clear();
  hear(mount_t::STATUS_MOVED);
  tick();
  ASSERT_EQ(sent().size(), 1U);
  const CanValues v = sent().back();
  EXPECT_EQ(v.mount_status, static_cast<double>(CanMountStatus::kMoved));
  EXPECT_EQ(v.mount_reason, static_cast<double>(mount_t::REASON_TURNING));
  EXPECT_NEAR(v.mount_progress, 1.0, 0.0025);
  EXPECT_NEAR(v.mount_pitch_rad, 0.02, 0.0001);
  EXPECT_NEAR(v.mount_roll_rad, 0.04, 0.0001);
  EXPECT_NEAR(v.mount_yaw_rad, 0.06, 0.0001);
  tick(99);
  EXPECT_EQ(sent().size(), 1U);
  tick();
  EXPECT_EQ(sent().size(), 2U) << "its cycle began anew";
}

TEST_F(GateMount, WithoutAReferenceThereIsProgressButNoChange) {
  for (const std::int8_t status : {mount_t::STATUS_COLLECTING, mount_t::STATUS_UNSTEADY}) {
    hear(status);
    tick();
    EXPECT_EQ(sent().back().mount_status, static_cast<double>(status));
    EXPECT_NEAR(sent().back().mount_progress, 0.35, 0.0025);
    EXPECT_TRUE(std::isnan(sent().back().mount_yaw_rad));
  }
}

TEST_F(GateMount, StaleIsNotAvailableWithinOneCycle) {
  hear(mount_t::STATUS_STEADY);
  const std::int64_t heard_us = now_us_;
  std::int64_t absent_us = 0;
  for (int i = 0; i < 500; ++i) {
    sink_.sent.clear();
    give(i);  // images go on: the mount has an age of its own
    tick();
    const std::vector<CanValues> now = sent();
    if (now.empty()) continue;
    const std::int64_t age_us = sink_.sent.back().time_us - heard_us;
    EXPECT_EQ(std::isnan(now.back().mount_status), age_us > kStaleUs) << age_us;
    if (absent_us == 0 && std::isnan(now.back().mount_status)) absent_us = age_us;
  }
  EXPECT_GT(absent_us, kStaleUs);
  EXPECT_LE(absent_us, kStaleUs + 1'000'000);
  hear(mount_t::STATUS_STEADY);
  tick();
  EXPECT_EQ(sink_.newest().mount_status, static_cast<double>(CanMountStatus::kSteady));
}

TEST_F(GateMount, DoesNotNeedImages) {
  hear(mount_t::STATUS_STEADY);
  tick(200);
  EXPECT_TRUE(std::isnan(sink_.newest().ego_validity));
  EXPECT_EQ(sink_.newest().mount_status, static_cast<double>(CanMountStatus::kSteady));
}

TEST_F(GateMount, TwoBetweenTicksAreBothSentInOrder) {
  hear(mount_t::STATUS_STEADY);
  hear(mount_t::STATUS_MOVED);
  EXPECT_FALSE(gate_.idle());
  tick(2);
  EXPECT_TRUE(gate_.idle());
  ASSERT_EQ(sent().size(), 2U);
  EXPECT_EQ(sent()[0].mount_status, static_cast<double>(CanMountStatus::kSteady));
  EXPECT_EQ(sent()[1].mount_status, static_cast<double>(CanMountStatus::kMoved));
}

TEST_F(GateMount, OfTooManyTheNewestAreSent) {
  for (int i = 0; i < 10; ++i) hear(mount_t::STATUS_STEADY);
  hear(mount_t::STATUS_MOVED);
  tick(20);
  EXPECT_EQ(sink_.newest().mount_status, static_cast<double>(CanMountStatus::kMoved));
  EXPECT_EQ(sent().size(), CanGate::kMaxPendingMounts);
}

TEST_F(GateMount, AClockThatRunsBackwardsMakesItNotAvailable) {
  hear(mount_t::STATUS_STEADY);
  tick();
  now_us_ = -5;
  tick(100);
  EXPECT_TRUE(std::isnan(sent().back().mount_status));
}

TEST(CanMountWire, RefusesABrokenMessage) {
  CanMount mount;
  const auto refused = [&mount](std::int8_t status, auto spoil) {
    mount_t message = make_mount(status);
    spoil(message);
    return !from_wire(message, &mount);
  };
  const auto nothing = [](mount_t&) {};
  for (std::int8_t status = 0; status < 4; ++status) EXPECT_FALSE(refused(status, nothing));
  const std::int8_t moved = mount_t::STATUS_MOVED;
  EXPECT_TRUE(refused(moved, [](mount_t& m) { m.status = -1; }));
  EXPECT_TRUE(refused(moved, [](mount_t& m) { m.status = 4; }));
  EXPECT_TRUE(refused(moved, [](mount_t& m) { m.reason = -1; }));
  EXPECT_TRUE(refused(moved, [](mount_t& m) { m.reason = 15; }));
  for (const double bad : {kNan, -0.01, 1.01, kInf}) {
    EXPECT_TRUE(refused(moved, [bad](mount_t& m) { m.progress = bad; })) << bad;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(refused(moved, [i](mount_t& m) { m.reference_rad[i] = kNan; }));
    EXPECT_TRUE(refused(moved, [i](mount_t& m) { m.recent_rad[i] = kNan; }));
    EXPECT_TRUE(refused(moved, [i](mount_t& m) { m.recent_rad[i] = kInf; }));
  }
}

TEST(CanMountWire, AReferenceOfAnEarlierRunIsSteadyBeforeTheFirstStretch) {
  mount_t message = make_mount(mount_t::STATUS_STEADY);
  for (double& angle_rad : message.recent_rad) angle_rad = kNan;
  CanMount mount;
  ASSERT_TRUE(from_wire(message, &mount));
  EXPECT_EQ(mount.status, CanMountStatus::kSteady);
  EXPECT_TRUE(std::isnan(mount.yaw_rad));
}

TEST(CanMountWire, ARejectedMessageIsCountedAndNotSent) {
  CanOutput output{CanConfig{}};
  RecordingSink sink;
  EXPECT_FALSE(output.on_mount(make_mount(9), 0));
  EXPECT_EQ(output.num_rejected(), 1);
  output.tick(0, sink);
  EXPECT_TRUE(std::isnan(sink.newest().mount_status));
}

TEST(CanMountWire, FinishSendsTheLastOne) {
  CanOutput output{CanConfig{}};
  RecordingSink sink;
  output.advance(1'000'000, sink);
  EXPECT_TRUE(output.on_mount(make_mount(mount_t::STATUS_MOVED), 1'000'000));
  output.finish(sink);
  EXPECT_EQ(sink.newest().mount_status, static_cast<double>(CanMountStatus::kMoved));
}

}  // namespace
}  // namespace plumb
