#include "modules/chain/chain.hpp"

#include <gtest/gtest.h>

#include "tests/replay/street_log.hpp"
#include "tools/evaluate/eval/kitti_metric.hpp"
#include "tools/run/replay/frame_csv.hpp"
#include "tools/run/replay/pose_track.hpp"

namespace plumb {
namespace {

using test::replay_events;
using test::StoredEvent;
using test::street_events;

struct CanRecorder final : CanSink {
  std::vector<std::pair<std::int64_t, CanFrame>> frames;
  void send(std::int64_t time_us, const CanFrame& frame) override {
    frames.emplace_back(time_us, frame);
  }
};

struct Outcome {
  std::vector<std::string> rows;
  std::vector<std::string> poses;
  CanRecorder can;
  std::int64_t num_refused = 0;
  std::int64_t num_lost = 0;
  std::string first_refusal;
};

Outcome run(const std::vector<StoredEvent>& events) {
  Outcome outcome;
  PoseTrack track;
  replay_events(
      events, &outcome.can,
      [&](const Chain&, const FrameRecord& record) {
        outcome.rows.push_back(frame_csv_row(record, false));
        outcome.poses.push_back(track.row(record.ego));
      },
      [&](const Chain& replay) {
        outcome.num_refused = replay.num_refused();
        outcome.num_lost = replay.num_lost();
        outcome.first_refusal = replay.first_refusal();
      });
  return outcome;
}

TEST(Replay, FollowsARenderedDrive) {
  std::vector<PoseMatrix> est;
  replay_events(street_events(), nullptr, [&](const Chain&, const FrameRecord& record) {
    ASSERT_NE(record.ego, nullptr);
    EXPECT_EQ(record.refused, nullptr);
    est.push_back(PoseMatrix::Identity());
    for (int i = 0; i < 3; ++i) est.back()(i, 3) = record.ego->t_world_cam_m[i];
  });
  const auto& truth = test::street_drive();
  ASSERT_EQ(est.size(), truth.size());
  const Eigen::Vector3d start_m = est.front().topRightCorner<3, 1>();
  EXPECT_LT(start_m.norm(), 1e-12) << "the first frame is the world";
  // The known camera height gives metres, to within a few per cent over the 30 m.
  const Eigen::Vector3d end_m = est.back().topRightCorner<3, 1>();
  EXPECT_LT((end_m - truth.back().t).norm(), 0.05 * truth.back().t.norm());
}

TEST(Replay, GivesTheSameBitsEveryTime) {
  const Outcome a = run(street_events());
  const Outcome b = run(street_events());
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.poses, b.poses);
  ASSERT_EQ(a.can.frames.size(), b.can.frames.size());
  ASSERT_GT(a.can.frames.size(), street_events().size());
  for (std::size_t i = 0; i < a.can.frames.size(); ++i) {
    EXPECT_EQ(a.can.frames[i].first, b.can.frames[i].first);
    EXPECT_EQ(a.can.frames[i].second.data, b.can.frames[i].second.data);
  }
}

TEST(Replay, CanTimesAreTheLogsOwn) {
  const Outcome outcome = run(street_events());
  for (const auto& [time_us, frame] : outcome.can.frames) {
    EXPECT_GE(time_us, test::kStreetStart_us);
    EXPECT_LE(time_us, test::kStreetStart_us + 40 * test::kStreetPeriod_us);
  }
}

TEST(Replay, CountsFramesThatAreMissingByNumberAndGoesOn) {
  std::vector<StoredEvent> events = street_events();
  events.erase(events.begin() + 16);  // image 15
  const Outcome outcome = run(events);
  EXPECT_EQ(outcome.rows.size(), street_events().size() - 2);
  EXPECT_EQ(outcome.num_lost, 1);
  EXPECT_EQ(outcome.num_refused, 0);
  EXPECT_NE(outcome.poses.back(), outcome.poses[15]);
}

TEST(Replay, RefusesAnImageOfAnotherSizeAndGoesOn) {
  std::vector<StoredEvent> events = street_events();
  const std::vector<std::uint8_t> grey(80 * 64, 100);
  events[16] = test::image_event(15, {grey.data(), 80, 64, 80});
  const Outcome outcome = run(events);
  ASSERT_EQ(outcome.rows.size(), street_events().size() - 1);
  EXPECT_EQ(outcome.num_refused, 1);
  EXPECT_EQ(outcome.first_refusal, "frame 15: image size differs from the calibration");
  EXPECT_NE(outcome.rows[15].find("image size differs"), std::string::npos);
  EXPECT_EQ(outcome.poses[15], outcome.poses[14]) << "a refused image repeats the pose";
  EXPECT_NE(outcome.poses.back(), outcome.poses[15]);
}

TEST(Replay, RefusesARepeatedImage) {
  std::vector<StoredEvent> events = street_events();
  events.insert(events.begin() + 16, events[15]);
  const Outcome outcome = run(events);
  EXPECT_EQ(outcome.num_refused, 1);
  EXPECT_EQ(outcome.first_refusal, "frame 14: the image was received before");
}

TEST(Replay, SaysWhenTimeRunsBackwards) {
  std::vector<StoredEvent> events = street_events();
  const test::Scene scene(test::scene_camera());
  const auto image = scene.render(test::street_drive()[20], 1.5, 21);
  events[21] =
      test::image_event(20, image.view(), test::kStreetStart_us + 15 * test::kStreetPeriod_us);
  const Outcome outcome = run(events);
  ASSERT_EQ(outcome.rows.size(), street_events().size() - 1);
  EXPECT_NE(outcome.rows[20].find("time_backwards"), std::string::npos) << outcome.rows[20];
}

TEST(Replay, WithoutCalibrationEveryImageIsRefusedWithAReason) {
  std::vector<StoredEvent> events = street_events();
  events.erase(events.begin());
  const Outcome outcome = run(events);
  EXPECT_EQ(outcome.num_refused, static_cast<std::int64_t>(events.size()));
  EXPECT_EQ(outcome.first_refusal, "frame 0: image came before a calibration");
  EXPECT_NE(outcome.rows[3].find("no_calibration"), std::string::npos);
}

TEST(Replay, RefusesMessagesThatDoNotDecode) {
  std::vector<StoredEvent> events = street_events();
  events[0].data.resize(20);
  events.insert(events.begin() + 1, street_events()[0]);
  events[5].data.resize(1000);
  const Outcome outcome = run(events);
  EXPECT_EQ(outcome.num_refused, 2);
  EXPECT_EQ(outcome.first_refusal, "CAMERA_CALIBRATION: not a camera_calibration_t");
}

}  // namespace
}  // namespace plumb
