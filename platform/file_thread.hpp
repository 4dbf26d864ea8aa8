/// A small file that a thread of its own replaces, so that a slow disk holds nobody up.
///
/// Threads:
///   One thread hands texts over, the other one writes. The newest text wins.
/// Memory:
///   Two texts of the capacity, allocated by the constructor.
/// End:
///   The destructor writes what waits, for up to kMaxCloseMs. A disk that takes longer keeps its
///   thread and the texts; the process can end.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace plumb {

class FileThread {
 public:
  static constexpr int kMaxCloseMs = 2'000;

  /// Starts the thread. The file is touched by replace() alone.
  FileThread(const std::string& path, std::size_t capacity_bytes);
  ~FileThread();
  FileThread(const FileThread&) = delete;
  FileThread& operator=(const FileThread&) = delete;

  /// Hands over the next text; it never waits for the disk. Returns false for one that does not
  /// fit.
  [[nodiscard]] bool replace(std::string_view text);
  /// Returns errno of the last text that was written, 0 when it is on the disk.
  [[nodiscard]] int error() const;

 private:
  struct Shared;
  static void run(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
};

}  // namespace plumb
