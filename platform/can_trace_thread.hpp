/// A trace that is written by a thread of its own, so that a slow disk or a pipe that nobody reads
/// holds nobody up who sends.
///
/// Threads:
///   One thread sends and asks; the other one writes. They share a ring without locks.
/// Memory:
///   A ring of kCapacity frames. A frame that does not fit is dropped and counted.
/// End:
///   The destructor writes what waits, for up to kMaxCloseMs. A disk that takes longer keeps its
///   thread and the ring; the process can end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "core/can_frame.hpp"
#include "platform/can_trace.hpp"

namespace plumb {

class CanTraceThread final : public CanSink {
 public:
  static constexpr std::size_t kCapacity = 4096;  ///< about 3 s of a bus of 1,400 frames a second
  static constexpr int kMaxCloseMs = 2'000;

  /// Opens the file and continues it when it exists; error() tells a failure. `offset_us` is added
  /// to every time stamp.
  CanTraceThread(const std::string& path, const std::string& interface, std::int64_t offset_us);
  ~CanTraceThread() override;
  CanTraceThread(const CanTraceThread&) = delete;
  CanTraceThread& operator=(const CanTraceThread&) = delete;

  /// Never waits.
  void send(std::int64_t time_us, const CanFrame& frame) override;
  /// "FILE: cannot write: No space left on device"; empty without a failure. After one nothing more
  /// is written.
  [[nodiscard]] const std::string& error() const;
  /// Frames that were taken.
  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }
  /// Frames for which there was no room.
  [[nodiscard]] std::int64_t num_dropped() const { return num_dropped_; }
  /// Writes what waits and stops, as the destructor. Returns whether all of it is in the file.
  bool close();

 private:
  struct Shared;
  static void run(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
  std::string no_error_;
  std::int64_t num_frames_ = 0;
  std::int64_t num_dropped_ = 0;
  bool is_closed_ = false;
};

}  // namespace plumb
