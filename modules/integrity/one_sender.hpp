/// Follows one of several senders on a channel, by the session in their messages.
///
/// A session is the time at which its sender began, so that the larger one is the newer. It is
/// followed at once: the sender was restarted, or what was followed is a recording that is being
/// played. A message of an older session is refused, until `num_in_row` of them have come without
/// one of the followed session in between: then the clock was set back. Two senders that publish at
/// the same time never take turns.
#pragma once

#include <cstdint>

namespace plumb {

class OneSender {
 public:
  enum class Verdict : std::uint8_t {
    kSame,    ///< of the session that is followed
    kNew,     ///< of a session that is followed from this message on
    kForeign  ///< of another sender: the message is to be refused
  };

  explicit OneSender(int num_in_row = 3) : num_in_row_(num_in_row) {}

  /// Follows whoever is heard next.
  void forget() { is_started_ = false; }

  Verdict take(std::int64_t session) {
    if (!is_started_ || session > session_) {
      is_started_ = true;
      session_ = session;
      num_foreign_ = 0;
      return Verdict::kNew;
    }
    if (session == session_) {
      num_foreign_ = 0;
      return Verdict::kSame;
    }
    num_foreign_ = session == candidate_ ? num_foreign_ + 1 : 1;
    candidate_ = session;
    if (num_foreign_ < num_in_row_) return Verdict::kForeign;
    session_ = session;
    num_foreign_ = 0;
    return Verdict::kNew;
  }

 private:
  int num_in_row_;
  bool is_started_ = false;
  std::int64_t session_ = 0;
  std::int64_t candidate_ = 0;
  int num_foreign_ = 0;  ///< messages of `candidate_` in a row
};

}  // namespace plumb
