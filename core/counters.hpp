/// The message counters of a process, and a detector of losses in a numbered stream.
#pragma once

#include <cstdint>

namespace plumb {

/// Each process has one set of counters and publishes it in process_health_t.
struct Counters {
  std::int64_t num_received = 0;
  std::int64_t num_rejected = 0;  ///< messages that broke their contract
  std::int64_t num_dropped = 0;   ///< messages missing by number, or let go from a full store
  std::int64_t num_late = 0;      ///< messages older than the channel's stale time when handled
  std::int64_t num_published = 0;
  std::int64_t num_unsent = 0;      ///< messages that did not fit or that the socket refused
  std::int64_t num_skipped = 0;     ///< messages left out because a newer one waited
  std::int64_t num_unpaired = 0;    ///< results made without an input that did not come in time
  const char* last_rejection = "";  ///< reason for the newest rejection

  void reject(const char* why) {
    ++num_rejected;
    last_rejection = why;
  }
};

enum class SeqStep : std::uint8_t {
  kFirst,    ///< no number came before
  kNext,     ///< the number grew by one
  kGap,      ///< numbers are missing
  kRepeat,   ///< the number came before
  kRestart,  ///< the source restarted: the number went back, or too far ahead for a loss
};

/// Counts the messages that a stream lost, by the sequence numbers of those that arrived.
class LossCounter {
 public:
  /// A longer jump means that the source restarted.
  static constexpr std::uint64_t kMaxGap = 100'000;

  SeqStep take(std::int64_t seq) {
    // The unsigned difference is defined for every pair of numbers, also for hostile ones.
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
  /// The next number begins another stream. What was lost stays counted.
  void restart() { started_ = false; }
  [[nodiscard]] std::int64_t num_lost() const { return num_lost_; }

 private:
  bool started_ = false;
  std::int64_t last_ = 0;
  std::int64_t num_lost_ = 0;
};

}  // namespace plumb
