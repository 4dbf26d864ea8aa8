#include "modules/integrity/time_base.hpp"

#include <algorithm>
#include <cmath>

#include "modules/integrity/stamp_difference.hpp"

namespace plumb {
namespace {

constexpr double kSecondsToUs = 1e6;
/// Tolerance of an expected time: this many times the learned spread, never more than a share of
/// the interval.
constexpr double kSpreadFactor = 5.0;
constexpr double kLargestShare = 0.45;
/// Two intervals agree before anything is learned when they differ by a smaller share.
constexpr double kChainShare = 0.3;
/// Rate by which the interval may drift while images are missing.
constexpr double kDriftShare = 0.02;
constexpr double kIntervalLearningRate = 0.1;
constexpr double kDoubtedRate = 0.02;
/// Tolerance, as a share of the time, for lying on the line of an older part.
constexpr double kOldLineShare = 0.05;
/// Messages among which the one before is looked for: every other one may be foreign.
constexpr std::size_t kReach = 2;
/// A refused image is forgotten when the base accepts this many times `agreeing_images` without it.
constexpr std::int64_t kForgetFactor = 3;
/// Images of a new base that are further apart have nothing to do with each other.
constexpr double kLongestLinkUs = 10e6;
constexpr double kUnitTolerance = 0.1;
constexpr std::array<double, 4> kUnits = {1e-6, 1e-3, 1e3, 1e6};

bool same_message(const TimeStampedImage& a, const TimeStampedImage& b) {
  return a.seq == b.seq && a.stamp_us == b.stamp_us && a.session == b.session;
}

}  // namespace

const char* describe(TimeReason reason) {
  switch (reason) {
    case TimeReason::kNone:
      return "";
    case TimeReason::kGap:
      return "images are missing";
    case TimeReason::kStarting:
      return "the time base is not known yet";
    case TimeReason::kRepeated:
      return "the image was received before";
    case TimeReason::kOutOfOrder:
      return "the image came out of order";
    case TimeReason::kStampStalled:
      return "the time stamp stands still";
    case TimeReason::kNumberStalled:
      return "the sequence number stands still";
    case TimeReason::kIntervalDoubted:
      return "time stamps and sequence numbers disagree";
    case TimeReason::kJumpForward:
      return "the time stamp jumped forward";
    case TimeReason::kJumpBack:
      return "the time stamp jumped back";
    case TimeReason::kWrongUnit:
      return "the time stamps are not in microseconds";
    case TimeReason::kNumbersAnew:
      return "the sequence numbers began anew";
    case TimeReason::kSourceRestarted:
      return "the source was restarted";
    case TimeReason::kSecondPass:
      return "an older part of the same log was received again";
    case TimeReason::kSecondPublisher:
      return "a second source publishes on the channel";
    case TimeReason::kImplausibleRate:
      return "the image rate is not plausible";
  }
  return "";
}

TimeVerdict TimeBase::update(const TimeStampedImage& image) {
  if (has_base_ && agrees_with_base(image)) return accept(image);

  TimeVerdict verdict;
  verdict.reason = blame(image);
  verdict.reset_count = reset_count_;
  // The same message once more says nothing about a new base.
  if (was_just_refused(image)) return verdict;
  refuse(image);

  const bool is_old =
      verdict.reason == TimeReason::kRepeated || verdict.reason == TimeReason::kOutOfOrder;
  const int needed = has_base_ && is_old ? 2 * config_.agreeing_images : config_.agreeing_images;
  const Chain chain = find_chain(needed);
  if (chain.num_images >= needed) return adopt(chain);

  if (has_base_ && !is_old && is_second_publisher()) verdict.reason = TimeReason::kSecondPublisher;
  if (verdict.is_next_picture()) ++num_unaccepted_;
  if (has_base_ && verdict.reason == TimeReason::kIntervalDoubted)
    learn(step_between(last_, image), kDoubtedRate);
  return verdict;
}

TimeBase::Step TimeBase::step_between(const TimeStampedImage& from, const TimeStampedImage& to) {
  return {stamp_difference(to.seq, from.seq),
          static_cast<double>(stamp_difference(to.stamp_us, from.stamp_us))};
}

bool TimeBase::plausible(const Step& step) const {
  if (step.num < 1 || step.us <= 0.0) return false;
  const double per_image = step.us / static_cast<double>(step.num);
  return per_image >= config_.min_interval_s * kSecondsToUs &&
         per_image <= config_.max_interval_s * kSecondsToUs;
}

/// What of an interval may be jitter of its two stamps instead of time that has passed: all by
/// which it differs from the usual one, as long as jitter is that large.
double TimeBase::jitter_us(const Step& step) const {
  const double off = std::abs(step.us - interval_us_ * static_cast<double>(step.num));
  return std::min(off, config_.jitter_s * kSecondsToUs);
}

double TimeBase::tolerance_us(const Step& step) const {
  const double jitter = std::max(config_.jitter_s * kSecondsToUs, kSpreadFactor * spread_us_);
  const double drift = kDriftShare * interval_us_ * static_cast<double>(step.num - 1);
  return std::min(jitter + drift, kLargestShare * interval_us_);
}

bool TimeBase::agrees_with_base(const TimeStampedImage& image) const {
  const Step step = step_between(last_, image);
  if (image.session != last_.session || !plausible(step)) return false;
  const double expected = interval_us_ * static_cast<double>(step.num);
  return std::abs(step.us - expected) <= tolerance_us(step);
}

bool TimeBase::was_received(const TimeStampedImage& image) const {
  const std::size_t count = std::min(num_recent_, kNumRecent);
  return std::any_of(recent_.begin(), recent_.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const TimeStampedImage& old) { return same_message(old, image); });
}

