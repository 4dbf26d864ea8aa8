// Tests plumb-can from outside: what it refuses, and what it sends for the messages that it
// receives.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <thread>

#include "core/numbers.hpp"
#include "platform/bus.hpp"
#include "platform/can_trace.hpp"
#include "platform/clock.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/process_health_t.hpp"
#include "tests/can/drive.hpp"
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
  /// Keeps the newest health message of plumb-can in `newest`, as long as the result lives.
  [[nodiscard]] Subscriber<process_health_t> watch_health(process_health_t* newest) {
    return {*bus_, kHealthCan, Input::kPeriodic,
            [newest](const process_health_t& message) -> const char* {
              *newest = message;
              return nullptr;
            }};
  }
  /// Publishes an image of a drive that was taken just now.
  void publish(std::int64_t seq, double speed_m_s) {
    Publisher<ground_plane_t> planes(*bus_, kGroundPlane);
    Publisher<ego_motion_t> egos(*bus_, kEgoMotion);
    test::Drive drive;
    drive.seq = seq;
    drive.session = 1;
    drive.utime = monotonic_us();
    ego_motion_t ego = drive.ego();
    ego.velocity_ground_m_s[0] = speed_m_s;
    ego.q_prev_cam[0] = 0.0;  // states no step
    ego.distance_m = 0.0;
    planes.publish(drive.plane());
    egos.publish(ego);
  }
  static std::vector<std::string> command(const std::string& trace) {
    return {"plumb-can", "--lcm-url", kUrl, "--trace", trace};
  }
};

TEST_F(CanProgramLive, SendsWhatItHearsThenNotAvailableAndStopsCleanly) {
  const test::TempFile trace(".can", "");
  ChildProcess can(command(trace.path()));
  wait_for_content(trace.path());
  for (int seq = 0; seq < 24; ++seq) {
    publish(seq, 10.0 + 0.1 * seq);
    sleep_s(0.02);
  }
  // One message does not decode. The other one decodes but breaks its contract.
  const std::vector<std::uint8_t> rubbish{1, 2, 3};
  bus_->publish(kEgoMotion, rubbish);
  publish(24, kInf);
  sleep_s(1.0);
  can.signal(SIGTERM);
  EXPECT_EQ(can.wait(), 0) << can.output();

  std::vector<double> speeds;  // one per camera frame, in order
  const std::vector<test::Reading> motions = read(trace.path(), test::default_messages()[0]);
  for (const test::Reading& v : motions) {
    if (std::isnan(v["EgoMotion_Speed"])) continue;
    if (speeds.empty() || speeds.back() != v["EgoMotion_Speed"])
      speeds.push_back(v["EgoMotion_Speed"]);
  }
  ASSERT_EQ(speeds.size(), 21U) << "the first three images make it believable";
  for (std::size_t i = 0; i < speeds.size(); ++i)
    EXPECT_NEAR(speeds[i], 10.3 + 0.1 * static_cast<double>(i), 0.0026);
  EXPECT_TRUE(std::isnan(motions.back()["EgoMotion_Validity"])) << "stale at the end";
  ASSERT_FALSE(read(trace.path(), test::message_named("Status")).empty());
  EXPECT_EQ(read(trace.path(), test::message_named("Status")).back()["Status_NumRejected"], 2.0);
}

