/// DETECTIONS in a log: objects on the road, in messages, rows and CAN frames.
#include <gtest/gtest.h>

#include <cmath>

#include "modules/detections/detections_wire.hpp"
#include "tests/replay/street_log.hpp"
#include "tools/replay/objects_csv.hpp"
#include "tools/replay/replay.hpp"

namespace plumb {
namespace {

constexpr double kParked_m = 45.0;  // from the first image, straight ahead
constexpr double kLeft_m = 2.5;
constexpr std::int64_t kLastFrame = 20;  // before the street bends

/// The parked car's rear, 1.53 m high and 1.67 m wide, as a detector boxes it from 1.65 m above the road.
DetectionFrame boxes_of(std::int64_t seq) {
  const CameraModel camera = test::scene_camera();
  const double ahead_m = kParked_m - test::street_drive()[static_cast<std::size_t>(seq)].t.z();
  const auto column = [&](double left_m) { return camera.cx_px - camera.fx_px * left_m / ahead_m; };
  const auto row = [&](double up_m) {
    return camera.cy_px + camera.fy_px * (1.65 - up_m) / ahead_m;
  };
  DetectionFrame frame;
  frame.capture_us = test::kStreetStart_us + seq * test::kStreetPeriod_us;
  frame.seq = seq;
  Detection car;
  car.track_id = 4;
  car.object_class = ObjectClass::kCar;
  car.score = 0.9;
  car.occluded = Occlusion::kVisible;
  car.box = {column(kLeft_m + 0.835), row(1.53), column(kLeft_m - 0.835), row(0.0)};
  (void)frame.detections.push_back(car);
  return frame;
}

std::vector<test::StoredEvent> events_with_boxes() {
  std::vector<test::StoredEvent> events;
  std::int64_t seq = 0;
  for (const test::StoredEvent& event : test::street_events()) {
    events.push_back(event);
    if (event.channel != kCamera.name || seq > kLastFrame) continue;
    detections_t message;
    to_wire(boxes_of(seq++), &message);
    events.push_back(test::stored(event.log_us, kDetections, message));
  }
  return events;
}

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
  Replay replay(
      PlumbConfig{}, 1, can, [](const FrameRecord&) {},
      [&](const objects_t& objects) { lists.push_back(objects); });
  for (const test::StoredEvent& event : events) replay.take(event.view());
  replay.finish();
  EXPECT_EQ(replay.num_refused(), 0) << replay.first_refusal();
  return lists;
}

TEST(ReplayObjects, FindsAParkedCarWhereItStands) {
  const auto lists = replay_objects(events_with_boxes(), nullptr);
  ASSERT_EQ(lists.size(), static_cast<std::size_t>(kLastFrame) + 1);
  for (const objects_t& list : lists) {
    ASSERT_EQ(list.num_objects, 1) << list.seq;
    const object_t& car = list.objects[0];
    EXPECT_EQ(car.track_id, 4);
    if (list.seq < 10) continue;
    const double rear_m =
        kParked_m - test::street_drive()[static_cast<std::size_t>(list.seq)].t.z();
    const double rear_seen_m = car.position_ground_m[0] - 0.5 * car.size_m[0];
    EXPECT_NEAR(rear_seen_m, rear_m, 0.12 * rear_m) << list.seq;
    EXPECT_NEAR(car.position_ground_m[1], kLeft_m, 0.5) << list.seq;
    EXPECT_LT(std::abs(rear_seen_m - rear_m), 4.0 * std::sqrt(car.position_cov_m2[0][0]));
  }
  const object_t& last = lists.back().objects[0];
  EXPECT_LT(std::abs(last.velocity_ground_m_s[0]), 3.0) << "we drive 9 m/s, it stands";
}

TEST(ReplayObjects, GivesTheSameBitsEveryTime) {
  const auto a = replay_objects(events_with_boxes(), nullptr);
  const auto b = replay_objects(events_with_boxes(), nullptr);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(test::stored(0, kObjects, a[i]).data, test::stored(0, kObjects, b[i]).data);
    for (const object_t& object : a[i].objects)
      EXPECT_EQ(objects_csv_row(a[i], object), objects_csv_row(b[i], object));
  }
}

TEST(ReplayObjects, ReachCanOncePerImage) {
  CanCounter can;
  (void)replay_objects(events_with_boxes(), &can);
  EXPECT_EQ(can.num_objects, kLastFrame + 1);
  EXPECT_GE(can.num_lists, kLastFrame + 1);
}

TEST(ReplayObjects, RefusesDetectionsThatDoNotDecode) {
  std::vector<test::StoredEvent> events = events_with_boxes();
  for (test::StoredEvent& event : events) {
    if (event.channel != kDetections.name) continue;
    event.data.resize(event.data.size() - 3);
    break;
  }
  std::int64_t num_lists = 0;
  Replay replay(
      PlumbConfig{}, 1, nullptr, [](const FrameRecord&) {}, [&](const objects_t&) { ++num_lists; });
  for (const test::StoredEvent& event : events) replay.take(event.view());
  EXPECT_EQ(replay.num_refused(), 1);
  EXPECT_EQ(replay.first_refusal(), "DETECTIONS: not a detections_t");
  EXPECT_EQ(num_lists, kLastFrame);
}

}  // namespace
}  // namespace plumb
