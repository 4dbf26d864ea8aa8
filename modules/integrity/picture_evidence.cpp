/// The rules of PictureMemory: from block differences to a verdict.
#include <algorithm>
#include <cmath>

#include "modules/integrity/picture_memory.hpp"

namespace plumb {
namespace {

/// "Alike" also needs nine tenths of the blocks below this.
constexpr double kHighRatio = 0.85;
/// A car that brakes evenly to a stop moves in its last step at most half as far as in the one
/// before; a picture that moved at least this share was not about to stop.
constexpr float kSteadyShare = 0.6F;
constexpr float kSteadyLimitPx = 16.0F;
constexpr double kNominalIntervalS = 0.1;
constexpr int kFrozenAfter = 3;
/// Share of the textured blocks that moved when the picture did.
constexpr double kMovedShare = 0.5;
constexpr double kMovedShareWhenEqual = 0.25;
/// Images that show the camera's noise before its absence means something.
constexpr int kMinNoiseImages = 5;
/// Rows of blocks belong to a repeated band when this share of their textured blocks does.
constexpr double kBandRowShare = 0.75;
constexpr int kMinRowBlocks = 3;
constexpr int kMinBandRows = 2;
constexpr int kMinRegionBlocks = 8;
/// A region that is not a band needs more blocks to be told from cars and houses.
constexpr double kPatchFactor = 3.0;
/// A flip explains the new image: its correlation is high, and the plain one far from it.
constexpr double kFlipCorrelation = 0.85;
constexpr double kFlipShare = 0.4;

struct Sums {
  double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;

