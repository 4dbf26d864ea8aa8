/// What became of a received packet. Each packet has exactly one outcome, and each is counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb {

enum class UdpmOutcome : std::uint8_t {
  kMessage,       ///< it completed a message, which was queued
  kFragment,      ///< it was stored; its message is not complete yet
  kUnsubscribed,  ///< nobody here reads its channel
  // All that follow are refusals.
  kForeignSource,        ///< its sender is neither on this machine nor named
  kTooShort,             ///< shorter than its header
  kUnknownMagic,         ///< not LCM
  kChannelUnterminated,  ///< no NUL after the channel
  kChannelEmpty,
  kChannelTooLong,
  kFragmentNumber,    ///< fragment number >= number of fragments
  kFragmentRange,     ///< reaches beyond its message
  kTooLarge,          ///< larger than its channel's messages may be
  kTooManyFragments,  ///< cut into smaller pieces than any sender makes
  kDuplicate,         ///< this fragment came before
  kInconsistent,      ///< contradicts other fragments of its message
  kNoRoom,   ///< its message cannot be opened: all places are taken by messages with a channel
  kGivenUp,  ///< its message was given up before
};

inline constexpr std::size_t kNumUdpmOutcomes = static_cast<std::size_t>(UdpmOutcome::kGivenUp) + 1;

/// For a log line, e.g. "the channel is not terminated".
[[nodiscard]] const char* describe(UdpmOutcome outcome);

[[nodiscard]] inline bool is_refusal(UdpmOutcome outcome) {
  return outcome > UdpmOutcome::kUnsubscribed;
}

/// Counts packets by what became of them.
class UdpmOutcomeCounts {
 public:
  void add(UdpmOutcome outcome) { ++counts_[static_cast<std::size_t>(outcome)]; }
  [[nodiscard]] std::int64_t operator[](UdpmOutcome outcome) const {
    return counts_[static_cast<std::size_t>(outcome)];
  }
  [[nodiscard]] std::int64_t num_refused() const {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < kNumUdpmOutcomes; ++i)
      if (is_refusal(static_cast<UdpmOutcome>(i))) sum += counts_[i];
    return sum;
  }

 private:
  std::array<std::int64_t, kNumUdpmOutcomes> counts_{};
};

}  // namespace plumb
