/// Tests that DETECTIONS in a log give objects on the road, in messages, rows and CAN frames.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/chain/chain.hpp"
#include "tests/replay/street_boxes.hpp"
#include "tools/run/replay/objects_csv.hpp"

namespace plumb {
namespace {

struct CanCounter final : CanSink {
  int num_lists = 0;
  int num_objects = 0;
  void send(std::int64_t /*time_us*/, const CanFrame& frame) override {
    num_lists += frame.id == 0x3B0 ? 1 : 0;
    num_objects += frame.id == 0x3B1 ? 1 : 0;
  }
};

std::vector<objects_t> replay_objects(const std::vector<test::StoredEvent>& events, CanSink* can) {
  std::vector<objects_t> lists;
  Chain replay(
      PlumbConfig{}, 1, can, [](const FrameRecord&) {},
      [&](const objects_t& objects) { lists.push_back(objects); });
  for (const test::StoredEvent& event : events) replay.take(event.view());
  replay.finish();
  EXPECT_EQ(replay.num_refused(), 0) << replay.first_refusal();
  return lists;
}

TEST(ReplayObjects, FindsAParkedCarWhereItStands) {
  const auto lists = replay_objects(test::with_boxes(test::street_events()), nullptr);
  ASSERT_EQ(lists.size(), static_cast<std::size_t>(test::kLastBoxFrame) + 1);
  for (const objects_t& list : lists) {
    ASSERT_EQ(list.num_objects, 1) << list.seq;
    const object_t& car = list.objects[0];
    EXPECT_EQ(car.track_id, 4);
    if (list.seq < 10) continue;
    const double rear_m =
        test::kParked_m - test::street_drive()[static_cast<std::size_t>(list.seq)].t.z();
    const double rear_seen_m = car.position_ground_m[0] - 0.5 * car.size_m[0];
    EXPECT_NEAR(rear_seen_m, rear_m, 0.12 * rear_m) << list.seq;
    EXPECT_NEAR(car.position_ground_m[1], test::kParkedLeft_m, 0.5) << list.seq;
    EXPECT_LT(std::abs(rear_seen_m - rear_m), 4.0 * std::sqrt(car.position_cov_m2[0][0]));
  }
  const object_t& last = lists.back().objects[0];
  EXPECT_LT(std::abs(last.velocity_ground_m_s[0]), 3.0) << "we drive 9 m/s, it stands";
}

TEST(ReplayObjects, GivesTheSameBitsEveryTime) {
  const auto a = replay_objects(test::with_boxes(test::street_events()), nullptr);
  const auto b = replay_objects(test::with_boxes(test::street_events()), nullptr);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(test::stored(0, kObjects, a[i]).data, test::stored(0, kObjects, b[i]).data);
    for (const object_t& object : a[i].objects)
      EXPECT_EQ(objects_csv_row(a[i], object), objects_csv_row(b[i], object));
  }
}

TEST(ReplayObjects, ReachCanOncePerImage) {
  CanCounter can;
  (void)replay_objects(test::with_boxes(test::street_events()), &can);
  // The age of the first images is not known.
  constexpr int kNumUnknown = 3;
  EXPECT_EQ(can.num_objects, test::kLastBoxFrame + 1 - kNumUnknown);
  EXPECT_GE(can.num_lists, test::kLastBoxFrame + 1 - kNumUnknown);
}

TEST(ReplayObjects, RefusesDetectionsThatDoNotDecode) {
  std::vector<test::StoredEvent> events = test::with_boxes(test::street_events());
  for (test::StoredEvent& event : events) {
    if (event.channel != kDetections.name) continue;
    event.data.resize(event.data.size() - 3);
    break;
  }
  std::int64_t num_lists = 0;
  Chain replay(
      PlumbConfig{}, 1, nullptr, [](const FrameRecord&) {}, [&](const objects_t&) { ++num_lists; });
  for (const test::StoredEvent& event : events) replay.take(event.view());
  EXPECT_EQ(replay.num_refused(), 1);
  EXPECT_EQ(replay.first_refusal(), "DETECTIONS: not a detections_t");
  EXPECT_EQ(num_lists, test::kLastBoxFrame);
}

}  // namespace
}  // namespace plumb