  void add(double x, double y) {
    n += 1.0;
    a += x;
    b += y;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  [[nodiscard]] double correlation() const {
    const double variance = (aa - a * a / n) * (bb - b * b / n);
    return variance > 0.0 ? (ab - a * b / n) / std::sqrt(variance) : 0.0;
  }
};

}  // namespace

const char* describe(PictureReason reason) {
  switch (reason) {
    case PictureReason::kNone:
      return "";
    case PictureReason::kRepeated:
      return "the camera sent the previous picture again";
    case PictureReason::kFrozen:
      return "the picture is frozen";
    case PictureReason::kStale:
      return "the camera sent an older picture again";
    case PictureReason::kTorn:
      return "part of the picture is an older one";
    case PictureReason::kPartlyFrozen:
      return "part of the picture is frozen";
    case PictureReason::kMirrored:
      return "the picture is mirrored";
    case PictureReason::kUpsideDown:
      return "the picture is upside down";
    case PictureReason::kUnproven:
      return "the picture shows no sign of life";
  }
  return "";
}

bool PictureMemory::alike(const Likeness& likeness) const {
  return informative_.any() && likeness.median_ratio <= config_.still_ratio &&
         likeness.high_ratio <= kHighRatio;
}

/// Deceleration changes the shift per image with the square of the interval.
double PictureMemory::required_shift_px(const PictureStep& step) const {
  const double slower = std::max(1.0, step.interval_s / kNominalIntervalS);
  return config_.moving_px * slower * slower;
}

void PictureMemory::judge(const PictureStep& step, PictureVerdict* verdict) {
  verdict->is_still = motion_.is_still;
  verdict->median_shift_px = motion_.median_px;
  num_equal_ = previous_.equal_share >= config_.equal_share ? num_equal_ + 1 : 0;
  if (motion_.is_still || num_equal_ > 0) {
    if (judge_still(step, verdict)) return;
  } else if (judge_return(verdict)) {
    return;
  } else {
    apply_flip(verdict);
    if (!verdict->is_fresh()) return;
  }
  if (judge_regions(step, verdict)) return;
  // A picture that stays as it is stays flipped.
  if (flip_ != Flip::kNone) apply_flip(verdict);
}

bool PictureMemory::judge_still(const PictureStep& step, PictureVerdict* verdict) const {
  const bool was_repeated =
      last_.reason == PictureReason::kRepeated || last_.reason == PictureReason::kFrozen;
  const bool repeated = was_repeated || stopped_abruptly(step) || noise_vanished();
  if (!repeated && !life_unproven()) return false;
  verdict->images_back = 1;
  verdict->region = textured_ | unsaturated_;
  const double unlike = std::min(1.0, previous_.median_ratio / config_.still_ratio);
  verdict->confidence = repeated ? 1.0 - 0.5 * unlike : 0.5;
  verdict->reason = !repeated                          ? PictureReason::kUnproven
                    : num_repeats_ + 1 >= kFrozenAfter ? PictureReason::kFrozen
                                                       : PictureReason::kRepeated;
  return true;
}

bool PictureMemory::stopped_abruptly(const PictureStep& step) const {
  const auto& [last, before] = past_motion_;
  if (!step.is_contiguous || !last.is_known || last.is_still) return false;
  if (last.median_px < required_shift_px(step)) return false;
  const double bounded = std::min(before.median_px, static_cast<double>(kSteadyLimitPx));
  return !before.is_known || before.is_still ||
         last.median_px >= static_cast<double>(kSteadyShare) * bounded;
}

bool PictureMemory::noise_vanished() const {
  return num_equal_ > 0 && num_noise_images_ >= kMinNoiseImages &&
         noise_floor_grey_ >= config_.noise_floor_grey;
}

bool PictureMemory::life_unproven() const {
  return num_equal_ > 0 && (!has_seen_stop_ || num_equal_ > config_.rest_images);
}

bool PictureMemory::judge_return(PictureVerdict* verdict) const {
  for (int back = 2; back < num_images_; ++back) {
    const Likeness found = likeness(back);
    if (!alike(found)) continue;
    const bool is_equal = found.equal_share >= config_.equal_share;
    const double required = is_equal ? 1.0 : config_.stale_moving_px;
    if (motion_.median_px < required) continue;
    // At a standstill a single bad image comes and goes: the image that returns must itself have
    // been part of a moving picture.
    const Entry& old = entry(back);
    const double moved = static_cast<double>((old.moved & textured_).count()) /
                         std::max(1.0, static_cast<double>(textured_.count()));
    const double moved_share = is_equal ? kMovedShareWhenEqual : kMovedShare;
    const bool was_moving = old.has_predecessor ? moved >= moved_share : is_equal;
    if (!was_moving) continue;
    verdict->reason = PictureReason::kStale;
    verdict->images_back = back;
    verdict->region = textured_ | unsaturated_;
    verdict->confidence = 1.0 - 0.5 * found.median_ratio / config_.still_ratio;
    return true;
  }
  return false;
}

bool PictureMemory::judge_regions(const PictureStep& step, PictureVerdict* verdict) const {
  for (int back = 1; back < num_images_; ++back) {
    BlockMask mask = back == 1 ? stopped_blocks(step) : returned_blocks(back);
    bool found = is_region(mask, textured_);
    if (!found && back == 1) {
      mask = mute_blocks(step);
      found = is_region(mask, lively_);
    }
    if (!found) continue;
    const bool goes_on = back == 1 && region_goes_on(mask);
    verdict->reason = goes_on ? PictureReason::kPartlyFrozen : PictureReason::kTorn;
    verdict->images_back = back;
    verdict->region = mask;
    verdict->confidence = goes_on ? 0.9 : 0.7;
    return true;
  }
  return false;
}

/// Whether most of the blocks repeated the previous image in the previous image, too.
bool PictureMemory::region_goes_on(const BlockMask& mask) const {
  const bool was_partial = last_.reason == PictureReason::kPartlyFrozen ||
                           last_.reason == PictureReason::kRepeated ||
                           (last_.reason == PictureReason::kTorn && last_.images_back == 1);
  return was_partial && (mask & last_.region).count() * 2 > mask.count();
}

/// Blocks that moved and do not move any more.
BlockMask PictureMemory::stopped_blocks(const PictureStep& step) const {
  const auto& [last, before] = past_motion_;
  const bool may_stop = step.is_contiguous && last.is_known;
  const auto required = static_cast<float>(required_shift_px(step));
  const bool goes_on = region_goes_on(last_.region);
  BlockMask mask;
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const auto difference = static_cast<double>(differences_[0][i]);
    if (!textured_[i] || difference > config_.still_ratio * contrast(b)) continue;
    const float steady = kSteadyShare * std::min(before.shift_px[i], kSteadyLimitPx);
    const bool stopped = may_stop && last.shift_px[i] >= required && last.shift_px[i] >= steady;
    if (stopped || (goes_on && last_.region[i])) mask.set(i);
  }
  return mask;
}

/// Bit-equal blocks that are hardly ever bit-equal, while the rest of the picture moves. A camera
/// whose noise shows needs no movement.
BlockMask PictureMemory::mute_blocks(const PictureStep& step) const {
  const Motion& last = past_motion_[0];
  const bool was_fast = step.is_contiguous && last.is_known && !last.is_still &&
                        last.median_px >= required_shift_px(step);
  const bool has_noise =
      num_noise_images_ >= kMinNoiseImages && noise_floor_grey_ >= config_.noise_floor_grey;
  BlockMask mask;
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (lively_[i] && differences_[0][i] == 0.0F) mask.set(i);
  }
  if (has_noise || region_goes_on(mask)) return mask;
  const BlockMask rest = textured_ & ~mask;
  const bool rest_moves = (rest & entry(0).moved).count() * 2 >= rest.count();
  return was_fast && rest_moves ? mask : BlockMask{};
}

