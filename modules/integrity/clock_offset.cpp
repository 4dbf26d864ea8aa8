#include "modules/integrity/clock_offset.hpp"

#include <algorithm>

#include "modules/integrity/stamp_difference.hpp"

namespace plumb {

ClockOffset::ClockOffset(const ClockOffsetConfig& config)
    : config_(config),
      bucket_us_(static_cast<std::int64_t>(config.window_s * 1e6) /
                 static_cast<std::int64_t>(kNumBuckets)) {}

void ClockOffset::update(std::int64_t stamp_us, std::int64_t receive_us, const ClockEpoch& epoch) {
  if (!(epoch == epoch_)) {
    epoch_ = epoch;
    buckets_ = {};
    num_messages_ = 0;
  }
  const std::int64_t lag = stamp_difference(receive_us, stamp_us);
  const std::int64_t index = receive_us / bucket_us_;
  Bucket& bucket = buckets_[static_cast<std::size_t>(index) % kNumBuckets];
  if (bucket.index != index) bucket = {index, lag};
  bucket.smallest_lag_us = std::min(bucket.smallest_lag_us, lag);
  offset_us_ = lag;
  for (const Bucket& other : buckets_) {
    const bool in_window =
        other.index >= 0 && index - other.index < static_cast<std::int64_t>(kNumBuckets);
    if (in_window) offset_us_ = std::min(offset_us_, other.smallest_lag_us);
  }
  num_messages_ = std::min(num_messages_ + 1, config_.min_messages);
}

std::optional<std::int64_t> ClockOffset::capture_us(std::int64_t stamp_us) const {
  std::int64_t capture = 0;
  if (!is_known() || __builtin_add_overflow(stamp_us, offset_us_, &capture)) return std::nullopt;
  return capture;
}

std::optional<std::int64_t> ClockOffset::age_us(std::int64_t stamp_us, std::int64_t now_us) const {
  const std::optional<std::int64_t> capture = capture_us(stamp_us);
  if (!capture) return std::nullopt;
  return std::max<std::int64_t>(0, stamp_difference(now_us, *capture));
}

}  // namespace plumb