TEST_F(CanProgramLive, SendsNothingOldAsValidAfterItWasStopped) {
  process_health_t newest{};
  const auto health = watch_health(&newest);
  const test::TempFile trace(".can", "");
  ChildProcess can(command(trace.path()));
  wait_for_content(trace.path());
  int seq = 0;
  std::vector<std::int64_t> captures_us;
  const auto drive = [&](int num_images) {
    for (int i = 0; i < num_images; ++i) {
      captures_us.push_back(realtime_us());
      publish(seq++, 10.0);
      sleep_s(0.05);
    }
  };
  drive(10);
  can.signal(SIGSTOP);
  drive(20);  // one second
  can.signal(SIGCONT);
  drive(10);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  while (newest.num_late < 20 && std::chrono::steady_clock::now() < end) bus_->handle(100);
  can.signal(SIGTERM);
  EXPECT_EQ(can.wait(), 0) << can.output();
  EXPECT_GE(newest.num_late, 20) << "the images of 0.75 s, two messages each";

  const Message& message = test::message_named("EgoMotion");
  CanTraceReader reader(trace.path());
  std::int64_t time_us = 0;
  int num_valid = 0;
  for (CanFrame frame; reader.next(&time_us, &frame);) {
    test::Reading v;
    if (!v.read(message, frame) || v["EgoMotion_Validity"] != 2.0) continue;
    ++num_valid;
    const auto number = static_cast<std::size_t>(v.frame_counter());
    ASSERT_LT(number, captures_us.size());
    EXPECT_LT(time_us - captures_us[number], 265'000) << "frame " << number;
  }
  EXPECT_GT(num_valid, 20);
}

TEST_F(CanProgramLive, ContinuesItsTraceAfterARestartAndSaysThatItBeganAnew) {
  constexpr std::uintmax_t kEveryMessage_bytes = 8000;  // several cycles of all messages
  const test::TempFile trace(".can", "");
  std::uintmax_t bytes = 0;
  for (int run = 0; run < 2; ++run) {
    ChildProcess can(command(trace.path()));
    const std::uintmax_t enough = bytes + kEveryMessage_bytes;
    for (int i = 0; i < 1000 && std::filesystem::file_size(trace.path()) < enough; ++i)
      sleep_s(0.01);
    can.signal(SIGTERM);
    EXPECT_EQ(can.wait(), 0) << can.output();
    EXPECT_GE(std::filesystem::file_size(trace.path()), enough);
    bytes = std::filesystem::file_size(trace.path());
  }
  const std::vector<test::Reading> frames = read(trace.path(), test::message_named("Frame"));
  ASSERT_FALSE(frames.empty());
  EXPECT_NE(frames.front()["Frame_StartCtr"], frames.back()["Frame_StartCtr"]);
}

TEST_F(CanProgramLive, NeitherStopsNorHangsWhenNobodyReadsItsLog) {
  const test::TempFolder folder;
  const std::string pipe = (folder / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int end = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  const std::vector<char> junk(4096, 'x');
  while (::write(end, junk.data(), junk.size()) > 0) {
  }
  const std::string trace = (folder / "t.can").string();
  ChildProcess can({"/bin/sh", "-c",
                    std::string("exec " PLUMB_BIN_DIR "/plumb-can --lcm-url '") + kUrl +
                        "' --interface nocan7 --trace " + trace + " 2>" + pipe});
  sleep_s(0.5);
  publish(0, kInf);  // one more line to log
  sleep_s(0.5);
  can.signal(SIGTERM);
  EXPECT_EQ(can.wait(5.0), 0);
  ::close(end);
  const std::size_t num_frames = read(trace, test::message_named("EgoMotion")).size();
  EXPECT_GT(num_frames, 60U) << "it went on sending";
}

TEST_F(CanProgramLive, GoesOnWithTheTraceWhenThereIsNoSuchInterface) {
  const test::TempFile trace(".can", "");
  ChildProcess can(
      {"plumb-can", "--lcm-url", kUrl, "--trace", trace.path(), "--interface", "nocan7"});
  wait_for_content(trace.path());
  sleep_s(0.2);
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
  const auto health = watch_health(&newest);
  ChildProcess can({"plumb-can", "--lcm-url", kUrl, "--interface", "nocan7"});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (newest.state != 2 && std::chrono::steady_clock::now() < end) bus_->handle(100);
  EXPECT_EQ(newest.process, "can");
  EXPECT_EQ(newest.state, 2) << "degraded";
  EXPECT_EQ(newest.state_reason.rfind("nocan7: ", 0), 0U) << newest.state_reason;
}

}  // namespace
}  // namespace plumb
