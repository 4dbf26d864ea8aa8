// Tests that a log played by lcm-logplayer into the live processes gives the same bits as the
// replay, and that nothing is lost.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "platform/can_trace.hpp"
#include "tests/live/live_chain.hpp"
#include "tests/replay/street_boxes.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::LiveResult;
using test::StoredEvent;

// The results of the replay of a log, as bytes of messages without_run().
struct Expected {
  std::int64_t num_images = 0;
  std::int64_t num_calibrations = 0;
  std::int64_t num_detections = 0;
  LiveResult::Messages planes;
  LiveResult::Messages egos;
  LiveResult::Messages objects;
};

template <typename Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  constexpr bool kHasSession = requires { message.session; };
  return test::without_run(test::stored(0, kCamera, message).data, kHasSession);
}

Expected replay(const std::string& log) {
  Expected expected;
  Chain replay(
      PlumbConfig{}, 1, nullptr,
      [&](const FrameRecord& frame) {
        EXPECT_EQ(nullptr, frame.refused) << frame.refused;
        if (frame.plane == nullptr) return;
        expected.planes.push_back(bytes_of(*frame.plane));
        expected.egos.push_back(bytes_of(*frame.ego));
      },
      [&](const objects_t& objects) { expected.objects.push_back(bytes_of(objects)); });
  LogReader reader(log);
  LogEvent event;
  while (reader.next(&event)) {
    if (event.channel == kCameraCalibration.name) ++expected.num_calibrations;
    if (event.channel == kCamera.name) ++expected.num_images;
    if (event.channel == kDetections.name) ++expected.num_detections;
    replay.take(event);
  }
  EXPECT_TRUE(reader.problems().empty());
  return expected;
}

// Returns what was sent about each camera frame, by CAN identifier and place in a list of objects.
// CRCs, alive counters and repeats are left out, and so are ages and the start of the count of
// resets. So are bursts that say "not available" because there is no input: they follow the end of
// the log live, but not in the replay.
std::map<std::uint32_t, std::vector<std::string>> said_on_can(const std::string& path) {
  constexpr std::uint32_t kFirstId = 0x3A0;
  constexpr std::uint32_t kStatusId =
      0x3A7;  // this one and the next have counters and times of the process
  constexpr std::uint32_t kDistanceId = 0x3A6;
  constexpr std::uint32_t kMountId = 0x3A9;
  constexpr std::uint32_t kAgeId = 0x3AA;
  constexpr std::uint32_t kListId = 0x3B0;  // the objects follow
  std::map<std::uint32_t, std::vector<std::string>> said;
  CanTraceReader reader(path);
  CanFrame frame;
  std::int64_t time_us = 0;
  while (reader.next(&time_us, &frame)) {
    EXPECT_GE(frame.id, kFirstId);
    if (frame.id == kStatusId || frame.id == kStatusId + 1 || frame.id == kAgeId) continue;
    if (frame.id == kDistanceId) frame.data[6] = 0;              // OdomDist_ResetCtr
    if (frame.id == kListId) frame.data[4] = frame.data[5] = 0;  // ObjList_Age
    const bool four_bits =
        frame.id == 0x3A1 || frame.id == 0x3A3 || frame.id == kMountId || frame.id == kListId;
    const int flags =
        frame.data[1] >> 4;  // validity; a status, a count or an index where it has four bits
    const bool is_object = frame.id > kListId;
    if (!is_object && (four_bits ? flags == 0xF : (flags & 3) == 3)) continue;
    std::string text(1, static_cast<char>(frame.data[1] & 0xF0U));
    text.append(reinterpret_cast<const char*>(&frame.data[2]), frame.size - 2U);
    auto& list = said[is_object ? frame.id << 4U | static_cast<std::uint32_t>(flags) : frame.id];
    if (list.empty() || list.back() != text) list.push_back(text);
  }
  EXPECT_EQ("", reader.error());
  return said;
}

void expect_nothing_lost(const Expected& expected, const LiveResult& live) {
  EXPECT_EQ(expected.num_images + expected.num_calibrations, live.vo.num_received);
  EXPECT_EQ(expected.num_images, live.vo.num_published);
  const std::int64_t num_lists = expected.num_detections;  // one for each image that was searched
  const std::int64_t num_inputs = 2 * expected.num_images + expected.num_calibrations + num_lists;
  EXPECT_EQ(num_inputs, live.ground.num_received);
  const auto num_mounts = static_cast<std::int64_t>(live.mounts.size());
  EXPECT_EQ(2 * expected.num_images + num_mounts, live.ground.num_published);
  EXPECT_GE(num_mounts, expected.num_images / 10) << "one a second";
  EXPECT_EQ(num_inputs, live.tracker.num_received);
  EXPECT_EQ(num_lists, live.tracker.num_published);
  EXPECT_EQ(2 * expected.num_images + num_lists + num_mounts, live.can.num_received);
  for (const process_health_t* m : {&live.vo, &live.ground, &live.tracker, &live.can}) {
    EXPECT_EQ(0, m->num_dropped) << m->process;
    EXPECT_EQ(0, m->num_skipped) << m->process;
    // plumb-ground may be creating its estimator while the first detections wait for their plane.
    EXPECT_GE(m == &live.tracker ? 1 : 0, m->num_unpaired) << m->process;
    EXPECT_EQ(0, m->num_rejected) << m->process;
    EXPECT_EQ(0, m->num_unsent) << m->process;
    EXPECT_EQ(3, m->state) << m->process << " said goodbye";
    std::printf("  %-7s received %lld, late %lld, receive buffer %d bytes, peak %.1f MB\n",
                m->process.c_str(), static_cast<long long>(m->num_received),
                static_cast<long long>(m->num_late), m->receive_buffer_bytes,
                static_cast<double>(m->memory_peak_bytes) * 1e-6);
    for (const stage_latency_t& stage : m->stages) {
      if (stage.name == "total")
        std::printf("  %-7s frame: median %.0f us, p99 %.0f us, max %.0f us\n", "", stage.median_us,
                    stage.p99_us, stage.max_us);
    }
  }
}

