/// Lets one sender of a channel through: the newest that is heard.
///
/// Session:
///   Each run of a process has one, which its messages carry: the time at which it began.
/// Restart:
///   A process that begins anew has a newer session and is taken at once. An older session is taken
///   when the one that is followed has been silent for `silent_us`, and at the latest after
///   kMaxRefused messages in a row, so that two senders at the same time never mix.
/// Memory:
///   A few numbers.
#pragma once

#include <cstdint>

#include "modules/integrity/one_sender.hpp"

namespace plumb {

class CanSourceGuard {
 public:
  static constexpr int kMaxRefused = 6;  ///< three images of two messages

  explicit CanSourceGuard(std::int64_t silent_us) : silent_us_(silent_us) {}

  /// Returns whether a message of this session may be used.
  [[nodiscard]] bool take(std::int64_t session, std::int64_t now_us);

  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }

 private:
  std::int64_t silent_us_;
  OneSender sender_{kMaxRefused + 1};
  std::int64_t heard_us_ = 0;
  std::int64_t num_refused_ = 0;
};

}  // namespace plumb
