/// Judges one signal of a vehicle by its range and by how fast it can change.
///
/// A value is believed when it is in range and can be reached from the last believed one. After a
/// value that cannot, the next ones are measured against the last believed value, never against
/// the refused one: `recover_images` in a row must be reachable from it. While nothing is
/// believed, what is reachable grows at the sustained rate only, so that values that merely agree
/// with a refused one do not pass soon. Values that agree only among themselves are believed after
/// `reestablish_s` (the first refused one does not count); then `was_reestablished` is set, and
/// whoever integrates the signal must reset. Nothing is refused for ever.
///
/// Units:
///   Those of the signal; seconds.
/// Memory:
///   A few numbers.
#pragma once

#include <cstdint>

#include "core/numbers.hpp"

namespace plumb {

enum class PlausibilityReason : std::int8_t {
  kNone = 0,
  kNotMeasured = 1,   ///< the source does not give it (NaN)
  kOutOfRange = 2,    ///< beyond a limit of the vehicle
  kTooFast = 3,       ///< changes faster than a vehicle can
  kRecovering = 4,    ///< plausible again, not yet for long enough
  kInterval = 5,      ///< the time between the images is not known or not plausible
  kInconsistent = 6,  ///< contradicts another signal of the same image
  kDependent = 7,     ///< derived from a signal that is not valid
};

struct GuardLimits {
  double low = -kInf;
  double high = kInf;
  double rate = kInf;            ///< largest change per second from image to image
  double sustained_rate = kInf;  ///< the same, over the time in which nothing was believed
  double slack = 0.0;            ///< measurement noise that every comparison allows
};

class SignalGuard {
 public:
  SignalGuard(const GuardLimits& limits, int recover_images, double reestablish_s)
      : limits_(limits), recover_images_(recover_images), reestablish_s_(reestablish_s) {}

  /// Judges the next value, `interval_s` after the previous one. NaN: not available.
  PlausibilityReason update(double value, double interval_s);

  /// Believes nothing any more.
  void reset();

  /// Set by the update that believes values which cannot be reached from the earlier ones.
  [[nodiscard]] bool was_reestablished() const { return was_reestablished_; }

 private:
  [[nodiscard]] bool reachable(double value, double interval_s) const;
  [[nodiscard]] PlausibilityReason believe(double value);
  [[nodiscard]] PlausibilityReason doubt(double value, double interval_s);

  GuardLimits limits_;
  int recover_images_;
  double reestablish_s_;
  double believed_ = kNan;
  double age_s_ = 0.0;  ///< of `believed_`
  bool is_doubted_ = true;
  int num_reachable_ = 0;   ///< in a row, since the doubt
  double previous_ = kNan;  ///< last value in range that did not begin the doubt
  int num_agreeing_ = 0;    ///< in a row, that agree with the one before
  double agreeing_s_ = 0.0;
  bool was_reestablished_ = false;
};

}  // namespace plumb
