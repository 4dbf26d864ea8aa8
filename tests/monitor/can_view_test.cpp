/// Frames as plumb-can sends them, and as a bad bus delivers them.
#include "tools/monitor/can_view.hpp"

#include <gtest/gtest.h>

#include "modules/can/can_codec.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "platform/can_trace.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/monitor/can_feed.hpp"

namespace plumb {
namespace {

using nlohmann::json;

class CanViewTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kEgo = message_index("EgoMotion");

  [[nodiscard]] std::size_t signal(std::size_t message, const std::string& name) const {
    const auto signals = messages_[message].signals;
    for (std::size_t i = 0; i < signals.size(); ++i)
      if (signals[i].name == name) return i;
    ADD_FAILURE() << name;
    return 0;
  }
  [[nodiscard]] CanFrame ego(double speed_m_s, std::uint8_t alive) const {
    MessageValues values{};
    values[signal(kEgo, "EgoMotion_Speed")] = speed_m_s;
    values[signal(kEgo, "EgoMotion_YawRate")] = kNotAvailable;
    values[signal(kEgo, "EgoMotion_Validity")] = 2.0;
    return encode(messages_[kEgo], values, {alive, 17, 0});
  }
  [[nodiscard]] json newest(std::int64_t now_us) const {
    return view_.values(now_us)["messages"].at(0);
  }

