#include "modules/integrity/picture_memory.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Blocks darker or brighter than this show no noise.
constexpr float kDarkestGrey = 5.0F;
constexpr float kBrightestGrey = 247.0F;
/// Least contrast over 2 px of a block that is judged at all, and of one judged by itself.
constexpr double kLeastContrastGrey = 1.0;
constexpr double kLeastRegionContrastGrey = 1.2;
/// Blocks with less than this share of the informative blocks' contrast are not judged by
/// themselves.
constexpr double kRegionContrastShare = 0.25;
/// Share of the unsaturated blocks that is less textured than the informative ones.
constexpr double kPlainShare = 0.6;
/// Blocks that hardly shift while the picture moves belong to the car or to an overlay.
constexpr float kFixedShiftPx = 0.3F;
constexpr float kMaxLearnedShiftPx = 4.0F;
constexpr float kLivelyRate = 0.1F;
constexpr float kLearningRate = 0.05F;
constexpr int kMinLearned = 10;
/// Quantile of the differences that stands for the calmest blocks, and the rise per image of their
/// smallest value: it forgets a dark stretch within some minutes.
constexpr double kCalmQuantile = 0.1;
constexpr double kFloorRise = 1.0005;

struct Values {
  std::array<float, kMaxBlocks> items{};
  std::size_t size = 0;

  void add(double value) { items[size++] = static_cast<float>(value); }
  /// 0 when empty. Reorders the items.
  [[nodiscard]] double quantile(double q) {
    if (size == 0) return 0.0;
    const auto rank = std::min(size - 1, static_cast<std::size_t>(q * static_cast<double>(size)));
    std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(rank),
                     items.begin() + static_cast<std::ptrdiff_t>(size));
    return static_cast<double>(items[rank]);
  }
};

}  // namespace

PictureMemory::PictureMemory(int width_px, int height_px, const PictureConfig& config)
    : grid_(width_px, height_px),
      config_(config),
      entries_(static_cast<std::size_t>(config.memory_images) + 1,
               Entry{PictureSample(grid_), {}, false}),
      differences_(static_cast<std::size_t>(config.memory_images)) {}

PictureVerdict PictureMemory::update(const ImageView& image, const PictureStep& step) {
  newest_ = (newest_ + 1) % static_cast<int>(entries_.size());
  num_images_ = std::min(num_images_ + 1, static_cast<int>(entries_.size()));
  entry(0).sample.take(image);
  choose_blocks();
  compare_all();
  previous_ = num_images_ > 1 ? likeness(1) : Likeness{};
  motion_ = measure_motion();
  mark_moved();

  PictureVerdict verdict;
  if (num_images_ > 1) judge(step, &verdict);
  finish(&verdict, step);
  return verdict;
}

void PictureMemory::reset() {
  num_images_ = 0;
  past_motion_ = {};
  usual_shift_px_ = {};
  equal_rate_ = {};
  num_learned_ = 0;
  noise_floor_grey_ = 0.0;
  num_noise_images_ = 0;
  num_equal_ = 0;
  has_seen_stop_ = false;
  flip_ = Flip::kNone;
  last_ = {};
  num_repeats_ = 0;
}

PictureMemory::Entry& PictureMemory::entry(int back) {
  const int size = static_cast<int>(entries_.size());
  return entries_[static_cast<std::size_t>((newest_ - back + size) % size)];
}

const PictureMemory::Entry& PictureMemory::entry(int back) const {
  const int size = static_cast<int>(entries_.size());
  return entries_[static_cast<std::size_t>((newest_ - back + size) % size)];
}

double PictureMemory::contrast(int block) const {
  return static_cast<double>(entry(0).sample.structure(1)[static_cast<std::size_t>(block)]);
}

void PictureMemory::choose_blocks() {
  const PictureSample& sample = entry(0).sample;
  unsaturated_.reset();
  informative_.reset();
  textured_.reset();
  lively_.reset();
  Values contrasts;
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const float mean = sample.mean()[i];
    if (mean < kDarkestGrey || mean > kBrightestGrey || sample.structure(0)[i] <= 0.0F) continue;
    unsaturated_.set(i);
    contrasts.add(contrast(b));
  }
  const double least = std::max(kLeastContrastGrey, contrasts.quantile(kPlainShare));
  const double least_alone = std::max(kLeastRegionContrastGrey, kRegionContrastShare * least);
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const bool is_fixed = num_learned_ >= kMinLearned && usual_shift_px_[i] < kFixedShiftPx;
    if (!unsaturated_[i] || is_fixed) continue;
    if (contrast(b) >= least) informative_.set(i);
    if (contrast(b) >= least_alone) textured_.set(i);
    if (num_learned_ >= kMinLearned && equal_rate_[i] <= kLivelyRate) lively_.set(i);
  }
}

