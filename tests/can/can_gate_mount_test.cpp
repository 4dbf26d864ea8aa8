// Tests when the mount's status reaches the bus, when it is not available, and which MOUNT messages
// are refused.
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
  void hear(std::int8_t status) { gate_.on_mount(sample_of(make_mount(status)), now_us_); }
  std::vector<Reading> sent() { return sink_.all("Mount"); }
};

TEST_F(GateMount, IsNotAvailableWhileMountNeverCame) {
  for (int seq = 0; seq < 300; ++seq) {
    give(seq);
    tick();
  }
  ASSERT_EQ(sent().size(), 3U) << "once a second";
  for (const Reading& v : sent()) {
    for (const double value :
         {v["Mount_Status"], v["Mount_Reason"], v["Mount_Progress"], v["Mount_PitchChange"],
          v["Mount_RollChange"], v["Mount_YawChange"]}) {
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
  const Reading v = sent().back();
  EXPECT_EQ(v["Mount_Status"], mount_t::STATUS_MOVED);
  EXPECT_EQ(v["Mount_Reason"], static_cast<double>(mount_t::REASON_TURNING));
  EXPECT_NEAR(v["Mount_Progress"], 1.0, 0.0025);
  EXPECT_NEAR(v["Mount_PitchChange"], 0.02, 0.0001);
  EXPECT_NEAR(v["Mount_RollChange"], 0.04, 0.0001);
  EXPECT_NEAR(v["Mount_YawChange"], 0.06, 0.0001);
  tick(99);
  EXPECT_EQ(sent().size(), 1U);
  tick();
  EXPECT_EQ(sent().size(), 2U) << "its cycle began anew";
}

TEST_F(GateMount, WithoutAReferenceThereIsProgressButNoChange) {
  for (const std::int8_t status : {mount_t::STATUS_COLLECTING, mount_t::STATUS_UNSTEADY}) {
    hear(status);
    tick();
    EXPECT_EQ(sent().back()["Mount_Status"], static_cast<double>(status));
    EXPECT_NEAR(sent().back()["Mount_Progress"], 0.35, 0.0025);
    EXPECT_TRUE(std::isnan(sent().back()["Mount_YawChange"]));
  }
}

TEST_F(GateMount, StaleIsNotAvailableWithinOneCycle) {
  hear(mount_t::STATUS_STEADY);
  const std::int64_t heard_us = now_us_;
  std::int64_t absent_us = 0;
  for (int i = 0; i < 500; ++i) {
    sink_.sent.clear();
    give(i);  // images go on, but the mount has an age of its own
    tick();
    const std::vector<Reading> now = sent();
    if (now.empty()) continue;
    const std::int64_t age_us = sink_.sent.back().time_us - heard_us;
    EXPECT_EQ(std::isnan(now.back()["Mount_Status"]), age_us > kStaleUs) << age_us;
    if (absent_us == 0 && std::isnan(now.back()["Mount_Status"])) absent_us = age_us;
  }
  EXPECT_GT(absent_us, kStaleUs);
  EXPECT_LE(absent_us, kStaleUs + 1'000'000);
  hear(mount_t::STATUS_STEADY);
  tick();
  EXPECT_EQ(sink_.newest()["Mount_Status"], mount_t::STATUS_STEADY);
}

TEST_F(GateMount, DoesNotNeedImages) {
  hear(mount_t::STATUS_STEADY);
  tick(200);
  EXPECT_TRUE(std::isnan(sink_.newest()["EgoMotion_Validity"]));
  EXPECT_EQ(sink_.newest()["Mount_Status"], mount_t::STATUS_STEADY);
}

TEST_F(GateMount, TwoBetweenTicksAreBothSentInOrder) {
  hear(mount_t::STATUS_STEADY);
  hear(mount_t::STATUS_MOVED);
  EXPECT_FALSE(gate_.idle());
  tick(2);
  EXPECT_TRUE(gate_.idle());
  ASSERT_EQ(sent().size(), 2U);
  EXPECT_EQ(sent()[0]["Mount_Status"], mount_t::STATUS_STEADY);
  EXPECT_EQ(sent()[1]["Mount_Status"], mount_t::STATUS_MOVED);
}

TEST_F(GateMount, OfTooManyTheNewestAreSent) {
  for (int i = 0; i < 10; ++i) hear(mount_t::STATUS_STEADY);
  hear(mount_t::STATUS_MOVED);
  tick(20);
  EXPECT_EQ(sink_.newest()["Mount_Status"], mount_t::STATUS_MOVED);
  EXPECT_EQ(sent().size(), CanGate::kMaxPendingMounts);
}

TEST_F(GateMount, AClockThatRunsBackwardsMakesItNotAvailable) {
  hear(mount_t::STATUS_STEADY);
  tick();
  now_us_ = -5;
  tick(100);
  EXPECT_TRUE(std::isnan(sent().back()["Mount_Status"]));
}

TEST(CanMountWire, RefusesABrokenMessage) {
  CanSample mount;
  const auto refused = [&mount](std::int8_t status, auto spoil) {
    mount_t message = make_mount(status);
    spoil(message);
    return from_wire(message, default_messages(), &mount) != nullptr;
  };
  const auto nothing = [](mount_t&) {};
  for (std::int8_t status = 0; status < 5; ++status) EXPECT_FALSE(refused(status, nothing));
  const std::int8_t moved = mount_t::STATUS_MOVED;
  EXPECT_TRUE(refused(moved, [](mount_t& m) { m.status = -1; }));
  EXPECT_TRUE(refused(moved, [](mount_t& m) { m.status = 5; }));
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
  CanSample mount;
  ASSERT_EQ(from_wire(message, default_messages(), &mount), nullptr);
  CanGate gate{CanConfig{}, default_messages()};
  RecordingSink sink;
  gate.on_mount(mount, 0);
  gate.tick(0, sink);
  EXPECT_EQ(sink.newest()["Mount_Status"], mount_t::STATUS_STEADY);
  EXPECT_TRUE(std::isnan(sink.newest()["Mount_YawChange"]));
}

TEST(CanMountWire, ARejectedMessageIsCountedAndNotSent) {
  CanOutput output{CanConfig{}};
  RecordingSink sink;
  EXPECT_STREQ(output.on_mount(make_mount(9), 0), "unknown status");
  EXPECT_EQ(output.num_rejected(), 1);
  output.tick(0, sink);
  EXPECT_TRUE(std::isnan(sink.newest()["Mount_Status"]));
}

TEST(CanMountWire, FinishSendsTheLastOne) {
  CanOutput output{CanConfig{}};
  RecordingSink sink;
  output.advance(1'000'000, sink);
  EXPECT_EQ(output.on_mount(make_mount(mount_t::STATUS_MOVED), 1'000'000), nullptr);
  output.finish(sink);
  EXPECT_EQ(sink.newest()["Mount_Status"], mount_t::STATUS_MOVED);
}

}  // namespace
}  // namespace plumb
