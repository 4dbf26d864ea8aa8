/// How long results take from their arrival at the monitor to the picture on a page, by what pages
/// acknowledge once they have drawn it. The way back of the acknowledgement is included.
///
/// Threads:
///   Any.
/// Memory:
///   The newest kKept packets and delays.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>

namespace plumb {

class PageLatency {
 public:
  static constexpr std::size_t kKept = 64;

  /// The packet `id` shows what arrived at `arrival_us`.
  void sent(std::int64_t id, std::int64_t arrival_us) {
    const std::lock_guard lock(mutex_);
    arrivals_[static_cast<std::size_t>(id) % kKept] = {id, arrival_us};
  }
  void drawn(std::int64_t id, std::int64_t now_us) {
    const std::lock_guard lock(mutex_);
    const auto& [sent_id, arrival_us] = arrivals_[static_cast<std::size_t>(id) % kKept];
    if (sent_id != id) return;
    delays_us_[num_delays_++ % kKept] = now_us - arrival_us;
  }
  /// [us] The delay that the share `share` of the newest ones does not exceed; -1 without any.
  [[nodiscard]] std::int64_t quantile_us(double share) const {
    const std::lock_guard lock(mutex_);
    const std::size_t count = std::min(num_delays_, kKept);
    if (count == 0) return -1;
    auto sorted = delays_us_;
    std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
    return sorted[std::min(count - 1,
                           static_cast<std::size_t>(share * static_cast<double>(count)))];
  }

 private:
  struct Sent {
    std::int64_t id = -1;
    std::int64_t arrival_us = 0;
  };
  mutable std::mutex mutex_;
  std::array<Sent, kKept> arrivals_;
  std::array<std::int64_t, kKept> delays_us_{};
  std::size_t num_delays_ = 0;
};

}  // namespace plumb