/// Whether an image that is `step` away lies on the base's line, backward too.
bool TimeBase::lies_on_base(const Step& step) const {
  const double expected = interval_us_ * static_cast<double>(step.num);
  return std::abs(step.us - expected) <= std::max(interval_us_, kOldLineShare * std::abs(expected));
}

/// Whether stamp and interval would fit in another unit.
bool TimeBase::in_wrong_unit(const TimeStampedImage& image, const Step& step) const {
  const auto is_factor = [](double ratio) {
    return std::any_of(kUnits.begin(), kUnits.end(),
                       [&](double unit) { return std::abs(ratio / unit - 1.0) <= kUnitTolerance; });
  };
  if (has_base_ && last_.stamp_us != 0 &&
      is_factor(static_cast<double>(image.stamp_us) / static_cast<double>(last_.stamp_us))) {
    return true;
  }
  if (has_base_ && num_refused() == 0) return false;
  // Two images or more of a sequence, none of which has ever been right.
  const Step own = has_base_ ? step_between(refused(0).image, image) : step;
  if (own.num < 1 || own.us <= 0.0 || plausible(own)) return false;
  return std::any_of(kUnits.begin(), kUnits.end(), [&](double unit) {
    return plausible({own.num, own.us / unit});
  });
}

TimeReason TimeBase::blame(const TimeStampedImage& image) const {
  if (!has_base_) return blame_chain(image);
  if (image.session != last_.session) return TimeReason::kSourceRestarted;
  if (was_received(image)) {
    return stamp_difference(last_.seq, image.seq) <= config_.reorder_images
               ? TimeReason::kRepeated
               : TimeReason::kSecondPass;
  }
  const Step step = step_between(last_, image);
  if (in_wrong_unit(image, step)) return TimeReason::kWrongUnit;
  if (step.num > 0) return blame_forward(image, step);
  if (step.num == 0) return step.us == 0.0 ? TimeReason::kRepeated : TimeReason::kNumberStalled;
  return blame_backward(step);
}

