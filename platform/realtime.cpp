#include "platform/realtime.hpp"

#include <linux/capability.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>

namespace plumb {
namespace {

constexpr std::size_t kThreadStackBytes = 256 << 10;
constexpr std::size_t kMainStackBytes = 256 << 10;  // several times what the estimators use
constexpr std::size_t kPageBytes = 4096;

/// Whether this process may lock memory without a limit.
bool has_lock_capability() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, 2> data{};
  if (::syscall(SYS_capget, &header, data.data()) != 0) return false;
  return (data[0].effective & (1U << CAP_IPC_LOCK)) != 0;
}

/// With a limit, memory that is taken later could be refused, which would end the process.
std::string why_not_lockable() {
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur == RLIM_INFINITY || has_lock_capability()) return {};
  return "the memory is not locked: only " + std::to_string(limit.rlim_cur) +
         " bytes may be; permit it by LimitMEMLOCK=infinity in the unit, or ulimit -l unlimited";
}

/// Its frame is the part of the stack that later calls will use.
__attribute__((noinline)) void touch_stack() {
  std::array<volatile std::uint8_t, kMainStackBytes> pages;
  for (std::size_t at = 0; at < pages.size(); at += kPageBytes) pages[at] = 0;
}

std::string lock_memory() {
  std::string why = why_not_lockable();
  if (!why.empty()) return why;
  touch_stack();
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return std::string("the memory is not locked: ") + std::strerror(errno);
}

std::string bind_cpus(const std::vector<std::int64_t>& cpus) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const std::int64_t cpu : cpus)
    if (cpu >= 0 && cpu < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(cpu), &set);
  if (::sched_setaffinity(0, sizeof set, &set) == 0) return {};
  return std::string("the CPUs of --cpus are not used: ") + std::strerror(errno);
}

std::string raise_priority(int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  // Threads that a library may start later keep the ordinary scheduler.
  if (::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) == 0) return {};
  const std::string number = std::to_string(priority);
  return "the priority " + number + " is not used: " + std::strerror(errno) +
         "; permit it by LimitRTPRIO=" + number + " in the unit, or ulimit -r " + number;
}

void keep(std::string why, std::vector<std::string>* sentences) {
  if (!why.empty()) sentences->push_back(std::move(why));
}

}  // namespace

std::vector<std::string> prepare_realtime(const RealtimeRequest& request) {
  std::vector<std::string> sentences;
  if (request.lock_memory) {
    ::mallopt(M_ARENA_MAX, 1);
    ::mallopt(M_TRIM_THRESHOLD, -1);
    pthread_attr_t attributes;
    ::pthread_attr_init(&attributes);
    ::pthread_attr_setstacksize(&attributes, kThreadStackBytes);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
  }
  if (!request.cpus.empty()) keep(bind_cpus(request.cpus), &sentences);
  return sentences;
}

std::vector<std::string> enter_realtime(const RealtimeRequest& request) {
  std::vector<std::string> sentences;
  if (request.lock_memory) keep(lock_memory(), &sentences);
  if (request.priority > 0) keep(raise_priority(request.priority), &sentences);
  return sentences;
}

}  // namespace plumb
