/// Judges the time stamps and sequence numbers of one source, in the order of their arrival.
///
/// The base is the line that the accepted images lie on: a last stamp and number, and the learned
/// interval per number. An image that agrees with the base is accepted. The others are kept, and
/// `agreeing_images` of them that agree among themselves become the new base; every other message
/// in between may be foreign. The base must not have accepted an image meanwhile: then somebody
/// else publishes on the channel. Images that were received before, or belong before the last
/// one, need twice as many. So a single bad stamp costs one image, and no fault locks the base.
///
/// What it cannot tell:
///   - A stamp that is wrong by less than the source's jitter.
///   - A change of the rate from a jump of the clock, in the first image that shows it.
///   - A change of the interval that is within the tolerance, on a source whose interval varies.
///
/// How to use:
///   `interval_s` is the time from image `reference_seq` to this one. Use it only when is_valid(),
///   and only for a motion that begins at that image.
/// Reset:
///   `reset_count` grows by one whenever the base changes its clock or its numbers, and never
///   otherwise. It begins at 0 in each process. A receiver that must notice the restart of the
///   sender, too, compares the pair (session, reset_count): `session` is the sender's start time in
///   microseconds, which its process shell takes from the real-time clock once and passes in; 0
///   means unknown. A pure library never makes one.
/// Units:
///   [us] for stamps, [s] for intervals.
/// Memory:
///   A few numbers, in place.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/numbers.hpp"
#include "modules/integrity/time_base_config.hpp"

namespace plumb {

enum class TimeReason : std::int8_t {
  kNone = 0,              ///< one interval after the reference; valid
  kGap = 1,               ///< images are missing in between, and the time agrees; valid
  kStarting = 2,          ///< no base yet, and nothing is wrong so far
  kRepeated = 3,          ///< stamp or number was received before
  kOutOfOrder = 4,        ///< belongs before an image that was accepted already
  kStampStalled = 5,      ///< the number grows, the stamp does not
  kNumberStalled = 6,     ///< the stamp grows, the number does not
  kIntervalDoubted = 7,   ///< the stamps say another interval than the numbers
  kJumpForward = 8,       ///< the stamp is far ahead of its number
  kJumpBack = 9,          ///< the stamp goes back while the number grows
  kWrongUnit = 10,        ///< the stamps would do in seconds, milliseconds or nanoseconds
  kNumbersAnew = 11,      ///< the numbers begin anew on the same clock
  kSourceRestarted = 12,  ///< another session, or numbers and clock begin anew
  kSecondPass = 13,       ///< an older part of the same log
  kSecondPublisher = 14,  ///< belongs to another sequence that is interleaved with the base
  kImplausibleRate = 15,  ///< the interval is outside [min_interval_s, max_interval_s]
};

/// One short clause for logs and health; "" for kNone.
[[nodiscard]] const char* describe(TimeReason reason);

struct TimeStampedImage {
  std::int64_t stamp_us = 0;
  std::int64_t seq = 0;
  std::int64_t session = 0;  ///< 0: the source does not state one
};

struct TimeVerdict {
  TimeReason reason = TimeReason::kStarting;
  double interval_s = kNan;         ///< from image `reference_seq`; valid images only
  double interval_std_s = kNan;     ///< of interval_s, by the jitter of the stamps
  std::int64_t reference_seq = -1;  ///< -1: none
  std::int64_t num_lost = 0;        ///< images that are missing between the two; kGap only
  bool is_new_base = false;         ///< this image completes a new base
  std::int32_t reset_count = 0;

  [[nodiscard]] bool is_valid() const {
    return reason == TimeReason::kNone || reason == TimeReason::kGap;
  }
  /// Whether the picture is a new one of this source, in order, though its stamp may be wrong.
  /// Tracking may go on with it; speed, rates and predictions may not.
  [[nodiscard]] bool is_next_picture() const {
    return is_valid() || reason == TimeReason::kStarting || reason == TimeReason::kStampStalled ||
           reason == TimeReason::kIntervalDoubted || reason == TimeReason::kJumpForward ||
           reason == TimeReason::kJumpBack || reason == TimeReason::kWrongUnit ||
           reason == TimeReason::kImplausibleRate;
  }
};

class TimeBase {
 public:
  explicit TimeBase(const TimeBaseConfig& config) : config_(config) {}