TimeReason TimeBase::blame_forward(const TimeStampedImage& image, const Step& step) const {
  if (step.us == 0.0) return TimeReason::kStampStalled;
  // A stamp that stands still at a wrong value.
  if (num_refused() > 0 && refused(0).num_accepted == num_accepted_ &&
      image.stamp_us == refused(0).image.stamp_us)
    return TimeReason::kStampStalled;
  if (step.us < 0.0) return TimeReason::kJumpBack;
  const double expected = interval_us_ * static_cast<double>(step.num);
  return step.us - expected > config_.max_interval_s * kSecondsToUs ? TimeReason::kJumpForward
                                                                    : TimeReason::kIntervalDoubted;
}

TimeReason TimeBase::blame_backward(const Step& step) const {
  if (lies_on_base(step)) {
    return -step.num <= config_.reorder_images ? TimeReason::kOutOfOrder : TimeReason::kSecondPass;
  }
  return step.us > 0.0 ? TimeReason::kNumbersAnew : TimeReason::kSourceRestarted;
}

/// Before there is a base: against the previous image alone.
TimeReason TimeBase::blame_chain(const TimeStampedImage& image) const {
  if (num_refused() == 0) return TimeReason::kStarting;
  if (was_just_refused(image)) return TimeReason::kRepeated;
  if (follows_refused(image)) return TimeReason::kStarting;
  const TimeStampedImage& last = refused(0).image;
  if (image.session != last.session) return TimeReason::kSourceRestarted;
  const Step step = step_between(last, image);
  if (step.num == 0) return step.us == 0.0 ? TimeReason::kRepeated : TimeReason::kNumberStalled;
  if (step.num < 0 && step.us > 0.0) return TimeReason::kNumbersAnew;
  if (step.num < 0) {
    return -step.num <= config_.reorder_images ? TimeReason::kOutOfOrder
                                               : TimeReason::kSourceRestarted;
  }
  if (step.us == 0.0) return TimeReason::kStampStalled;
  if (step.us < 0.0) return TimeReason::kJumpBack;
  return in_wrong_unit(image, step) ? TimeReason::kWrongUnit : TimeReason::kImplausibleRate;
}

TimeVerdict TimeBase::accept(const TimeStampedImage& image) {
  const Step step = step_between(last_, image);
  TimeVerdict verdict;
  verdict.interval_s = step.us / kSecondsToUs;
  verdict.interval_std_s = jitter_us(step) / kSecondsToUs;
  verdict.reference_seq = last_.seq;
  verdict.num_lost = std::max<std::int64_t>(0, step.num - 1 - num_unaccepted_);
  verdict.reason = verdict.num_lost > 0 ? TimeReason::kGap : TimeReason::kNone;
  verdict.reset_count = reset_count_;
  learn(step, kIntervalLearningRate);
  last_ = image;
  num_unaccepted_ = 0;
  ++num_accepted_;
  remember(image);
  return verdict;
}

void TimeBase::refuse(const TimeStampedImage& image) {
  refused_[num_refused_ % kNumRefused] = {image, num_accepted_};
  ++num_refused_;
}

const TimeBase::Refused& TimeBase::refused(std::size_t back) const {
  return refused_[(num_refused_ - 1 - back) % kNumRefused];
}

std::size_t TimeBase::num_refused() const { return std::min(num_refused_, kNumRefused); }

bool TimeBase::was_just_refused(const TimeStampedImage& image) const {
  for (std::size_t back = 0; back < std::min(kReach, num_refused()); ++back)
    if (same_message(refused(back).image, image)) return true;
  return false;
}

/// Whether the image can be the next one after one of the last refused ones.
bool TimeBase::follows_refused(const TimeStampedImage& image) const {
  for (std::size_t back = 0; back < std::min(kReach, num_refused()); ++back) {
    const TimeStampedImage& old = refused(back).image;
    if (old.session == image.session && plausible(step_between(old, image))) return true;
  }
  return false;
}