void PictureMemory::compare_all() {
  for (int back = 1; back < num_images_; ++back) {
    compare_blocks(grid_, entry(0).sample, entry(back).sample,
                   &differences_[static_cast<std::size_t>(back - 1)]);
  }
}

PictureMemory::Likeness PictureMemory::likeness(int back) const {
  const BlockValues& difference = differences_[static_cast<std::size_t>(back - 1)];
  Values ratios;
  int num_equal = 0;
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (unsaturated_[i] && difference[i] == 0.0F) ++num_equal;
    if (informative_[i]) ratios.add(static_cast<double>(difference[i]) / contrast(b));
  }
  Likeness result;
  const auto count = static_cast<double>(unsaturated_.count());
  if (count > 0.0) result.equal_share = num_equal / count;
  result.median_ratio = ratios.size > 0 ? ratios.quantile(0.5) : 1.0;
  result.high_ratio = ratios.size > 0 ? ratios.quantile(0.9) : 1.0;
  return result;
}

PictureMemory::Motion PictureMemory::measure_motion() const {
  Motion motion;
  if (num_images_ < 2) return motion;
  Values shifts;
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (!textured_[i]) continue;
    const double shift =
        apparent_shift_px(entry(0).sample, b, static_cast<double>(differences_[0][i]));
    motion.shift_px[i] = static_cast<float>(shift);
    if (informative_[i]) shifts.add(shift);
  }
  motion.is_known = true;
  motion.is_still = alike(previous_);
  motion.median_px = shifts.quantile(0.5);
  return motion;
}

/// A block has moved when its difference exceeds its own contrast over 2 px by and large.
void PictureMemory::mark_moved() {
  Entry& newest = entry(0);
  newest.moved.reset();
  newest.has_predecessor = num_images_ > 1;
  if (!newest.has_predecessor) return;
  for (int b = 0; b < grid_.num_blocks(); ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (!textured_[i]) continue;
    // A change of brightness is no movement.
    const float brighter = std::abs(newest.sample.mean()[i] - entry(1).sample.mean()[i]);
    const double moved = static_cast<double>(differences_[0][i] - brighter);
    if (moved >= config_.still_ratio * contrast(b) + kLeastContrastGrey) newest.moved.set(i);
  }
}

/// Learns the camera's noise, and from images that moved which blocks do not.
void PictureMemory::learn() {
  if (!motion_.is_known || num_equal_ > 0) return;
  Values calm;
  for (std::size_t i = 0; i < static_cast<std::size_t>(grid_.num_blocks()); ++i) {
    if (!unsaturated_[i]) continue;
    // Noise alone does not grow with the shift, texture does: extrapolates to a shift of 0.
    const PictureSample& sample = entry(0).sample;
    const float nugget = 2.0F * sample.structure(0)[i] - sample.structure(1)[i];
    calm.add(static_cast<double>(std::max(0.0F, std::min(nugget, differences_[0][i]))));
  }
  const double calm_grey = calm.quantile(kCalmQuantile);
  noise_floor_grey_ =
      num_noise_images_ == 0 ? calm_grey : std::min(calm_grey, noise_floor_grey_ * kFloorRise);
  ++num_noise_images_;
  if (!motion_.is_still && motion_.median_px >= 1.0) learn_blocks();
}

void PictureMemory::learn_blocks() {
  const float rate = std::max(kLearningRate, 1.0F / static_cast<float>(num_learned_ + 1));
  for (std::size_t i = 0; i < static_cast<std::size_t>(grid_.num_blocks()); ++i) {
    if (!unsaturated_[i]) continue;
    const double shift = apparent_shift_px(entry(0).sample, static_cast<int>(i),
                                           static_cast<double>(differences_[0][i]));
    const float bounded = std::min(kMaxLearnedShiftPx, static_cast<float>(shift));
    usual_shift_px_[i] += rate * (bounded - usual_shift_px_[i]);
    equal_rate_[i] += rate * ((differences_[0][i] == 0.0F ? 1.0F : 0.0F) - equal_rate_[i]);
  }
  ++num_learned_;
}

}  // namespace plumb
