/// Writes a recording: one log, or a row of logs of limited size and duration of which the oldest
/// go when the disk limit is reached.
///
/// Errors:
///   Functions throw LogError.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "platform/log_file.hpp"

namespace plumb {

struct RecordingLimits {
  std::int64_t split_bytes = 0;  ///< a part ends when it is as large; 0: no limit
  std::int64_t split_us = 0;     ///< a part ends when it is as long; 0: no limit
  std::int64_t keep_bytes = 0;   ///< of all parts on the disk; 0: no limit
  std::int64_t free_bytes = 0;   ///< that the disk must keep free
};

class Recording {
 public:
  /// Begins with write(). With a limit to a part, the parts of drive.lcm are drive_0000.lcm,
  /// drive_0001.lcm and so on. The calibration of the camera stands at the head of each.
  Recording(std::filesystem::path path, const RecordingLimits& limits);

  /// Writes a message. Returns why the recording has to end; null while it goes on.
  const char* write(std::int64_t log_us, std::string_view channel,
                    std::span<const std::uint8_t> bytes);
  /// Passes everything to the system.
  void flush();
  void close();

  /// The file with which a recording to `path` begins.
  [[nodiscard]] static std::filesystem::path first_part(const std::filesystem::path& path,
                                                        const RecordingLimits& limits);
  [[nodiscard]] std::int64_t num_messages() const { return num_messages_; }
  [[nodiscard]] std::int64_t num_bytes() const { return num_bytes_; }
  [[nodiscard]] std::int64_t num_parts() const { return num_parts_; }
  [[nodiscard]] std::int64_t num_deleted() const { return num_deleted_; }

 private:
  struct Part {
    std::filesystem::path path;
    std::int64_t bytes = 0;
  };
  [[nodiscard]] bool is_split() const { return limits_.split_bytes > 0 || limits_.split_us > 0; }
  [[nodiscard]] bool part_is_over(std::int64_t log_us) const;
  void begin_part(std::int64_t log_us);
  void append(std::int64_t log_us, std::string_view channel, std::span<const std::uint8_t> bytes);
  const char* keep_limits();
  [[nodiscard]] std::filesystem::path part_path(std::int64_t number) const;

  std::filesystem::path path_;
  RecordingLimits limits_;
  std::optional<LogWriter> log_;
  std::deque<Part> parts_;  ///< on the disk, the newest last
  std::int64_t part_begin_us_ = 0;
  std::int64_t bytes_at_check_ = 0;
  std::int64_t kept_bytes_ = 0;
  std::int64_t num_parts_ = 0;
  std::int64_t num_deleted_ = 0;
  std::int64_t num_messages_ = 0;
  std::int64_t num_bytes_ = 0;
  std::vector<std::uint8_t> calibration_;
};

}  // namespace plumb
