// Tests plumb-can from outside: what it refuses, and what it sends for the messages that it
// receives.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>

#include "platform/bus.hpp"
#include "platform/can_trace.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/process_health_t.hpp"
#include "tests/can/reading.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::ChildProcess;

void sleep_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Waits for the program's first lines, which it writes when it listens.
void wait_for_content(const std::string& path) {
  for (int i = 0; i < 1000 && std::filesystem::file_size(path) == 0; ++i) sleep_s(0.01);
}

void expect_refused(std::vector<std::string> arguments, const std::string& sentence) {
  ChildProcess child(std::move(arguments));
  EXPECT_EQ(child.wait(), 2);
  EXPECT_EQ(child.output(), "plumb-can: " + sentence + "\n");
}

TEST(CanProgram, RefusesWhatItCannotUseWithOneSentence) {
  expect_refused({"plumb-can"}, "give --interface, --trace or both");
  expect_refused({"plumb-can", "--trace", "/nonexistent/x.can"},
                 "/nonexistent/x.can: cannot create: No such file or directory");
  expect_refused({"plumb-can", "--bus"}, "unknown option --bus (--help lists the options)");
  const test::TempFile config(".toml", "can.stale_s = 0\n");
  expect_refused({"plumb-can", "--trace", "/dev/null", "--config", config.path()},
                 config.path() + ":1: can.stale_s = 0 is outside [0.05, 5]");
  const test::TempFile clash(".toml", "[can.mount]\nid = 928\n");
  expect_refused({"plumb-can", "--trace", "/dev/null", "--config", clash.path()},
                 "can.ego_motion.id and can.mount.id are both 928");
}

TEST(CanProgram, PrintsTheDatabaseOfItsConfiguration) {
  const test::TempFile config(".toml", "[can]\nnode = \"PLB2\"\nbase_id = 0x3C0\n");
  ChildProcess can({"plumb-can", "--config", config.path(), "--print-dbc"});
  EXPECT_EQ(can.wait(), 0);
  EXPECT_NE(can.output().find("BO_ 960 PLB2_EgoMotion: 8 PLB2\n"), std::string::npos);
}

/// One live plumb-can in a network of its own.
class CanProgramLive : public ::testing::Test {
 protected:
  static constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";
  Counters counters_;
  std::unique_ptr<Bus> bus_;

  void SetUp() override {
    static const bool is_private = test::enter_private_network();
    if (!is_private) GTEST_SKIP() << test::kNoPrivateNetwork;
    bus_ = std::make_unique<Bus>(kUrl, &counters_);
  }
  static std::vector<test::Reading> read(const std::string& path, const Message& message) {
    CanTraceReader reader(path);
    std::vector<test::Reading> list;
    std::int64_t time_us = 0;
    for (CanFrame frame; reader.next(&time_us, &frame);) {
      test::Reading values;
      if (values.read(message, frame)) list.push_back(values);
    }
    EXPECT_EQ(reader.error(), "");
    return list;
  }
  void publish(std::int64_t seq, double speed_m_s) {
    static Publisher<ground_plane_t> planes(*bus_, kGroundPlane);
    static Publisher<ego_motion_t> egos(*bus_, kEgoMotion);
    ground_plane_t plane{};
    plane.seq = seq;
    plane.height_m = 1.65;
    ego_motion_t ego{};
    ego.seq = seq;
    ego.q_world_cam[0] = 1.0;
    ego.velocity_ground_m_s[0] = speed_m_s;
    planes.publish(plane);
    egos.publish(ego);
  }
};

TEST_F(CanProgramLive, SendsWhatItHearsThenNotAvailableAndStopsCleanly) {
  const test::TempFile trace(".can", "");
  ChildProcess can({"plumb-can", "--lcm-url", kUrl, "--trace", trace.path()});
  wait_for_content(trace.path());
  for (int seq = 0; seq < 20; ++seq) {
    publish(seq, seq);
    sleep_s(0.02);
  }
  // One message does not decode. The other one decodes but breaks its contract.
  const std::vector<std::uint8_t> rubbish{1, 2, 3};
  bus_->publish(kEgoMotion, rubbish);
  publish(20, std::nan(""));
  sleep_s(1.0);
  can.signal(SIGTERM);
  EXPECT_EQ(can.wait(), 0) << can.output();

  std::vector<double> speeds;  // one per camera frame, in order
  const std::vector<test::Reading> motions = read(trace.path(), test::default_messages()[0]);
  for (const test::Reading& v : motions) {
    if (std::isnan(v["EgoMotion_Validity"])) continue;
    if (speeds.empty() || speeds.back() != v["EgoMotion_Speed"])
      speeds.push_back(v["EgoMotion_Speed"]);
  }
  ASSERT_EQ(speeds.size(), 20U);
  for (std::size_t i = 0; i < speeds.size(); ++i) EXPECT_EQ(speeds[i], static_cast<double>(i));
  EXPECT_TRUE(std::isnan(motions.back()["EgoMotion_Validity"])) << "stale at the end";
  ASSERT_FALSE(read(trace.path(), test::message_named("Status")).empty());
  EXPECT_EQ(read(trace.path(), test::message_named("Status")).back()["Status_NumRejected"], 2.0);
}

TEST_F(CanProgramLive, GoesOnWithTheTraceWhenThereIsNoSuchInterface) {
  const test::TempFile trace(".can", "");
  ChildProcess can(
      {"plumb-can", "--lcm-url", kUrl, "--trace", trace.path(), "--interface", "nocan7"});
  wait_for_content(trace.path());
  can.signal(SIGINT);
  EXPECT_EQ(can.wait(), 0);
  EXPECT_EQ(can.output().rfind("plumb-can: nocan7: ", 0), 0U) << can.output();
  EXPECT_GT(read(trace.path(), test::default_messages()[0]).size(), 10U);
}

TEST_F(CanProgramLive, StopsWithAReasonWhenTheDiskIsFullAndThereIsNoBus) {
  ChildProcess can({"plumb-can", "--lcm-url", kUrl, "--trace", "/dev/full"});
  EXPECT_EQ(can.wait(), 1);
  EXPECT_NE(can.output().find("/dev/full: cannot write: No space left on device"),
            std::string::npos);
}

TEST_F(CanProgramLive, ReportsItsHealth) {
  process_health_t newest{};
  Subscriber<process_health_t> health(*bus_, kHealthCan, Input::kPeriodic,
                                      [&](const process_health_t& message) -> const char* {
                                        newest = message;
                                        return nullptr;
                                      });
  ChildProcess can({"plumb-can", "--lcm-url", kUrl, "--interface", "nocan7"});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (newest.state != 2 && std::chrono::steady_clock::now() < end) bus_->handle(100);
  EXPECT_EQ(newest.process, "can");
  EXPECT_EQ(newest.state, 2) << "degraded";
  EXPECT_EQ(newest.state_reason.rfind("nocan7: ", 0), 0U) << newest.state_reason;
}

}  // namespace
}  // namespace plumb
