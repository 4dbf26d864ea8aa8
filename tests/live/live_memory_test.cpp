// Tests that the processes of the vehicle take no memory once they run: no thread calls malloc, and
// their address space, which is then limited to what it is, stays large enough.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <memory>

#include "platform/bus.hpp"
#include "platform/clock.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

using test::ChildProcess;

constexpr std::int64_t kNumSettled = 20;  ///< images after which nothing may be taken
const char* const kDrive = PLUMB_SOURCE_DIR "/tools/run/demo_drive/drive.lcm";

std::int64_t mallocs_of(const test::TempFolder& counts, int pid) {
  std::int64_t count = -1;
  std::ifstream(counts / std::to_string(pid), std::ios::binary)
      .read(reinterpret_cast<char*>(&count), sizeof count);
  return count;
}

/// [kB] The value of a line of /proc/PID/status.
std::int64_t status_kb(int pid, const std::string& name) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(name + ":", 0) == 0)
      return std::strtoll(line.c_str() + name.size() + 1, nullptr, 10);
  return -1;
}

struct Running {
  std::string name;
  std::unique_ptr<ChildProcess> child;
  std::int64_t mallocs = -1;
  std::int64_t rss_kb = -1;
};

/// Notes what the process has now, and lets its address space grow no more.
void settle(const test::TempFolder& counts, Running* process) {
  const int pid = process->child->pid();
  process->mallocs = mallocs_of(counts, pid);
  process->rss_kb = status_kb(pid, "VmRSS");
  const auto bytes = static_cast<rlim_t>(status_kb(pid, "VmSize")) * 1024;
  const rlimit limit{bytes, bytes};
  EXPECT_EQ(0, ::prlimit(pid, RLIMIT_AS, &limit, nullptr)) << process->name;
}

class LiveMemory : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__)
    GTEST_SKIP() << "the sanitizer owns malloc";
#endif
    if (!test::enter_private_network()) GTEST_SKIP() << test::kNoPrivateNetwork;
    ::setenv("PLUMB_MALLOC_COUNTS", counts_.path().c_str(), 1);
    ::setenv("LD_PRELOAD", PLUMB_MALLOC_COUNTER, 1);
    start("plumb-can", {"--trace", (counts_ / "trace.can").string()});
    for (const char* name : {"plumb-objects", "plumb-ground", "plumb-vo"}) start(name, {});
    ::unsetenv("LD_PRELOAD");
  }

  void start(const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(), name);
    options.insert(options.end(), {"--lock-memory", "--config", settings_.path()});
    processes_.push_back({name, std::make_unique<ChildProcess>(std::move(options))});
  }

  /// Plays the drive. Returns the number of EGO_MOTION.
  std::int64_t play() {
    Counters counters;
    Bus bus("", &counters);
    std::int64_t num_egos = 0;
    RawSubscriber ego(bus, kEgoMotion, Input::kOccasional, [&](RawSubscriber::Bytes) {
      if (++num_egos == kNumSettled)
        for (Running& process : processes_) settle(counts_, &process);
      return nullptr;
    });
    wait(bus, 1'500'000);  // until they listen
    ChildProcess player({"lcm-logplayer", "-s", "2", "-e", "CAMERA|CAMERA_CALIBRATION|DETECTIONS",
                         "-l", "udpm://239.255.76.67:7667?ttl=0", kDrive});
    while (player.wait(0.0) < 0) wait(bus, 20'000);
    wait(bus, 700'000);  // for one more health message of each
    return num_egos;
  }

  static void wait(Bus& bus, std::int64_t for_us) {
    const std::int64_t end_us = monotonic_us() + for_us;
    while (monotonic_us() < end_us) bus.handle(10);
  }

  test::TempFolder counts_;
  test::TempFile settings_{".toml", "[images]\nmax_pixels = 500000\n[ground]\nimages_kept = 10\n"};
  std::vector<Running> processes_;
};

TEST_F(LiveMemory, NothingIsTakenOnceTheChainRuns) {
  EXPECT_GT(play(), 2 * kNumSettled);
  for (Running& process : processes_) {
    SCOPED_TRACE(process.name);
    const int pid = process.child->pid();
    EXPECT_GT(process.mallocs, 100) << "the counter counts";
    EXPECT_EQ(process.mallocs, mallocs_of(counts_, pid));
    EXPECT_EQ(process.rss_kb, status_kb(pid, "VmRSS"));
    process.child->signal(SIGTERM);
    EXPECT_EQ(0, process.child->wait(5.0)) << process.child->output();
  }
}

}  // namespace
}  // namespace plumb
