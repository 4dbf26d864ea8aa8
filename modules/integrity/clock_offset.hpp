/// Maps a source's time stamps to the local monotonic clock, and so gives the age of any content.
///
/// The offset is the smallest lag (time of receipt less stamp) over a sliding window: the message
/// that was delivered fastest. A late message cannot raise it. A source whose clock drifts by d
/// against ours makes the mapped time wrong by at most d times the window (100 ppm, 60 s: 6 ms).
/// A stamp that jumps forward lowers the lag and is followed at once. A stamp that jumps back looks
/// like a late message: ages are then too large, which is the safe side, until the caller reports
/// the new time base by another `ClockEpoch`, or the window has passed.
///
/// What it cannot tell:
///   The transport's smallest delay is part of the offset: ages are too small by it. A backlog that
///   is read first of all looks like a delay of the transport, until one message is on time.
/// Units:
///   [us]; `receive_us` and `now_us` are of one monotonic clock and never 0 or less.
/// Memory:
///   kNumBuckets minima, in place.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace plumb {

struct ClockOffsetConfig {
  double window_s = 60.0;
  int min_messages = 2;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("clock.window_s", c.window_s, 2.0, 3600.0,
          "the smallest lag within this time maps the source's clock to the local one");
    field("clock.min_messages", c.min_messages, 1, 100,
          "messages before the offset of the clocks is called known");
  }
};

/// Names one continuous time line of a source: its session (TimeStampedImage::session), and the
/// reset_count of the TimeBase that judges its stamps.
struct ClockEpoch {
  std::int64_t session = 0;
  std::int32_t reset_count = 0;

  bool operator==(const ClockEpoch&) const = default;
};

class ClockOffset {
 public:
  explicit ClockOffset(const ClockOffsetConfig& config);

  /// Takes a message whose stamp is valid (TimeVerdict::is_valid()). Another epoch begins anew.
  void update(std::int64_t stamp_us, std::int64_t receive_us, const ClockEpoch& epoch);

  [[nodiscard]] bool is_known() const { return num_messages_ >= config_.min_messages; }
  /// The stamp on the local monotonic clock; nothing while the offset is not known.
  [[nodiscard]] std::optional<std::int64_t> capture_us(std::int64_t stamp_us) const;
  /// Age of what was captured at the stamp, never negative; nothing while it is not known.
  [[nodiscard]] std::optional<std::int64_t> age_us(std::int64_t stamp_us,
                                                   std::int64_t now_us) const;

 private:
  static constexpr std::size_t kNumBuckets = 12;
  struct Bucket {
    std::int64_t index = -1;  ///< of the bucket's time since 0
    std::int64_t smallest_lag_us = 0;
  };

  ClockOffsetConfig config_;
  std::int64_t bucket_us_;
  std::array<Bucket, kNumBuckets> buckets_{};
  ClockEpoch epoch_;
  int num_messages_ = 0;
  std::int64_t offset_us_ = 0;
};

}  // namespace plumb
