/// What of the messages is an event, and what is not.
#include "tools/monitor/event_watch.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tools/monitor/event_log.hpp"

namespace plumb {
namespace {

class EventWatchTest : public ::testing::Test {
 protected:
  /// The events since the last call, as "level source: text".
  std::vector<std::string> events() { return std::exchange(events_, {}); }

  std::vector<std::string> events_;
  EventWatch watch_{[this](EventLevel level, const char* source, const std::string& text) {
    events_.push_back(std::string(kEventLevelNames[static_cast<std::size_t>(level)]) + " " +
                      source + ": " + text);
  }};
};

using Lines = std::vector<std::string>;

TEST_F(EventWatchTest, TellsChangesOfStatusAndReasonOnce) {
  vo_motion_t vo{};
  vo.status = vo_motion_t::STATUS_INITIALIZING;
  vo.reason = vo_motion_t::REASON_FIRST_FRAME;
  watch_.take(vo);
  EXPECT_EQ(events(), Lines{"warning vo: initializing: first_frame"});
  watch_.take(vo);
  EXPECT_TRUE(events().empty());
  vo.status = vo_motion_t::STATUS_OK;
  vo.reason = 0;
  watch_.take(vo);
  EXPECT_EQ(events(), Lines{"info vo: initializing -> ok"});
  vo.status = vo_motion_t::STATUS_LOST;
  vo.reason = vo_motion_t::REASON_IMAGE_DARK;
  watch_.take(vo);
  EXPECT_EQ(events(), Lines{"alarm vo: ok -> lost: image_dark"});
}

TEST_F(EventWatchTest, TellsResetsAndRestarts) {
  ego_motion_t ego{};
  ego.session = 5;
  watch_.take(ego);
  events();
  ++ego.reset_counter;
  watch_.take(ego);
  EXPECT_EQ(events(), Lines{"alarm ego: reset: the path is not continuous, reset counter 1"});
  ego.session = 6;
  ego.reset_counter = 0;
  watch_.take(ego);
  EXPECT_EQ(events().front(), "alarm ground: the process was restarted");
  vo_motion_t vo{};
  watch_.take(vo);
  events();
  ++vo.scale_epoch;
  watch_.take(vo);
  EXPECT_EQ(events(), Lines{"warning vo: reset: new unit of length, scale epoch 1"});
}

TEST_F(EventWatchTest, TellsAlarmsOfTheMountAndNotWhyAnImageWasNotUsed) {
  mount_t mount{};
  mount.status = mount_t::STATUS_STEADY;
  watch_.take(mount);
  events();
  mount.reason = mount_t::REASON_TURNING;
  watch_.take(mount);
  EXPECT_TRUE(events().empty());
  mount.status = mount_t::STATUS_MOVED;
  watch_.take(mount);
  EXPECT_EQ(events(), Lines{"alarm mount: steady -> moved"});
}

TEST_F(EventWatchTest, TellsHealthLossesAndSilence) {
  process_health_t health{};
  health.process = "ground";
  watch_.take(health, 1'000'000);
  EXPECT_EQ(events(), Lines{"info ground: running"});
  health.num_dropped = 4;
  watch_.take(health, 1'500'000);
  EXPECT_EQ(events(), Lines{"warning ground: rejected, dropped, late, skipped or unsent: 4 more"});
  health.state = 2;
  health.state_reason = "3 messages processed late";
  health.num_late = 3;
  watch_.take(health, 2'000'000);
  EXPECT_EQ(events(), Lines{"warning ground: degraded: 3 messages processed late"});
  health.state_reason = "5 messages processed late";
  health.num_late = 8;
  watch_.take(health, 2'500'000);
  EXPECT_TRUE(events().empty()) << "another figure is no news";
  watch_.check_silence(4'000'000);
  EXPECT_TRUE(events().empty());
  watch_.check_silence(4'100'000);
  watch_.check_silence(4'200'000);
  EXPECT_EQ(events(), Lines{"alarm ground: the process is silent"});
  watch_.take(health, 5'000'000);
  EXPECT_EQ(events(), Lines{"info ground: reports again"});
  health.process = "somebody else";
  watch_.take(health, 5'000'000);
  EXPECT_TRUE(events().empty());
}

TEST_F(EventWatchTest, TellsFaultsOnCanOnceASecond) {
  watch_.take_can_faults(0, 0);
  watch_.take_can_faults(2, 10);
  watch_.take_can_faults(9, 20);
  EXPECT_EQ(events(),
            Lines{"warning CAN: 2 frames more with a wrong checksum, missing or repeated"});
  watch_.take_can_faults(9, 1'000'011);
  EXPECT_EQ(events(),
            Lines{"warning CAN: 7 frames more with a wrong checksum, missing or repeated"});
}

TEST(EventLogMemory, ForgetsTheOldest) {
  EventLog log;
  for (int i = 0; i < 2000; ++i) log.add(i, -1, EventLevel::kInfo, "vo", "text");
  std::int64_t cursor = 0;
  const auto all = log.since(&cursor);
  ASSERT_EQ(all.size(), EventLog::kMaxEvents);
  EXPECT_EQ(all.front()["serial"], 1500);
  EXPECT_EQ(cursor, 2000);
  EXPECT_TRUE(log.since(&cursor).empty());
}

}  // namespace
}  // namespace plumb
