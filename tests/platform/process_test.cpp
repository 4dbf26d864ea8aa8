// Tests the process shell from outside, with the real plumb-ground and plumb-vo.
#include "platform/process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "platform/clock.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/notify_socket.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::ChildProcess;

class ProcessTest : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Programs, ProcessTest, testing::Values("plumb-vo", "plumb-ground"),
                         [](const auto& program) { return std::string(program.param).substr(6); });

void expect_refused(std::vector<std::string> arguments, const std::string& sentence) {
  const std::string program = arguments[0];
  ChildProcess child(std::move(arguments));
  EXPECT_EQ(2, child.wait());
  const std::string line = program + ": " + sentence;
  EXPECT_EQ(line, child.output().substr(0, line.size()));
  EXPECT_EQ(1, std::count(child.output().begin(), child.output().end(), '\n')) << child.output();
}

TEST_P(ProcessTest, RefusesWhatItDoesNotKnowWithOneSentenceAndCode2) {
  const std::string program = GetParam();
  expect_refused({program, "--colour"}, "unknown option --colour");
  expect_refused({program, "drive.lcm"}, "unexpected argument drive.lcm");
  expect_refused({program, "--config"}, "--config wants a value");
  expect_refused({program, "--config", "/nowhere.toml"},
                 "cannot read /nowhere.toml: No such file or directory\n");
  expect_refused({program, "--lcm-url", "http://there"},
                 "--lcm-url http://there begins with neither");
  const test::TempFile bad(".toml", "[ground]\ncamera_height_m = 145\n");
  expect_refused({program, "--config", bad.path()},
                 bad.path() + ":2: ground.camera_height_m = 145 is outside [0.3, 4]\n");
  const test::TempFile unknown(".toml", "[wheel]\nradius_m = 0.3\n");
  expect_refused({program, "--config", unknown.path()},
                 unknown.path() + ":2: wheel.radius_m is not a known key\n");
}

TEST_P(ProcessTest, AnswersHelpVersionAndPrintConfig) {
  ChildProcess help({GetParam(), "--help"});
  EXPECT_EQ(0, help.wait());
  EXPECT_NE(std::string::npos, help.output().find("--lcm-url")) << help.output();
  ChildProcess version({GetParam(), "--version"});
  EXPECT_EQ(0, version.wait());
  EXPECT_EQ(0U, version.output().find(std::string(GetParam()) + " ")) << version.output();

  const test::TempFile config(".toml", "ground.camera_height_m = 1.25\n");
  ChildProcess print({GetParam(), "--config", config.path(), "--print-config"});
  EXPECT_EQ(0, print.wait());
  EXPECT_NE(std::string::npos, print.output().find("\ncamera_height_m = 1.25 ")) << print.output();
}

TEST_P(ProcessTest, SaysSoWhenThereIsNoNetwork) {
  if (::unshare(CLONE_NEWNET) != 0) GTEST_SKIP() << test::kNoPrivateNetwork;
  ChildProcess child({GetParam()});
  EXPECT_EQ(1, child.wait());
  EXPECT_NE(std::string::npos, child.output().find("cannot use LCM network udpm://239.255.76.67"))
      << child.output();
}

// A program that waits in open() for its settings does not have an event loop yet.
TEST_P(ProcessTest, StopsCleanlyWhenAskedBeforeItServes) {
  const test::TempFile fifo(".toml", "");
  std::filesystem::remove(fifo.path());
  ASSERT_EQ(0, ::mkfifo(fifo.path().c_str(), 0600));
  for (const int stop : {SIGINT, SIGTERM}) {
    ChildProcess child({GetParam(), "--lcm-url", "memq://", "--config", fifo.path()});
    const int settings = ::open(fifo.path().c_str(), O_WRONLY);  // returns when the child reads
    ASSERT_GE(settings, 0);
    child.signal(stop);
    ::close(settings);
    EXPECT_EQ(0, child.wait()) << child.output();
    EXPECT_NE(std::string::npos, child.output().find("stopped; received 0")) << child.output();
  }
}

TEST_P(ProcessTest, TakesLaterConfigurationsAsOverlays) {
  const test::TempFile vehicle(".toml", "[ground]\ncamera_height_m = 1.25\nroad_near_m = 6.0\n");
  const test::TempFile site(".toml", "[ground]\nroad_near_m = 7.0\n");
  ChildProcess print(
      {GetParam(), "--config", vehicle.path(), "--config", site.path(), "--print-config"});
  EXPECT_EQ(0, print.wait());
  EXPECT_NE(std::string::npos, print.output().find("\ncamera_height_m = 1.25 ")) << print.output();
  EXPECT_NE(std::string::npos, print.output().find("\nroad_near_m = 7.0 ")) << print.output();
}

TEST_P(ProcessTest, JudgesLimitsOnceAllConfigurationsAreRead) {
  const std::string program = GetParam();
  const test::TempFile narrow(".toml", "[ground]\nroad_near_m = 20\nroad_far_m = 19\n");
  const test::TempFile wide(".toml", "[ground]\nroad_far_m = 40\n");
  ChildProcess mended(
      {program, "--config", narrow.path(), "--config", wide.path(), "--print-config"});
  EXPECT_EQ(0, mended.wait()) << mended.output();
  expect_refused({program, "--config", wide.path(), "--config", narrow.path(), "--print-config"},
                 narrow.path() + ": ground.road_near_m is not below ground.road_far_m\n");
}

