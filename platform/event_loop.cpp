#include "platform/event_loop.hpp"

#include <pthread.h>
#include <sys/signalfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include "platform/clock.hpp"

namespace plumb {
namespace {

timespec to_timespec(std::int64_t us) {
  timespec t{};
  t.tv_sec = us / 1'000'000;
  t.tv_nsec = (us % 1'000'000) * 1'000;
  return t;
}

sigset_t stop_signals() {
  sigset_t stops;
  sigemptyset(&stops);
  sigaddset(&stops, SIGINT);
  sigaddset(&stops, SIGTERM);
  return stops;
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

void block_stop_signals() {
  const sigset_t stops = stop_signals();
  pthread_sigmask(SIG_BLOCK, &stops, nullptr);
}

EventLoop::EventLoop() {
  block_stop_signals();
  const sigset_t stops = stop_signals();
  const int fd = ::signalfd(-1, &stops, SFD_CLOEXEC | SFD_NONBLOCK);
  if (fd < 0) fail("signalfd");
  add(fd, false, [this, fd] {
    signalfd_siginfo info{};
    if (::read(fd, &info, sizeof info) != sizeof info) return;
    stop_signal_ = static_cast<int>(info.ssi_signo);
    stopped_ = true;
  });
}

EventLoop::~EventLoop() {
  ::close(polls_.front().fd);
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].is_timer) ::close(polls_[i].fd);
}

std::size_t EventLoop::add(int fd, bool is_timer, Callback callback) {
  polls_.push_back({fd, POLLIN, 0});
  sources_.push_back({is_timer, std::move(callback)});
  return sources_.size() - 1;
}

void EventLoop::watch(int fd, Callback callback) { add(fd, false, std::move(callback)); }

EventLoop::TimerId EventLoop::timer(Callback callback) {
  const int fd = ::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK);
  if (fd < 0) fail("timerfd");
  return add(fd, true, std::move(callback));
}

EventLoop::TimerId EventLoop::every(std::int64_t period_us, Callback callback) {
  const TimerId id = timer(std::move(callback));
  set_timer(id, monotonic_us() + period_us, period_us);
  return id;
}

void EventLoop::arm_at(TimerId timer, std::int64_t at_us) {
  // Zero would disarm the timer, so the earliest time is 1 us after boot.
  set_timer(timer, std::max<std::int64_t>(at_us, 1), 0);
}

void EventLoop::disarm(TimerId timer) { set_timer(timer, 0, 0); }

void EventLoop::set_timer(TimerId timer, std::int64_t at_us, std::int64_t period_us) {
  const itimerspec spec{to_timespec(period_us), to_timespec(at_us)};
  if (::timerfd_settime(polls_[timer].fd, TFD_TIMER_ABSTIME, &spec, nullptr) != 0) fail("timerfd");
}

void EventLoop::run() {
  while (step(-1)) {
  }
}

bool EventLoop::step(int timeout_ms) {
  if (stopped_) return false;
  if (::poll(polls_.data(), polls_.size(), timeout_ms) < 0) {
    if (errno != EINTR) fail("poll");
    return true;
  }
  for (std::size_t i = 0; i < sources_.size() && !stopped_; ++i) {
    if (polls_[i].revents == 0) continue;
    if (sources_[i].is_timer) {
      std::uint64_t expirations = 0;
      // A timer that was disarmed after poll() has nothing to read.
      if (::read(polls_[i].fd, &expirations, sizeof expirations) != sizeof expirations) continue;
    }
    sources_[i].callback();
  }
  return !stopped_;
}

}  // namespace plumb
