// Tests which objects of a list reach the bus, in which order, and what a receiver reads.
#include "modules/can/can_object_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/numbers.hpp"
#include "modules/can/can_gate.hpp"
#include "modules/can/can_wire.hpp"
#include "plumb/detection_t.hpp"
#include "tests/can/from_wire.hpp"
#include "tests/can/reading.hpp"

namespace plumb {
namespace {

struct Recorder final : CanSink {
  std::vector<CanFrame> frames;
  void send(std::int64_t /*time_us*/, const CanFrame& frame) override { frames.push_back(frame); }
};

object_t object_at(double x_m, double y_m, std::int32_t id = 5) {
  object_t o{};
  o.track_id = id;
  o.class_id = detection_t::CLASS_CAR;
  o.position_ground_m[0] = x_m;
  o.position_ground_m[1] = y_m;
  o.position_cov_m2[0][0] = 0.25;
  o.position_cov_m2[1][1] = 0.04;
  o.velocity_ground_m_s[0] = -12.0;
  o.velocity_ground_m_s[1] = 0.5;
  o.velocity_cov_m2_s2[0][0] = 1.0;
  o.velocity_cov_m2_s2[1][1] = 0.25;
  o.size_m[1] = 1.7;
  o.time_to_collision_s = 2.5;
  o.age_s = 1.2;
  return o;
}

objects_t list_of(std::int64_t seq, std::vector<object_t> objects, std::int32_t num_refused = 0) {
  objects_t message{};
  message.seq = seq;
  message.num_objects = static_cast<std::int32_t>(objects.size());
  message.objects = std::move(objects);
  message.num_refused = num_refused;
  return message;
}

class ObjectGate : public testing::Test {
 protected:
  void give(objects_t message) {
    if (message.capture_mono_us == 0) message.capture_mono_us = now_us_;
    CanObjects objects;
    ASSERT_EQ(test::from_wire(message, test::default_messages(), &objects), nullptr);
    gate_.on_objects(objects, now_us_);
  }
  /// Returns the frames that the next tick sends.
  std::vector<CanFrame> tick() {
    sink_.frames.clear();
    gate_.tick(now_us_, sink_);
    now_us_ += CanGate::kTickUs;
    return sink_.frames;
  }
  static test::Reading read(const CanFrame& frame) {
    test::Reading values;
    for (const Message& message : test::default_messages()) {
      if (message.address.id != frame.id) continue;
      EXPECT_TRUE(values.read(message, frame)) << frame.id;
    }
    return values;
  }
  CanObjectGate gate_{CanConfig{}, test::default_messages()};
  Recorder sink_;
  std::int64_t now_us_ = 1'000'000;
};

TEST_F(ObjectGate, IsSilentUntilAListCame) {
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(tick().empty());
}

TEST_F(ObjectGate, SendsAListAndItsObjectsInOneBurst) {
  give(list_of(300, {object_at(20.0, -3.0, 7), object_at(8.0, 2.0, 300)}, 1));
  const std::vector<CanFrame> burst = tick();
  ASSERT_EQ(burst.size(), 7U);
  const std::uint32_t ids[] = {0x3B0, 0x3B1, 0x3B2, 0x3B3, 0x3B1, 0x3B2, 0x3B3};
  for (std::size_t i = 0; i < burst.size(); ++i) {
    EXPECT_EQ(burst[i].id, ids[i]);
    EXPECT_EQ(read(burst[i]).frame_counter(), 300 & 0xFF);
  }
  EXPECT_EQ(read(burst[0])["ObjList_Count"], 2.0);
  EXPECT_EQ(read(burst[0])["ObjList_NumLeftOut"], 1.0);
  const test::Reading near = read(burst[1]);  // nearest first
  EXPECT_EQ(near["ObjPos_Index"], 0.0);
  EXPECT_NEAR(near["Obj#_PosX"], 8.0, 0.026);
  EXPECT_NEAR(near["Obj#_PosY"], 2.0, 0.026);
  EXPECT_NEAR(near["Obj#_PosXStd"], 0.5, 0.026);
  EXPECT_NEAR(near["Obj#_PosYStd"], 0.2, 0.011);
  const test::Reading motion = read(burst[2]);
  EXPECT_NEAR(motion["Obj#_VelX"], -12.0, 0.026);
  EXPECT_NEAR(motion["Obj#_VelY"], 0.5, 0.011);
  EXPECT_NEAR(motion["Obj#_VelXStd"], 1.0, 0.026);
  const test::Reading state = read(burst[3]);
  EXPECT_EQ(state["Obj#_Id"], 300 % 255);
  EXPECT_EQ(state["Obj#_Class"], 1.0);
  EXPECT_EQ(state["Obj#_Status"], 0.0);
  EXPECT_NEAR(state["Obj#_Age"], 1.2, 0.051);
  EXPECT_NEAR(state["Obj#_TimeToCollision"], 2.5, 0.026);
  EXPECT_NEAR(state["Obj#_Width"], 1.7, 0.026);
  EXPECT_EQ(read(burst[4])["ObjPos_Index"], 1.0);
  EXPECT_NEAR(read(burst[4])["Obj#_PosX"], 20.0, 0.026);
}

TEST_F(ObjectGate, SendsEachListOnceAndThenOnlyThatNothingIsNew) {
  give(list_of(1, {object_at(10.0, 0.0)}));
  give(list_of(2, {object_at(11.0, 0.0)}));
  EXPECT_EQ(read(tick()[1]).frame_counter(), 1.0);
  EXPECT_EQ(read(tick()[1]).frame_counter(), 2.0);
  int num_lists = 0;
  for (int i = 0; i < 20; ++i) {  // 0.2 s
    for (const CanFrame& frame : tick()) {
      EXPECT_EQ(frame.id, 0x3B0U);
      EXPECT_EQ(read(frame)["ObjList_Count"], 1.0);
      EXPECT_EQ(read(frame).frame_counter(), 2.0);
      ++num_lists;
    }
  }
  EXPECT_EQ(num_lists, 2);
}

TEST_F(ObjectGate, SaysNotAvailableWithinOneCycleOfGoingStale) {
  give(list_of(1, {object_at(10.0, 0.0)}));
  const std::int64_t stale_us = now_us_ + 250'000;  // can.stale_s
  (void)tick();
  std::int64_t first_us = 0;
  while (first_us == 0 && now_us_ < stale_us + 1'000'000) {
    const std::int64_t at_us = now_us_;
    for (const CanFrame& frame : tick())
      if (std::isnan(read(frame)["ObjList_Count"])) first_us = at_us;
  }
  EXPECT_GT(first_us, stale_us);
  EXPECT_LE(first_us, stale_us + 100'000);
}

TEST_F(ObjectGate, AnEmptyListIsAList) {
  give(list_of(4, {}));
  const auto burst = tick();
  ASSERT_EQ(burst.size(), 1U);
  EXPECT_EQ(read(burst[0])["ObjList_Count"], 0.0);
}

TEST_F(ObjectGate, DropsTheOldestListsWhenTheyComeFasterThanTheyLeave) {
  for (int seq = 0; seq < 20; ++seq) give(list_of(seq, {}));
  EXPECT_EQ(gate_.num_overflowed(), 4);
  EXPECT_EQ(read(tick()[0]).frame_counter(), 4.0);
}

TEST_F(ObjectGate, WhatIsBeyondItsRangeOrNotKnownIsNotAvailable) {
  object_t far = object_at(900.0, -500.0);
  far.velocity_ground_m_s[0] = kNan;
  far.time_to_collision_s = kNan;
  give(list_of(1, {far}));
  const auto burst = tick();
  for (const char* const name : {"Obj#_PosX", "Obj#_PosY", "Obj#_PosXStd", "Obj#_PosYStd"})
    EXPECT_TRUE(std::isnan(read(burst[1])[name])) << name;
  EXPECT_TRUE(std::isnan(read(burst[2])["Obj#_VelX"]));
  EXPECT_TRUE(std::isnan(read(burst[2])["Obj#_VelY"]));
  EXPECT_TRUE(std::isnan(read(burst[3])["Obj#_TimeToCollision"]));
  EXPECT_NEAR(read(burst[3])["Obj#_Width"], 1.7, 0.026);
}

TEST_F(ObjectGate, APlaceWhoseDeviationIsBeyondItsRangeIsNotSent) {
  object_t vague = object_at(30.0, 2.0);
  vague.position_cov_m2[0][0] = 1e6;
  give(list_of(1, {vague}));
  const auto burst = tick();
  EXPECT_TRUE(std::isnan(read(burst[1])["Obj#_PosX"]));
  EXPECT_TRUE(std::isnan(read(burst[1])["Obj#_PosXStd"]));
  EXPECT_NEAR(read(burst[1])["Obj#_PosY"], 2.0, 0.026);
}

TEST_F(ObjectGate, TimesStayAtTheEndOfTheirRanges) {
  object_t old = object_at(30.0, 2.0);
  old.age_s = 1e6;
  old.time_to_collision_s = 900.0;
  give(list_of(1, {old}));
  const auto burst = tick();
  EXPECT_NEAR(read(burst[3])["Obj#_Age"], 51.0, 1e-6);
  EXPECT_NEAR(read(burst[3])["Obj#_TimeToCollision"], 25.5, 1e-6);
}

TEST_F(ObjectGate, CountsTheAgeFromTheCaptureOfTheImage) {
  objects_t message = list_of(1, {object_at(10.0, 0.0)});
  message.capture_mono_us = now_us_ - 200'000;
  give(message);
  EXPECT_NEAR(read(tick()[0])["ObjList_Age"], 0.2, 0.0006);
  EXPECT_EQ(gate_.num_late(), 0);

  message.seq = 2;
  message.capture_mono_us = now_us_ - 251'000;
  give(message);
  const auto burst = tick();
  ASSERT_EQ(burst.size(), 1U) << "no object of a list that is too old";
  EXPECT_TRUE(std::isnan(read(burst[0])["ObjList_Count"]));
  EXPECT_TRUE(std::isnan(read(burst[0])["ObjList_NumLeftOut"]));
  EXPECT_NEAR(read(burst[0])["ObjList_Age"], 0.251, 0.0006);
  EXPECT_EQ(gate_.num_late(), 1);
}

TEST_F(ObjectGate, AnUnknownOrFutureCaptureTimeIsNotAvailable) {
  CanObjects objects;
  objects.seq = 3;
  for (const std::int64_t capture_us : {std::int64_t{0}, now_us_ + 1'000'000}) {
    objects.capture_mono_us = capture_us;
    gate_.on_objects(objects, now_us_);
    const auto burst = tick();
    ASSERT_EQ(burst.size(), 1U);
    EXPECT_TRUE(std::isnan(read(burst[0])["ObjList_Count"]));
    EXPECT_TRUE(std::isnan(read(burst[0])["ObjList_Age"]));
  }
}

TEST_F(ObjectGate, PassesOverListsThatBecameTooOldWhileTheyWaited) {
  for (int seq = 0; seq < 10; ++seq) give(list_of(seq, {object_at(10.0, 0.0)}));
  now_us_ += 3'000'000;
  give(list_of(10, {object_at(10.0, 0.0)}));
  const auto burst = tick();
  ASSERT_EQ(burst.size(), 4U);
  EXPECT_EQ(read(burst[0]).frame_counter(), 10.0);
  EXPECT_EQ(gate_.num_overflowed(), 10);
}

TEST(CanObjectsWire, KeepsTheNearestAndCountsTheRest) {
  std::vector<object_t> objects;
  for (int i = 0; i < 20; ++i) objects.push_back(object_at(5.0 + (i * 7) % 20, 0.0, i));
  objects[3].status = object_t::STATUS_NOT_LOCALISED;
  objects[3].position_ground_m[0] = kNan;  // no other value of it is valid
  CanObjects list;
  ASSERT_EQ(test::from_wire(list_of(9, objects, 2), test::default_messages(), &list), nullptr);
  ASSERT_EQ(list.counts.num_objects, kMaxCanObjects);
  EXPECT_EQ(list.counts.num_left_out, 20 - 8 + 2);
  double last = 0.0;
  for (const SourceValues& object : list.objects) {
    const double x_m = object[0];  // the first of the position's signals
    EXPECT_GE(x_m, last);
    last = x_m;
  }
  EXPECT_LE(last, 13.0);
}

TEST(CanObjectsWire, RefusesABrokenMessage) {
  CanObjects list;
  const auto refused = [&list](void (*spoil)(objects_t*)) {
    objects_t message = list_of(1, {object_at(5.0, 0.0), object_at(6.0, 0.0)});
    spoil(&message);
    return test::from_wire(message, test::default_messages(), &list) != nullptr;
  };
  EXPECT_FALSE(refused([](objects_t*) {}));
  EXPECT_TRUE(refused([](objects_t* m) { m->seq = -1; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->num_objects = 3; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->num_refused = -1; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->objects[1].status = 7; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->objects[1].class_id = -1; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->objects[0].position_ground_m[1] = kNan; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->objects[0].position_cov_m2[1][1] = -1.0; }));
  EXPECT_TRUE(refused([](objects_t* m) { m->objects[0].size_m[1] = kNan; }));
}

}  // namespace
}  // namespace plumb
