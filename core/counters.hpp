/// What a process counts about its messages, and the order of a numbered stream.
#pragma once

#include <cstdint>

namespace plumb {

/// One per process; published in process_health_t.
struct Counters {
  std::int64_t num_received = 0;
  std::int64_t num_rejected = 0;  ///< broke their contract
  std::int64_t num_dropped = 0;   ///< missing by sequence number
  std::int64_t num_late = 0;      ///< done later than the channel's stale time after arrival
  std::int64_t num_published = 0;
  std::int64_t num_unsent = 0;      ///< did not fit, or refused by the socket
  const char* last_rejection = "";  ///< why, of the newest rejected message

  void reject(const char* why) {
    ++num_rejected;
    last_rejection = why;
  }
};

enum class SeqStep : std::uint8_t {
  kFirst,    ///< nothing came before
  kNext,     ///< +1
  kGap,      ///< some are missing
  kRepeat,   ///< the same number again
  kRestart,  ///< the source began anew: backwards, or too far ahead to be a loss
};

/// Counts what a stream lost, by the sequence numbers of what arrived.
class LossCounter {
 public:
  /// A jump beyond this is a restarted source, not a loss.
  static constexpr std::uint64_t kMaxGap = 100'000;

  SeqStep take(std::int64_t seq) {
    // Unsigned difference: defined for every pair of numbers, hostile ones included.
    const std::uint64_t ahead = static_cast<std::uint64_t>(seq) - static_cast<std::uint64_t>(last_);
    const bool first = !started_;
    started_ = true;
    last_ = seq;
    if (first) return SeqStep::kFirst;
    if (ahead == 0) return SeqStep::kRepeat;
    if (ahead == 1) return SeqStep::kNext;
    if (ahead > kMaxGap) return SeqStep::kRestart;
    num_lost_ += static_cast<std::int64_t>(ahead - 1);
    return SeqStep::kGap;
  }
  [[nodiscard]] std::int64_t num_lost() const { return num_lost_; }

 private:
  bool started_ = false;
  std::int64_t last_ = 0;
  std::int64_t num_lost_ = 0;
};

}  // namespace plumb