  CanConfig config_;
  Messages messages_ = can_messages(config_);
  CanView view_{config_};
};

TEST_F(CanViewTest, ShowsValuesAgeAndProtection) {
  view_.take(ego(12.5, 3), 1'000'000);
  const json message = newest(1'040'000);
  EXPECT_EQ(message["message"], kEgo);
  EXPECT_DOUBLE_EQ(message["age_ms"], 40.0);
  EXPECT_EQ(message["e2e"], "first");
  EXPECT_NEAR(message["values"][signal(kEgo, "EgoMotion_Speed")], 12.5, 0.0025);
  EXPECT_TRUE(message["values"][signal(kEgo, "EgoMotion_YawRate")].is_null());
  EXPECT_EQ(message["values"][signal(kEgo, "EgoMotion_FrameCtr")], 17.0);
}

TEST_F(CanViewTest, FollowsTheAliveCounter) {
  const std::pair<std::uint8_t, const char*> steps[] = {{13, "first"},   {14, "ok"},  {0, "ok"},
                                                        {0, "repeated"}, {4, "lost"}, {5, "ok"}};
  for (const auto& [alive, state] : steps) {
    view_.take(ego(1.0, alive), 1);
    EXPECT_EQ(newest(1)["e2e"], state) << int{alive};
  }
  EXPECT_EQ(newest(1)["num_lost"], 3);
  EXPECT_EQ(newest(1)["num_repeated"], 1);
  EXPECT_EQ(view_.num_faults(), 2);
}

TEST_F(CanViewTest, KeepsTheLastGoodValuesBesideAWrongFrame) {
  view_.take(ego(12.5, 3), 1'000);
  CanFrame wrong = ego(99.0, 4);
  wrong.data[5] ^= 0x40U;
  view_.take(wrong, 2'000);
  EXPECT_EQ(newest(2'000)["e2e"], "wrong");
  EXPECT_DOUBLE_EQ(newest(2'000)["age_ms"], 1.0);
  EXPECT_NEAR(newest(2'000)["values"][signal(kEgo, "EgoMotion_Speed")], 12.5, 0.0025);
  CanFrame foreign = ego(1.0, 5);
  foreign.id = 0x7FE;
  view_.take(foreign, 3'000);
  EXPECT_EQ(view_.values(3'000)["num_foreign"], 1);
}

TEST_F(CanViewTest, KeepsObjectsByTheirIndexUntilTheyAreOld) {
  constexpr std::size_t kPosition = message_index("ObjectPosition");
  for (std::uint8_t index = 0; index < 3; ++index) {
    MessageValues values{};
    values[signal(kPosition, "Obj#_PosX")] = 10.0 + index;
    view_.take(encode(messages_[kPosition], values, {index, 0, index}), 1'000 + index);
  }
  const auto objects = newest(2'000)["objects"];
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_NEAR(objects[2][signal(kPosition, "Obj#_PosX")], 12.0, 0.1);
  EXPECT_TRUE(newest(1'002 + CanView::kObjectAgeUs)["objects"].size() == 1U);
}

TEST_F(CanViewTest, KnowsTheBurstOfAnImageByTheLastOfItsMessages) {
  EXPECT_FALSE(view_.has_bursts(1'000'000));
  EXPECT_FALSE(view_.has_burst(0));
  view_.take(ego(12.5, 3), 1'000'000);
  EXPECT_FALSE(view_.has_burst(17)) << "its first message has come";
  constexpr std::size_t kLast = message_index("Frame");
  view_.take(encode(messages_[kLast], MessageValues{}, {0, 17, 0}), 1'000'000);
  EXPECT_TRUE(view_.has_burst(17));
  EXPECT_TRUE(view_.has_burst(256 + 17)) << "frames carry the low 8 bits";
  EXPECT_FALSE(view_.has_burst(18));
  EXPECT_TRUE(view_.has_bursts(1'900'000));
  EXPECT_FALSE(view_.has_bursts(2'100'000));
}

TEST_F(CanViewTest, SchemaNamesEverySignalOfTheTable) {
  const json schema = view_.schema();
  ASSERT_EQ(schema.size(), kNumMessages);
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    EXPECT_EQ(schema[i]["id"], messages_[i].address.id);
    ASSERT_EQ(schema[i]["signals"].size(), messages_[i].signals.size());
  }
  EXPECT_EQ(schema[kEgo]["signals"][signal(kEgo, "EgoMotion_Speed")]["unit"], "m/s");
}

TEST_F(CanViewTest, FeedFollowsATraceThatGrowsAndIsReplaced) {
  const test::TempFolder folder;
  const std::string path = (folder / "live.can").string();
  std::vector<CanFrame> seen;
  CanFeed feed({}, path, [&seen](const CanFrame& frame) { seen.push_back(frame); });
  feed.poll(0);
  EXPECT_NE(feed.state().find("No such file"), std::string::npos) << feed.state();
  CanTraceWriter writer(path, "can0");
  writer.send(1, ego(1.0, 0));
  writer.flush();
  feed.poll(500'000);
  EXPECT_TRUE(seen.empty()) << "it is tried once a second";
  feed.poll(1'000'000);
  ASSERT_EQ(seen.size(), 1U) << feed.state();
  EXPECT_EQ(feed.state(), "");
  for (std::uint8_t i = 1; i < 5; ++i) writer.send(i, ego(1.0, i));
  writer.flush();
  feed.poll(1'010'000);
  ASSERT_EQ(seen.size(), 5U);
  EXPECT_EQ(seen[4].data, ego(1.0, 4).data);
  folder.write("live.can", "(1.000000) can0 123#");
  feed.poll(2'000'000);
  feed.poll(3'000'000);
  EXPECT_EQ(seen.size(), 5U) << "half a line is no frame";
  std::ofstream(path, std::ios::app) << "AB\nnonsense\n" << std::string(2'000, 'x') << "\n";
  feed.poll(3'010'000);
  ASSERT_EQ(seen.size(), 6U);
  EXPECT_EQ(seen[5].id, 0x123U);
  EXPECT_EQ(feed.num_unreadable(), 2);
}

TEST_F(CanViewTest, FeedReadsAnOldTraceFromItsEnd) {
  const test::TempFolder folder;
  const std::string path = folder.write("live.can", "(1.000000) can0 123#00\n").string();
  int num_seen = 0;
  CanFeed feed({}, path, [&num_seen](const CanFrame&) { ++num_seen; });
  feed.poll(0);
  EXPECT_EQ(num_seen, 0);
  std::ofstream(path, std::ios::app) << "(2.000000) can0 124#00\n";
  feed.poll(1);
  EXPECT_EQ(num_seen, 1);
}

TEST(CanFeedState, SaysWhyThereIsNothing) {
  CanFeed none({}, {}, {});
  none.poll(0);
  EXPECT_NE(none.state().find("--interface"), std::string::npos);
  CanFeed absent("nosuchcan0", {}, {});
  absent.poll(0);
  EXPECT_EQ(absent.state().rfind("nosuchcan0: ", 0), 0U) << absent.state();
  CanFeed device({}, "/dev/null", {});
  device.poll(0);
  EXPECT_EQ(device.state(), "/dev/null is not a file");
}

}  // namespace
}  // namespace plumb