/// Whether the newest refused image follows one that was refused before the base went on.
bool TimeBase::is_second_publisher() const {
  const TimeStampedImage& newest = refused(0).image;
  for (std::size_t back = 1; back < std::min(kReach + 1, num_refused()); ++back) {
    const Refused& old = refused(back);
    const std::int64_t accepted = num_accepted_ - old.num_accepted;
    // Two bad stamps that are far apart are no sequence.
    if (accepted < 1 || accepted > kForgetFactor * config_.agreeing_images) continue;
    if (old.image.session == newest.session && plausible(step_between(old.image, newest)))
      return true;
  }
  return false;
}

/// The longest chain up to `num_images` that ends at the newest refused image.
TimeBase::Chain TimeBase::find_chain(int num_images) const {
  Chain best;
  for (std::size_t back = 1; back <= kReach; ++back) {
    const Chain chain = grow_chain(back, num_images);
    if (chain.num_images > best.num_images) best = chain;
  }
  return best;
}

/// The chain whose last interval is that from the `back`th refused image to the newest one.
TimeBase::Chain TimeBase::grow_chain(std::size_t back, int num_images) const {
  Chain chain;
  chain.last = refused(0).image;
  TimeStampedImage oldest = chain.last;
  std::size_t skipped = 0;
  chain.num_images = 1;
  for (std::size_t i = back; i < num_refused() && chain.num_images < num_images; ++i) {
    const Refused& next = refused(i);
    if (has_base_ && next.num_accepted != num_accepted_) break;
    const Step step = step_between(next.image, oldest);
    const double per_image = step.us / static_cast<double>(step.num);
    const double tolerance =
        std::max(config_.jitter_s * kSecondsToUs, kChainShare * chain.interval_us);
    const bool agrees =
        next.image.session == oldest.session && plausible(step) && step.us <= kLongestLinkUs &&
        (chain.num_images == 1 || std::abs(per_image - chain.interval_us) <= tolerance);
    if (!agrees) {
      if (chain.num_images == 1 || ++skipped >= kReach) break;
      continue;
    }
    if (chain.num_images == 1) {
      chain.previous = next.image;
      chain.interval_us = per_image;
    }
    skipped = 0;
    oldest = next.image;
    ++chain.num_images;
  }
  chain.first = oldest;
  return chain;
}

/// The chain becomes the base.
TimeVerdict TimeBase::adopt(const Chain& chain) {
  if (has_base_ && !only_rate_changed(chain)) ++reset_count_;
  const Step all = step_between(chain.first, chain.last);
  TimeVerdict verdict;
  verdict.reason = TimeReason::kNone;
  verdict.is_new_base = true;
  const Step newest = step_between(chain.previous, chain.last);
  verdict.interval_s = newest.us / kSecondsToUs;
  verdict.reference_seq = chain.previous.seq;
  verdict.reset_count = reset_count_;
  interval_us_ = all.us / static_cast<double>(all.num);
  verdict.interval_std_s = jitter_us(newest) / kSecondsToUs;
  spread_us_ = 0.0;
  last_ = chain.last;
  has_base_ = true;
  num_unaccepted_ = 0;
  num_refused_ = 0;
  num_recent_ = 0;
  remember(chain.last);
  return verdict;
}

/// Whether the chain continues from the last accepted image, at a rate of its own.
bool TimeBase::only_rate_changed(const Chain& chain) const {
  if (chain.first.session != last_.session) return false;
  const Step step = step_between(last_, chain.first);
  if (!plausible(step)) return false;
  const double per_image = step.us / static_cast<double>(step.num);
  return std::abs(per_image - chain.interval_us) <= kChainShare * chain.interval_us;
}

void TimeBase::remember(const TimeStampedImage& image) {
  recent_[num_recent_ % kNumRecent] = image;
  ++num_recent_;
}

void TimeBase::learn(const Step& step, double rate) {
  if (step.num < 1) return;
  const double per_image = step.us / static_cast<double>(step.num);
  const double off = std::abs(per_image - interval_us_);
  spread_us_ += rate * (std::min(off, 0.5 * interval_us_) - spread_us_);
  if (rate == kIntervalLearningRate) interval_us_ += rate * (per_image - interval_us_);
}

}  // namespace plumb
