/// A log on the page: run through the chain, or shown as it was recorded.
#include "tools/monitor/log_monitor.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "platform/config.hpp"
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

using nlohmann::json;

const std::string kDrive = std::string(PLUMB_SOURCE_DIR) + "/tools/run/demo_drive/drive.lcm";

json json_of(const Packet& packet) {
  const char* message = reinterpret_cast<const char*>(packet.bytes.data()) + Packet::kRoom;
  std::uint32_t length = 0;
  std::memcpy(&length, message, sizeof length);
  return json::parse(message + 4, message + 4 + length);
}

void read_all(LogMonitor* monitor) {
  monitor->run([] { return false; }, [] {});
}

/// The rows and events that a page is told.
json news_of(LogMonitor* monitor) {
  json all = {{"rows", json::array()}, {"events", json::array()}};
  NewsCursor cursor;
  for (int i = 0; i < 100; ++i) {
    const auto packet = monitor->news(&cursor);
    if (packet == nullptr) break;
    const json news = json_of(*packet);
    EXPECT_EQ(news["first_row"], all["rows"].size());
    for (const json& row : news["rows"]) all["rows"].push_back(row);
    for (const json& event : news["events"]) all["events"].push_back(event);
    all["done"] = news["done"];
  }
  return all;
}

TEST(LogMonitor, RunsTheChainOnALogOfInputs) {
  PlumbConfig config;
  LogMonitor monitor(kDrive, config, false);
  EXPECT_FALSE(monitor.is_recorded());
  read_all(&monitor);
  EXPECT_EQ(monitor.trouble(), "");
  std::vector<double> speeds;
  Chain chain(config, 1, nullptr, [&speeds](const FrameRecord& record) {
    speeds.push_back(record.ego != nullptr ? record.ego->velocity_ground_m_s[0] : kNotAvailable);
  });
  LogReader reader(kDrive);
  for (LogEvent event; reader.next(&event);) chain.take(event);
  const json news = news_of(&monitor);
  EXPECT_EQ(news["done"], true);
  ASSERT_EQ(news["rows"].size(), speeds.size());
  ASSERT_EQ(monitor.num_frames(), static_cast<std::int64_t>(speeds.size()));
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (!std::isfinite(speeds[i])) continue;
    EXPECT_EQ(news["rows"][i][2], speeds[i]) << i;
  }
  const auto packet = monitor.frame(60);
  ASSERT_NE(packet, nullptr);
  const json frame = json_of(*packet);
  EXPECT_EQ(frame["row"], news["rows"][60]);
  EXPECT_EQ(frame["image"]["seq"], frame["seq"]);
  EXPECT_EQ(frame["ego"]["velocity"][0], speeds[60]);
  EXPECT_FALSE(frame["objects"]["list"].empty());
  EXPECT_FALSE(frame["can"]["messages"].empty());
  EXPECT_GT(packet->size(), 20'000U) << "the picture is missing";
  EXPECT_EQ(monitor.frame(-1), nullptr);
  EXPECT_EQ(monitor.frame(1'000'000), nullptr);
}

class RecordedLog : public ::testing::Test {
 protected:
  template <typename Message>
  static void write(LogWriter* log, std::int64_t log_us, const Channel& channel,
                    const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    log->write(log_us, channel.name, bytes);
  }
  /// Three images' results without pictures; the path is broken before the third.
  void record() const {
    LogWriter log(path_);
    for (int i = 0; i < 3; ++i) {
      ego_motion_t ego{};
      ego.seq = 100 + i;
      ego.utime = i * 100'000;
      ego.velocity_ground_m_s[0] = 10.0 + i;
      ego.reset_counter = i == 2 ? 1 : 0;
      vo_motion_t vo{};
      vo.seq = ego.seq;
      write(&log, 5'000'000 + i * 100'000, kVoMotion, vo);
      write(&log, 5'000'010 + i * 100'000, kEgoMotion, ego);
    }
    log.close();
  }
  test::TempFolder folder_;
  std::string path_ = (folder_ / "recorded.lcm").string();
};

TEST_F(RecordedLog, IsShownAsItWasRecorded) {
  record();
  LogMonitor monitor(path_, PlumbConfig{}, false);
  EXPECT_TRUE(monitor.is_recorded());
  read_all(&monitor);
  const json news = news_of(&monitor);
  ASSERT_EQ(news["rows"].size(), 3U);
  EXPECT_EQ(news["rows"][1][1], 101.0);
  EXPECT_EQ(news["rows"][1][2], 11.0);
  const json frame = json_of(*monitor.frame(2));
  EXPECT_NEAR(frame["time_s"], 0.2, 1e-3);
  EXPECT_FALSE(frame.contains("image"));
  EXPECT_FALSE(frame["can"]["state"].get<std::string>().empty());
  const json& reset = news["events"].back();
  EXPECT_EQ(reset["level"], "alarm");
  EXPECT_EQ(reset["frame"], 2) << "a click leads to the image of the event";
}

TEST_F(RecordedLog, RecomputeAsksForTheImagesThatItLacks) {
  record();
  LogMonitor monitor(path_, PlumbConfig{}, true);
  EXPECT_FALSE(monitor.is_recorded());
  read_all(&monitor);
  EXPECT_EQ(monitor.num_frames(), 0);
  EXPECT_NE(monitor.trouble().find("holds neither an image on CAMERA nor EGO_MOTION"),
            std::string::npos);
}

TEST_F(RecordedLog, DamageIsNamedAndTheRestShown) {
  record();
  std::string bytes = test::read_text(path_);
  bytes.insert(bytes.size() / 2, "garbage");
  folder_.write("recorded.lcm", bytes);
  LogMonitor monitor(path_, PlumbConfig{}, false);
  read_all(&monitor);
  EXPECT_GE(monitor.num_frames(), 1);
  EXPECT_NE(monitor.trouble().find("byte"), std::string::npos) << monitor.trouble();
}

TEST_F(RecordedLog, StopsWhenAsked) {
  LogMonitor monitor(kDrive, PlumbConfig{}, false);
  monitor.run([&monitor] { return monitor.num_frames() >= 5; }, [] {});
  EXPECT_LE(monitor.num_frames(), 7);
  EXPECT_EQ(news_of(&monitor)["done"], true);
}

TEST(FrameStoreBounds, ReadsBackWhatWasAdded) {
  FrameStore store;
  for (int i = 0; i < 20; ++i)
    store.add("{\"n\":" + std::to_string(i) + "}", Row{static_cast<double>(i)}, {i * 10, i});
  std::string text;
  ImagePlace place;
  ASSERT_TRUE(store.read(13, &text, &place));
  EXPECT_EQ(text, "{\"n\":13}");
  EXPECT_EQ(place.offset, 130);
  EXPECT_FALSE(store.read(20, &text, &place));
  EXPECT_FALSE(store.read(-1, &text, &place));
  EXPECT_EQ(store.rows(18, 100).size(), 2U);
  EXPECT_EQ(store.rows(5, 3).back().front(), 7.0);
  EXPECT_TRUE(store.rows(100, 3).empty());
}

}  // namespace
}  // namespace plumb
