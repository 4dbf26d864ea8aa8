/// Writes CAN frames to a text file in the format of `candump -L`, and reads such files.
///
/// Format:
///   One line per frame: `(1436509052.249713) can0 3A0#DEADBEEF`; for CAN FD `3A0##1DEADBEEF`.
/// Memory:
///   The writer owns one buffer; nothing grows after construction.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "core/can_frame.hpp"

namespace plumb {

/// Writes a trace. After a failure, for example a full disk, error() names it and nothing more is
/// written; send() never throws.
class CanTraceWriter final : public CanSink {
 public:
  /// What becomes of a file that exists.
  enum class Existing { kReplaced, kContinued };

  /// Creates, replaces or continues the file; error() tells a failure. `interface` is the name on
  /// each line.
  CanTraceWriter(const std::string& path, const std::string& interface,
                 Existing existing = Existing::kReplaced);
  ~CanTraceWriter() override;
  CanTraceWriter(const CanTraceWriter&) = delete;
  CanTraceWriter& operator=(const CanTraceWriter&) = delete;

  /// Sets what is added to every time stamp, for example to turn a monotonic clock into calendar
  /// time.
  void set_time_offset_us(std::int64_t offset_us) { offset_us_ = offset_us; }

  void send(std::int64_t time_us, const CanFrame& frame) override;
  /// Writes the buffer to the file. Returns false after a failure.
  bool flush();
  /// Ends a flush() that waits for a reader of a pipe; called from another thread.
  void give_up() { gives_up_ = true; }
  /// "FILE: cannot write: No space left on device"; empty without a failure.
  [[nodiscard]] const std::string& error() const { return error_; }
  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }

 private:
  void fail(const char* what, int error_number);
  void end_partial_line();
  void wait_for_room() const;

  std::string path_;
  std::string interface_;
  std::string error_;
  int fd_ = -1;
  std::int64_t offset_us_ = 0;
  std::int64_t num_frames_ = 0;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::atomic<bool> gives_up_ = false;
};

/// Reads one line of a trace, with or without its line break. Returns false when it is no frame.
[[nodiscard]] bool read_trace_line(const char* line, std::int64_t* time_us, CanFrame* frame);

/// Reads a trace line by line; empty lines are skipped.
class CanTraceReader {
 public:
  /// error() tells when the file cannot be opened.
  explicit CanTraceReader(const std::string& path);

  /// Returns false at the end of the file and at the first line that is not a frame, which error()
  /// names.
  [[nodiscard]] bool next(std::int64_t* time_us, CanFrame* frame);
  /// "FILE:line: not a CAN frame"; empty without a failure.
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::string error_;
  std::unique_ptr<std::FILE, Close> file_;
  int line_ = 0;
};

}  // namespace plumb