/// Blocks that moved against the previous image and equal an older one, which had moved, too.
BlockMask PictureMemory::returned_blocks(int back) const {
  BlockMask mask;
  const Entry& old = entry(back);
  if (!old.has_predecessor) return mask;
  const BlockValues& difference = differences_[static_cast<std::size_t>(back - 1)];
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (!textured_[i] || !entry(0).moved[i] || !old.moved[i]) continue;
    if (static_cast<double>(motion_.shift_px[i]) < config_.stale_moving_px) continue;
    if (static_cast<double>(difference[i]) <= config_.still_ratio * contrast(b)) mask.set(i);
  }
  return mask;
}

/// Whether the blocks are a band of full rows, or many, while other parts of the picture move.
bool PictureMemory::is_region(const BlockMask& mask, const BlockMask& judged) const {
  const auto least = std::max<double>(kMinRegionBlocks,
                                      config_.region_share * static_cast<double>(judged.count()));
  const auto count = static_cast<double>(mask.count());
  if (count < least) return false;
  if (count >= kPatchFactor * least) return true;
  int num_rows = 0;
  double in_band = 0.0;
  for (int row = 0; row <= kGridRows; ++row) {
    int num_judged = 0;
    int num_masked = 0;
    for (int c = 0; row < kGridRows && c < grid_.num_columns; ++c) {
      const auto i = static_cast<std::size_t>(row * grid_.num_columns + c);
      num_judged += judged[i] ? 1 : 0;
      num_masked += mask[i] ? 1 : 0;
    }
    const bool belongs = num_judged >= kMinRowBlocks && num_masked >= kBandRowShare * num_judged;
    if (belongs) {
      ++num_rows;
      in_band += num_masked;
    }
    if ((!belongs || row == kGridRows) && num_judged >= kMinRowBlocks) {
      if (num_rows >= kMinBandRows && in_band >= least) return true;
      num_rows = 0;
      in_band = 0.0;
    }
  }
  return num_rows >= kMinBandRows && in_band >= least;
}

/// Correlation of the block means of the flipped new image with those of the previous one.
double PictureMemory::flipped_correlation(Flip flip) const {
  const bool columns = flip == Flip::kColumns || flip == Flip::kBoth;
  const bool rows = flip == Flip::kRows || flip == Flip::kBoth;
  Sums sums;
  for (int row = 0; row < kGridRows; ++row) {
    for (int c = 0; c < grid_.num_columns; ++c) {
      const int from_row = rows ? kGridRows - 1 - row : row;
      const int from_column = columns ? grid_.num_columns - 1 - c : c;
      const auto here = static_cast<std::size_t>(row * grid_.num_columns + c);
      const auto there = static_cast<std::size_t>(from_row * grid_.num_columns + from_column);
      sums.add(static_cast<double>(entry(0).sample.mean()[there]),
               static_cast<double>(entry(1).sample.mean()[here]));
    }
  }
  return sums.correlation();
}

PictureMemory::Flip PictureMemory::find_flip() const {
  const double plain = flipped_correlation(Flip::kNone);
  Flip best = Flip::kNone;
  double correlation = kFlipCorrelation;
  for (const Flip flip : {Flip::kColumns, Flip::kRows, Flip::kBoth}) {
    const double found = flipped_correlation(flip);
    if (found < correlation || 1.0 - found > kFlipShare * (1.0 - plain)) continue;
    best = flip;
    correlation = found;
  }
  return best;
}

void PictureMemory::apply_flip(PictureVerdict* verdict) {
  const Flip change = motion_.is_still ? Flip::kNone : find_flip();
  flip_ = static_cast<Flip>(static_cast<int>(flip_) ^ static_cast<int>(change));
  if (flip_ == Flip::kNone) return;
  verdict->reason = flip_ == Flip::kColumns ? PictureReason::kMirrored : PictureReason::kUpsideDown;
  verdict->confidence = 0.8;
}

/// Counts, remembers and learns.
void PictureMemory::finish(PictureVerdict* verdict, const PictureStep& step) {
  verdict->steps_since_fresh = last_.is_fresh() ? 1 : last_.steps_since_fresh + 1;
  const bool is_repeat = verdict->images_back == 1 && verdict->reason != PictureReason::kUnproven;
  num_repeats_ = is_repeat ? num_repeats_ + 1 : 0;
  if (!motion_.is_still && num_equal_ == 0) {
    has_seen_stop_ = false;
  } else if (verdict->is_fresh() && past_motion_[0].is_known && !past_motion_[0].is_still) {
    has_seen_stop_ = step.is_contiguous;
  }
  if (verdict->is_fresh()) learn();
  past_motion_[1] = past_motion_[0];
  past_motion_[0] = motion_;
  if (!step.is_contiguous) past_motion_[0].is_known = false;
  last_ = *verdict;
}

}  // namespace plumb
