#include "platform/can_trace_thread.hpp"

#include <pthread.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

namespace plumb {
namespace {

constexpr auto kPause = std::chrono::milliseconds(50);

}  // namespace

struct CanTraceThread::Shared {
  struct Item {
    std::int64_t time_us = 0;
    CanFrame frame;
  };

  Shared(const std::string& path, const std::string& interface)
      : writer(path, interface, CanTraceWriter::Existing::kContinued) {}

  CanTraceWriter writer;  // of the writing thread
  std::array<Item, kCapacity> items;
  std::atomic<std::size_t> num_put = 0;    // by the sending thread
  std::atomic<std::size_t> num_taken = 0;  // by the writing thread
  std::atomic<bool> has_failed = false;    // after it, writer.error() does not change
  std::atomic<bool> is_stopping = false;
  std::mutex mutex;  // of the three below; no sender waits for it
  std::condition_variable changed;
  bool is_done = false;
};

CanTraceThread::CanTraceThread(const std::string& path, const std::string& interface,
                               std::int64_t offset_us)
    : shared_(std::make_shared<Shared>(path, interface)) {
  shared_->writer.set_time_offset_us(offset_us);
  shared_->has_failed = !shared_->writer.error().empty();
  if (shared_->has_failed) {
    is_closed_ = true;
    return;
  }
  std::thread([shared = shared_] { run(shared); }).detach();
}

CanTraceThread::~CanTraceThread() { close(); }

void CanTraceThread::send(std::int64_t time_us, const CanFrame& frame) {
  Shared& s = *shared_;
  if (is_closed_ || s.has_failed.load(std::memory_order_acquire)) return;
  const std::size_t put = s.num_put.load(std::memory_order_relaxed);
  if (put - s.num_taken.load(std::memory_order_acquire) == kCapacity) {
    ++num_dropped_;
    return;
  }
  s.items[put % kCapacity] = {time_us, frame};
  s.num_put.store(put + 1, std::memory_order_release);
  ++num_frames_;
}

const std::string& CanTraceThread::error() const {
  return shared_->has_failed.load(std::memory_order_acquire) ? shared_->writer.error() : no_error_;
}

bool CanTraceThread::close() {
  Shared& s = *shared_;
  if (!is_closed_) {
    is_closed_ = true;
    std::unique_lock lock(s.mutex);
    s.is_stopping = true;
    s.changed.notify_all();
    const auto limit = std::chrono::milliseconds(kMaxCloseMs);
    if (!s.changed.wait_for(lock, limit, [&s] { return s.is_done; })) s.writer.give_up();
  }
  const std::lock_guard lock(s.mutex);
  return s.is_done && !s.has_failed && s.num_taken == s.num_put;
}

void CanTraceThread::run(const std::shared_ptr<Shared>& shared) {
  // A reader of a pipe that goes away is an error of write(), not the end of the process.
  sigset_t broken_pipe;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, nullptr);
  Shared& s = *shared;
  bool goes_on = true;
  while (goes_on) {
    goes_on = !s.is_stopping;  // one more round after the stop: it takes what was put before
    std::size_t taken = s.num_taken.load(std::memory_order_relaxed);
    const std::size_t put = s.num_put.load(std::memory_order_acquire);
    for (; taken != put; ++taken) {
      const Shared::Item& item = s.items[taken % kCapacity];
      s.writer.send(item.time_us, item.frame);
      s.num_taken.store(taken + 1, std::memory_order_release);
    }
    if (!s.writer.flush()) {
      s.has_failed.store(true, std::memory_order_release);
      goes_on = false;
    }
    std::unique_lock lock(s.mutex);
    if (goes_on) s.changed.wait_for(lock, kPause, [&s] { return s.is_stopping.load(); });
  }
  const std::lock_guard lock(s.mutex);
  s.is_done = true;
  s.changed.notify_all();
}

}  // namespace plumb
