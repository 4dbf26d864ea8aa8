/// LCM log files: read what is intact, say where the rest broke, and write without losing an
/// accepted event.
///
/// Format   per event, big-endian: sync word 0xEDA1DA01, event number (i64), time stamp (i64, us),
///          channel length (i32), data length (i32), channel, data.
/// Memory   the reader owns one buffer that grows to the largest event; an event's views end with
/// the next call.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// A log cannot be opened, read or written: "FILE: reason". Programs print it and stop.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t log_us = 0;  ///< when the logger saw it, or the true time in a converted log
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

/// Reads event by event. Damage is skipped by searching for the next sync word; every damaged place
/// is reported.
class LogReader {
 public:
  static constexpr std::int32_t kMaxChannelBytes = 63;
  static constexpr std::int32_t kMaxDataBytes = 64 << 20;
  static constexpr std::size_t kMaxProblems = 32;

  /// Throws LogError when the file cannot be opened.
  explicit LogReader(const std::string& path);
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// The next intact event; false at the end. Throws LogError when the device fails.
  [[nodiscard]] bool next(LogEvent* event);

  /// "FILE: byte OFFSET: reason", the first kMaxProblems of them; empty for a sound log.
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }
  [[nodiscard]] std::int64_t num_problems() const { return num_problems_; }
  [[nodiscard]] std::int64_t num_events() const { return num_events_; }
  [[nodiscard]] std::int64_t file_bytes() const { return file_bytes_; }
  [[nodiscard]] std::int64_t offset_bytes() const { return offset_; }  ///< for progress bars

 private:
  struct Header;
  bool read_at(std::int64_t offset, void* out, std::size_t bytes) const;
  bool read_header(std::int64_t offset, Header* header) const;
  bool sync_at(std::int64_t offset) const;
  std::int64_t find_event(std::int64_t from, std::int64_t to) const;
  void report(std::int64_t offset, const std::string& reason);
  void skip_damage(const std::string& reason);

  std::string path_;
  int fd_ = -1;
  std::int64_t file_bytes_ = 0;
  std::int64_t offset_ = 0;
  std::int64_t num_events_ = 0;
  std::int64_t num_problems_ = 0;
  std::vector<std::string> problems_;
  std::vector<std::uint8_t> buffer_;
};

/// Writes a log. After a failed write (full disk) the file is cut back to its last complete event.
class LogWriter {
 public:
  /// Creates or replaces the file. Throws LogError.
  explicit LogWriter(const std::string& path);
  /// Closes without reporting; call close() to know.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Appends one event. Throws LogError ("FILE: cannot write: No space left on device").
  void write(std::int64_t log_us, std::string_view channel, std::span<const std::uint8_t> data);
  /// Everything written is handed to the system. Throws LogError.
  void close();
  [[nodiscard]] std::int64_t num_events() const { return num_events_; }

 private:
  void flush();
  void release() noexcept;

  std::string path_;
  int fd_ = -1;
  std::int64_t num_events_ = 0;
  std::int64_t written_bytes_ = 0;  ///< handed to the system, always whole events
  std::vector<std::uint8_t> buffer_;
};

}  // namespace plumb
