#include "platform/file_thread.hpp"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "platform/durable_file.hpp"

namespace plumb {

struct FileThread::Shared {
  Shared(const std::string& file, std::size_t capacity_bytes) : path(file) {
    waiting.reserve(capacity_bytes);
    written.reserve(capacity_bytes);
  }

  const std::string path;
  std::string written;  // of the writing thread
  std::atomic<int> error = 0;
  std::mutex mutex;  // of all below; it is not held while the disk works
  std::condition_variable changed;
  std::string waiting;
  bool is_waiting = false;
  bool is_stopping = false;
  bool is_done = false;
};

FileThread::FileThread(const std::string& path, std::size_t capacity_bytes)
    : shared_(std::make_shared<Shared>(path, capacity_bytes)) {
  std::thread([shared = shared_] { run(shared); }).detach();
}

FileThread::~FileThread() {
  Shared& s = *shared_;
  std::unique_lock lock(s.mutex);
  s.is_stopping = true;
  s.changed.notify_all();
  s.changed.wait_for(lock, std::chrono::milliseconds(kMaxCloseMs), [&s] { return s.is_done; });
}

bool FileThread::replace(std::string_view text) {
  Shared& s = *shared_;
  if (text.size() > s.waiting.capacity()) return false;
  {
    const std::lock_guard lock(s.mutex);
    s.waiting = text;
    s.is_waiting = true;
  }
  s.changed.notify_all();
  return true;
}

int FileThread::error() const { return shared_->error; }

void FileThread::run(const std::shared_ptr<Shared>& shared) {
  Shared& s = *shared;
  std::unique_lock lock(s.mutex);
  while (!s.is_stopping || s.is_waiting) {
    s.changed.wait(lock, [&s] { return s.is_stopping || s.is_waiting; });
    if (!s.is_waiting) continue;
    s.is_waiting = false;
    s.written.swap(s.waiting);
    lock.unlock();
    s.error = replace_file(s.path, s.written) ? 0 : errno;
    lock.lock();
  }
  s.is_done = true;
  s.changed.notify_all();
}

}  // namespace plumb