void expect_same_can(const std::string& log, const std::string& live_trace, bool with_objects) {
  const test::TempFile replay_trace(".can");
  test::ChildProcess program({"plumb-replay", log, "--can", replay_trace.path()});
  ASSERT_EQ(0, program.wait(120.0)) << program.output();
  const auto expected = said_on_can(replay_trace.path());
  const auto live = said_on_can(live_trace);
  if (with_objects) {
    for (const std::uint32_t id : {0x3B0U, 0x3B10U, 0x3B20U, 0x3B30U})
      EXPECT_EQ(1U, expected.count(id)) << std::hex << id << ", the nearest object's";
  } else {
    EXPECT_EQ(8U, expected.size()) << "identifiers 3A0 to 3A6, 3A9";
  }
  for (const auto& [id, list] : expected) {
    ASSERT_TRUE(live.count(id) == 1) << std::hex << id;
    EXPECT_TRUE(list == live.at(id)) << std::hex << id << std::dec << ": " << live.at(id).size()
                                     << " distinct live, " << list.size() << " in the replay";
  }
}

void expect_live_equals_replay(const std::string& log, const std::string& speed) {
  const test::TempFile trace(".can");
  test::LiveChain chain("udpm://239.255.76.67:7667?ttl=0", trace.path());
  const LiveResult live = chain.play(log, speed);
  ASSERT_TRUE(live.ready) << live.output;
  ASSERT_TRUE(live.played);
  for (const int code : live.exit_codes) EXPECT_EQ(0, code) << live.output;
  const Expected expected = replay(log);
  expect_nothing_lost(expected, live);
  EXPECT_EQ(static_cast<std::size_t>(expected.num_images), live.planes.size());
  EXPECT_TRUE(expected.planes == live.planes) << "GROUND_PLANE differs";
  EXPECT_TRUE(expected.egos == live.egos) << "EGO_MOTION differs";
  EXPECT_EQ(static_cast<std::size_t>(expected.num_detections), live.objects.size());
  EXPECT_TRUE(expected.objects == live.objects) << "OBJECTS differs";
  expect_same_can(log, trace.path(), expected.num_detections > 0);
}

// Converts a real drive. Returns false where there is none.
bool convert_real(const std::string& sequence, const std::string& log) {
  const std::filesystem::path folder = test::kitti_sequence(sequence);
  if (folder.empty()) return false;
  test::ChildProcess program({"plumb-kitti2lcm", folder.string(), "--out", log});
  EXPECT_EQ(0, program.wait(60.0)) << program.output();
  return true;
}

// Writes the rendered street at KITTI's size. Each pixel is repeated four times, so that an image
// has 466 kB.
void write_large_street(const std::string& log, bool boxes) {
  CameraModel camera = test::scene_camera();
  camera.width_px *= 2;
  camera.height_px *= 2;
  camera.fx_px = camera.fy_px *= 2.0;
  camera.cx_px = 2.0 * camera.cx_px + 0.5;
  camera.cy_px = 2.0 * camera.cy_px + 0.5;
  std::vector<StoredEvent> events;
  for (const StoredEvent& event : test::street_events()) {
    if (event.channel != kCamera.name) {
      events.push_back(
          test::stored(event.log_us, kCameraCalibration, to_wire(camera, event.log_us)));
      continue;
    }
    ImageFrame small;
    ASSERT_EQ(nullptr, read_image(event.data, &small));
    const int width = 2 * small.width_px;
    std::vector<std::uint8_t> pixels;
    for (int v = 0; v < 2 * small.height_px; ++v)
      for (int u = 0; u < width; ++u)
        pixels.push_back(small.data[static_cast<std::size_t>(v / 2 * small.width_px + u / 2)]);
    events.push_back(test::image_event(
        small.seq, {pixels.data(), width, 2 * small.height_px, width}, small.capture_us));
  }
  test::write_log(log, boxes ? test::with_boxes(events, camera) : events);
}

class LiveEqualsReplay : public testing::Test {
 protected:
  void SetUp() override {
    static const bool is_private = test::enter_private_network();
    if (!is_private) GTEST_SKIP() << test::kNoPrivateNetwork;
  }
  test::TempFile log_{".lcm"};
};

TEST_F(LiveEqualsReplay, AtRealTimeWithObjects) {
  if (!convert_real("raw/drive0009_000-050", log_.path())) write_large_street(log_.path(), true);
  expect_live_equals_replay(log_.path(), "1");
}

TEST_F(LiveEqualsReplay, AtFiveTimesRealTimeWithoutLosingAnything) {
  if (!convert_real("raw/drive0039_024-400", log_.path())) write_large_street(log_.path(), false);
  expect_live_equals_replay(log_.path(), "5");
}

TEST_F(LiveEqualsReplay, WithCompressedImages) {
  const std::filesystem::path folder = test::kitti_sequence("odometry/sequences/04_000-050");
  if (folder.empty()) GTEST_SKIP() << test::kNoKitti;
  test::ChildProcess program(
      {"plumb-kitti2lcm", folder.string(), "--compress", "jpeg", "--out", log_.path()});
  ASSERT_EQ(0, program.wait(60.0)) << program.output();
  expect_live_equals_replay(log_.path(), "2");
}

}  // namespace
}  // namespace plumb
