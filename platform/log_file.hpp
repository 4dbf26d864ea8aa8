/// Reads and writes LCM log files. The reader returns every intact event and reports where the file
/// is damaged. The writer loses no event that it accepted.
///
/// Format:
///   Each event is big-endian: sync word 0xEDA1DA01, event number (i64), time stamp (i64, us),
///   channel length (i32), data length (i32), channel, data.
/// Memory:
///   The reader owns one buffer, which grows to the largest event. The views in an event are valid
///   until the next call.
/// Errors:
///   Both classes throw LogError ("FILE: reason").
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

/// The exception for a log that cannot be opened, read or written. Programs print it and stop.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct LogEvent {
  std::int64_t number = 0;
  std::int64_t log_us = 0;  ///< time at the logger, or the capture time in a converted log
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

/// Reads a log event by event. After damage the reader searches for the next sync word, and it
/// reports every damaged place.
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

  /// Reads the next intact event. Returns false at the end. Throws LogError when the device fails.
  [[nodiscard]] bool next(LogEvent* event);

  /// The first kMaxProblems damaged places as "FILE: byte OFFSET: reason".
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

/// Writes a log. After a failed write, for example on a full disk,
/// the file is cut back to its last complete event.
class LogWriter {
 public:
  /// Creates or replaces the file. Throws LogError.
  explicit LogWriter(const std::string& path);
  /// Closes the file without reporting an error. Call close() to learn of one.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Appends one event. Throws LogError ("FILE: cannot write: No space left on device").
  void write(std::int64_t log_us, std::string_view channel, std::span<const std::uint8_t> data);
  /// Passes everything written to the system, so that other programs can read it. Throws LogError.
  void flush();
  /// Passes everything written to the system and closes the file. Throws LogError.
  void close();
  [[nodiscard]] std::int64_t num_events() const { return num_events_; }

 private:
  void release() noexcept;

  std::string path_;
  int fd_ = -1;
  std::int64_t num_events_ = 0;
  std::int64_t written_bytes_ = 0;  ///< passed to the system, always whole events
  std::vector<std::uint8_t> buffer_;
};

}  // namespace plumb
