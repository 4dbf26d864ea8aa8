#include "tools/status/status_board.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

constexpr std::int64_t kNow_us = 100'000'000;

process_health_t health_of(const std::string& process, std::int8_t state, const std::string& why) {
  process_health_t message{};
  message.process = process;
  message.state = state;
  message.state_reason = why;
  message.num_received = 1234;
  message.memory_rss_bytes = 20'500'000;
  return message;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(StatusBoard, IsWellWhenAllThatAreNeededRun) {
  StatusBoard board({"vo", "can"});
  EXPECT_FALSE(board.is_well(kNow_us));
  board.take(health_of("vo", 0, ""), kNow_us);
  board.take(health_of("can", 0, ""), kNow_us);
  EXPECT_TRUE(board.is_well(kNow_us));
  EXPECT_TRUE(board.is_well(kNow_us + kHealthVo.stale_us));
  EXPECT_FALSE(board.is_well(kNow_us + kHealthVo.stale_us + 1)) << "silent";
  board.take(health_of("ground", 2, "3 messages lost"), kNow_us);
  EXPECT_TRUE(board.is_well(kNow_us)) << "not needed";
  for (const std::int8_t state : std::initializer_list<std::int8_t>{1, 2, 3}) {
    board.take(health_of("can", state, "why"), kNow_us);
    EXPECT_FALSE(board.is_well(kNow_us)) << int{state};
  }
}

TEST(StatusBoard, ShowsEachProcessWithItsReason) {
  StatusBoard board({"camera", "vo"});
  process_health_t vo = health_of("vo", 1, "no CAMERA for 1.5 s");
  vo.stages.resize(1);
  vo.stages[0].name = "total";
  vo.stages[0].p99_us = 6'300.0F;
  board.take(vo, kNow_us);
  board.take(health_of("somebody", 0, ""), kNow_us);
  const std::string text = board.text(kNow_us);
  EXPECT_TRUE(has(text, "camera   SILENT    nothing on HEALTH_CAMERA\n")) << text;
  EXPECT_TRUE(has(text, "vo       waiting        1234 ")) << text;
  EXPECT_TRUE(has(text, "6.3    20.5  no CAMERA for 1.5 s\n")) << text;
  EXPECT_FALSE(has(text, "objects")) << text;
  EXPECT_TRUE(has(text, "motion:  no EGO_MOTION\nchain:   NOT WELL: camera, vo\n")) << text;
}

TEST(StatusBoard, ShowsTheMotionWithItsRateAndAge) {
  StatusBoard board({});
  ego_motion_t ego{};
  ego.velocity_ground_m_s[0] = 13.306;
  ego.speed_std_m_s = 0.05;
  for (int i = 0; i <= 10; ++i) {
    ego.capture_mono_us = kNow_us + i * 100'000 - 35'000;
    board.take(ego, kNow_us + i * 100'000);
  }
  EXPECT_TRUE(has(board.text(kNow_us + 1'000'000),
                  "m/s +- 0.05, 10.0 images/s, 35 ms from capture to here\nchain:   well\n"))
      << board.text(kNow_us + 1'000'000);
  EXPECT_TRUE(has(board.text(kNow_us + 3'000'000), "no EGO_MOTION"));
}

}  // namespace
}  // namespace plumb