// Waits until systemd has heard `count` messages of the program, for up to 10 s.
std::vector<std::string> hear(test::NotifySocket& manager, ChildProcess& child, std::size_t count) {
  std::vector<std::string> all;
  const std::int64_t end_us = monotonic_us() + 10'000'000;
  while (all.size() < count && monotonic_us() < end_us && child.wait(0.02) < 0) {
    for (std::string text = manager.heard(); !text.empty(); text = manager.heard())
      all.push_back(text);
  }
  return all;
}

std::string notify_name() { return "@plumb-test-" + std::to_string(::getpid()); }

// What a program tells systemd: twice while it serves, and at its end.
std::vector<std::string> told(std::vector<std::string> arguments) {
  test::NotifySocket manager(notify_name());
  ChildProcess child(std::move(arguments));
  std::vector<std::string> all = hear(manager, child, 2);
  child.signal(SIGTERM);
  EXPECT_EQ(0, child.wait()) << child.output();
  for (std::string text = manager.heard(); !text.empty(); text = manager.heard())
    all.push_back(text);
  return all;
}

TEST_P(ProcessTest, OutlivesItsTerminal) {
  test::NotifySocket manager(notify_name());
  ChildProcess child({GetParam(), "--lcm-url", "memq://"});
  ASSERT_EQ(1U, hear(manager, child, 1).size());
  child.signal(SIGHUP);
  EXPECT_EQ(2U, hear(manager, child, 2).size()) << "it serves on";
  child.signal(SIGTERM);
  EXPECT_EQ(0, child.wait()) << child.output();
}

TEST(Supervision, SystemdHearsThatAProcessServesAndThatItsOutputIsWhatItShouldBe) {
  const auto vo = told({"plumb-vo", "--lcm-url", "memq://"});
  ASSERT_GE(vo.size(), 3U);
  EXPECT_EQ("READY=1\nWATCHDOG=1\nSTATUS=no CAMERA_CALIBRATION yet\n", vo[0]);
  EXPECT_EQ("WATCHDOG=1\nSTATUS=no CAMERA_CALIBRATION yet\n", vo[1]);
  EXPECT_EQ("STOPPING=1\nSTATUS=SIGTERM\n", vo.back());
  const test::TempFile trace(".can");
  const auto can = told({"plumb-can", "--lcm-url", "memq://", "--trace", trace.path()});
  ASSERT_GE(can.size(), 3U);
  EXPECT_EQ(0U, can[0].find("READY=1\n")) << can[0];
  EXPECT_EQ(0U, can[1].find("WATCHDOG=1\n")) << can[1];
}

// The health messages of one program until its end.
struct Life {
  std::vector<process_health_t> reports;
  int exit_code = -1;
};

Life watch(const std::string& program, const Channel& health, int stop_signal) {
  Life life;
  Counters counters;
  Bus bus("", &counters);
  Subscriber<process_health_t> in(bus, health, Input::kPeriodic, [&](const auto& m) {
    life.reports.push_back(m);
    return nullptr;
  });
  ChildProcess child({program});
  const std::int64_t start_us = monotonic_us();
  while (monotonic_us() < start_us + 3'250'000) bus.handle(50);
  child.signal(stop_signal);
  life.exit_code = child.wait(5.0);
  while (bus.handle(100)) {
  }
  EXPECT_EQ(0, counters.num_rejected);
  return life;
}

TEST_P(ProcessTest, ReportsItsHealthTwiceASecondWithoutInputAndStopsCleanlyWhenAsked) {
  if (!test::enter_private_network()) GTEST_SKIP() << test::kNoPrivateNetwork;
  const std::string program = GetParam();
  const bool is_vo = program == "plumb-vo";
  const Life life = watch(program, is_vo ? kHealthVo : kHealthGround, is_vo ? SIGTERM : SIGINT);
  EXPECT_EQ(0, life.exit_code);
  ASSERT_GE(life.reports.size(), 6U);
  ASSERT_LE(life.reports.size(), 9U);
  for (std::size_t i = 0; i + 1 < life.reports.size(); ++i) {
    const process_health_t& m = life.reports[i];
    EXPECT_EQ(is_vo ? "vo" : "ground", m.process);
    EXPECT_EQ(static_cast<int>(HealthState::kWaiting), m.state);
    EXPECT_EQ("no CAMERA_CALIBRATION yet", m.state_reason);
    EXPECT_GT(m.memory_rss_bytes, 0);
    EXPECT_GT(m.receive_buffer_bytes, 100'000);
    const double since_us =
        i < 2 ? 500'000.0 : static_cast<double>(m.utime - life.reports[i - 1].utime);
    EXPECT_NEAR(500'000.0, since_us, 60'000.0);
  }
  EXPECT_EQ(static_cast<int>(HealthState::kStopping), life.reports.back().state);
  EXPECT_EQ(is_vo ? "SIGTERM" : "SIGINT", life.reports.back().state_reason);
}

}  // namespace
}  // namespace plumb
