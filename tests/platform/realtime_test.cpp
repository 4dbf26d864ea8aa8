#include "platform/realtime.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <functional>

namespace plumb {
namespace {

/// Runs `check` in a child, because what it changes holds for the whole process.
int in_child(const std::function<bool()>& check) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(check() ? 0 : 1);
  int status = -1;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

long locked_kb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmLck:", 0) == 0) return std::strtol(line.c_str() + 6, nullptr, 10);
  return -1;
}

bool has(const std::vector<std::string>& sentences, const char* part) {
  for (const std::string& sentence : sentences)
    if (sentence.find(part) != std::string::npos) return true;
  return false;
}

/// Gives up what a user without rights does not have.
bool become_nobody() {
  const rlimit memory{4 << 20, 4 << 20};
  const rlimit none{0, 0};
  return ::setrlimit(RLIMIT_MEMLOCK, &memory) == 0 && ::setrlimit(RLIMIT_RTPRIO, &none) == 0 &&
         (::geteuid() != 0 || ::setresuid(65534, 65534, 65534) == 0);
}

TEST(Realtime, SaysWhatIsNotPermittedAndHowToPermitIt) {
  EXPECT_EQ(0, in_child([] {
              RealtimeRequest request;
              request.lock_memory = true;
              request.priority = 20;
              if (!become_nobody() || !prepare_realtime(request).empty()) return false;
              const auto sentences = enter_realtime(request);
              return sentences.size() == 2 && has(sentences, "only 4194304 bytes may be") &&
                     has(sentences, "LimitMEMLOCK=infinity") && has(sentences, "LimitRTPRIO=20") &&
                     locked_kb() == 0;
            }));
}

TEST(Realtime, LocksWhatThereIsAndWhatWillBe) {
  const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
  const auto check = [&all] {
    if (::setrlimit(RLIMIT_MEMLOCK, &all) != 0) return true;
    RealtimeRequest request;
    request.lock_memory = true;
    if (!prepare_realtime(request).empty() || !enter_realtime(request).empty()) return false;
    const long before_kb = locked_kb();
    const std::vector<char> later(8 << 20, 1);
    return before_kb > 0 && locked_kb() >= before_kb + 8'000 && later[5] == 1;
  };
  EXPECT_EQ(0, in_child(check));
}

TEST(Realtime, BindsToTheCpusAndSaysWhenThereAreNone) {
  EXPECT_EQ(0, in_child([] {
              cpu_set_t before;
              CPU_ZERO(&before);
              ::sched_getaffinity(0, sizeof before, &before);
              std::int64_t cpu = 0;
              while (!CPU_ISSET(static_cast<std::size_t>(cpu), &before)) ++cpu;
              RealtimeRequest request;
              request.cpus = {cpu};
              if (!prepare_realtime(request).empty()) return false;
              cpu_set_t after;
              CPU_ZERO(&after);
              ::sched_getaffinity(0, sizeof after, &after);
              if (CPU_COUNT(&after) != 1 || !CPU_ISSET(static_cast<std::size_t>(cpu), &after))
                return false;
              request.cpus = {1023};
              return has(prepare_realtime(request), "--cpus");
            }));
}

}  // namespace
}  // namespace plumb