  TimeVerdict update(const TimeStampedImage& image);

  /// Whether there has been a base. Whether an image agrees with it, its verdict says.
  [[nodiscard]] bool has_base() const { return has_base_; }
  /// Learned interval of consecutive images [s]; NaN before the first base.
  [[nodiscard]] double nominal_interval_s() const { return interval_us_ * 1e-6; }
  [[nodiscard]] std::int32_t reset_count() const { return reset_count_; }

 private:
  static constexpr std::size_t kNumRecent = 64;

  static constexpr std::size_t kNumRefused = 128;

  struct Refused {
    TimeStampedImage image;
    std::int64_t num_accepted = 0;  ///< by the base until then
  };
  /// Refused images that agree among themselves, the newest one included.
  struct Chain {
    int num_images = 0;
    TimeStampedImage first;
    TimeStampedImage previous;
    TimeStampedImage last;
    double interval_us = kNan;  ///< per number
  };
  struct Step {
    std::int64_t num = 0;
    double us = 0.0;
  };

  [[nodiscard]] static Step step_between(const TimeStampedImage& from, const TimeStampedImage& to);
  [[nodiscard]] bool plausible(const Step& step) const;
  [[nodiscard]] double jitter_us(const Step& step) const;
  [[nodiscard]] double tolerance_us(const Step& step) const;
  [[nodiscard]] bool agrees_with_base(const TimeStampedImage& image) const;
  [[nodiscard]] bool was_received(const TimeStampedImage& image) const;
  [[nodiscard]] bool lies_on_base(const Step& step) const;
  [[nodiscard]] bool in_wrong_unit(const TimeStampedImage& image, const Step& step) const;
  [[nodiscard]] TimeReason blame(const TimeStampedImage& image) const;
  [[nodiscard]] TimeReason blame_forward(const TimeStampedImage& image, const Step& step) const;
  [[nodiscard]] TimeReason blame_backward(const Step& step) const;
  [[nodiscard]] TimeReason blame_chain(const TimeStampedImage& image) const;

  [[nodiscard]] TimeVerdict accept(const TimeStampedImage& image);
  void refuse(const TimeStampedImage& image);
  [[nodiscard]] const Refused& refused(std::size_t back) const;  ///< 0: the newest
  [[nodiscard]] std::size_t num_refused() const;
  [[nodiscard]] bool was_just_refused(const TimeStampedImage& image) const;
  [[nodiscard]] bool follows_refused(const TimeStampedImage& image) const;
  [[nodiscard]] bool is_second_publisher() const;
  [[nodiscard]] Chain find_chain(int num_images) const;
  [[nodiscard]] Chain grow_chain(std::size_t back, int num_images) const;
  [[nodiscard]] TimeVerdict adopt(const Chain& chain);
  [[nodiscard]] bool only_rate_changed(const Chain& chain) const;
  void remember(const TimeStampedImage& image);
  void learn(const Step& step, double rate);

  TimeBaseConfig config_;
  bool has_base_ = false;
  TimeStampedImage last_;  ///< accepted
  double interval_us_ = kNan;
  double spread_us_ = 0.0;           ///< mean absolute difference from the expected time
  std::int64_t num_unaccepted_ = 0;  ///< next pictures received since `last_`
  std::int64_t num_accepted_ = 0;
  std::array<Refused, kNumRefused> refused_{};
  std::size_t num_refused_ = 0;
  std::array<TimeStampedImage, kNumRecent> recent_{};
  std::size_t num_recent_ = 0;
  std::int32_t reset_count_ = 0;
};

}  // namespace plumb
