/// Recognises images that were not taken just now: repeated, frozen, stale, torn, mirrored.
///
/// Each image is compared, block by block, with the last `memory_images` images. Two figures
/// decide per block: the mean absolute difference, relative to the block's own contrast (alike or
/// not), and the shift that would explain the difference (how fast the picture moved). The
/// evidence is:
///   abrupt stop    the picture moved fast and steadily, and from one image to the next not at all;
///                  a braking car slows down over several images first
///   return         the picture equals one of k >= 2 images ago, and not the previous one
///   vanished noise nearly all blocks are bit-equal although the camera has always shown noise
///   region         one of these for a band of rows or a large part of the picture only
///   flip           the mirrored or turned image continues the previous one, the image as it is
///                  does not
///
/// What it cannot tell:
///   - A picture that is frozen from the first image on, or froze at rest, and carries fresh noise:
///     it looks like a standing car. Without noise it is kUnproven until the picture moves.
///   - A single repetition with fresh noise below about 2 m/s: it looks like a stop.
///   - A picture that was mirrored or upside down from the first image on; only the change is seen.
///     Mirrored left to right, the world itself is plausible. Upside down is seen by
///     vo::OrientationCheck.
///   - A repetition from the rebound of the body after a hard stop, for single images.
///   - A single torn band in the middle of the picture that is three or more images old, where the
///     scene has little texture.
///   - Repetitions with noise when the picture's contrast is not well above that noise.
/// After a flip, all images are reported as flipped until the picture flips back or reset() is
/// called.
///
/// How to use:
///   Only images whose verdict is_fresh() may be used for motion, for standstill or as reference of
///   the next motion. Their own stamps are right; see `steps_since_fresh`.
/// Units:
///   Grey levels, pixels, seconds.
/// Memory:
///   Sampled rows of memory_images + 1 images, allocated at construction: 1.0 MB at 1242x375 with 8
///   images.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image_view.hpp"
#include "modules/integrity/picture_config.hpp"
#include "modules/integrity/picture_grid.hpp"

namespace plumb {

enum class PictureReason : std::int8_t {
  kNone = 0,          ///< fresh
  kRepeated = 1,      ///< shows the previous image again
  kFrozen = 2,        ///< has shown the same image for three images or longer
  kStale = 3,         ///< shows an image from before the previous one
  kTorn = 4,          ///< a region shows an earlier image; `images_back` says which
  kPartlyFrozen = 5,  ///< the same region has not changed for two images or longer
  kMirrored = 6,      ///< left and right have changed places
  kUpsideDown = 7,    ///< top and bottom have changed places, mirrored or not
  kUnproven = 8,      ///< bit-equal to the previous one: standing or frozen, nothing tells which
};

/// One short clause for logs and health; "" for kNone.
[[nodiscard]] const char* describe(PictureReason reason);

struct PictureVerdict {
  PictureReason reason = PictureReason::kNone;
  double confidence = 0.0;  ///< of `reason`, 0 to 1; 0 for kNone
  int images_back = 0;      ///< image that is repeated; 1 is the previous one, 0 none
  BlockMask region;         ///< repeated blocks; all of them when the whole picture is repeated
  /// Images since the last fresh one, this one included. 1 in an undisturbed stream. A fresh image
  /// with n > 1 continues the motion of the last fresh image over n image intervals.
  int steps_since_fresh = 1;
  bool is_still = false;         ///< the picture does not move against the previous image
  double median_shift_px = 0.0;  ///< apparent shift against the previous image

  [[nodiscard]] bool is_fresh() const { return reason == PictureReason::kNone; }
};

/// What the caller knows about the step from the previous image to this one.
struct PictureStep {
  /// False when images are missing in between: then the picture may start or stop abruptly.
  bool is_contiguous = true;
  double interval_s = 0.1;  ///< > 0
};

class PictureMemory {
 public:
  /// @pre the image size satisfies PictureGrid's precondition
  PictureMemory(int width_px, int height_px, const PictureConfig& config);

  /// Judges the next image. @pre `image` has the constructed size
  PictureVerdict update(const ImageView& image, const PictureStep& step);

  /// Begins anew, e.g. after the camera was restarted: nothing is remembered but the settings.
  void reset();

  [[nodiscard]] const PictureGrid& grid() const { return grid_; }

 private:
  struct Entry {
    PictureSample sample;
    BlockMask moved;               ///< blocks that moved against the previous image
    bool has_predecessor = false;  ///< `moved` is known
  };
  /// Result of comparing the new image with one earlier image.
  struct Likeness {
    double median_ratio = 0.0;  ///< difference over own contrast, informative blocks
    double high_ratio = 0.0;    ///< 90 % quantile of it
    double equal_share = 0.0;   ///< bit-equal blocks among those with structure
  };
  /// How the picture moved from one image to the next.
  struct Motion {
    bool is_known = false;
    bool is_still = false;
    double median_px = 0.0;
    BlockValues shift_px{};
  };
  enum class Flip : std::int8_t { kNone = 0, kColumns = 1, kRows = 2, kBoth = 3 };

  [[nodiscard]] Entry& entry(int back);  ///< 0: the new image
  [[nodiscard]] const Entry& entry(int back) const;
  [[nodiscard]] double contrast(int block) const;
  void choose_blocks();
  void compare_all();
  [[nodiscard]] Likeness likeness(int back) const;
  [[nodiscard]] bool alike(const Likeness& likeness) const;
  [[nodiscard]] Motion measure_motion() const;
  void mark_moved();
  void learn();
  void learn_blocks();

  void judge(const PictureStep& step, PictureVerdict* verdict);
  [[nodiscard]] bool judge_still(const PictureStep& step, PictureVerdict* verdict) const;
  [[nodiscard]] bool stopped_abruptly(const PictureStep& step) const;
  [[nodiscard]] bool noise_vanished() const;
  [[nodiscard]] bool life_unproven() const;
  [[nodiscard]] bool judge_return(PictureVerdict* verdict) const;
  [[nodiscard]] bool judge_regions(const PictureStep& step, PictureVerdict* verdict) const;
  [[nodiscard]] BlockMask stopped_blocks(const PictureStep& step) const;
  [[nodiscard]] BlockMask mute_blocks(const PictureStep& step) const;
  [[nodiscard]] BlockMask returned_blocks(int back) const;
  [[nodiscard]] bool is_region(const BlockMask& mask, const BlockMask& judged) const;
  [[nodiscard]] bool region_goes_on(const BlockMask& mask) const;
  [[nodiscard]] Flip find_flip() const;
  [[nodiscard]] double flipped_correlation(Flip flip) const;
  void apply_flip(PictureVerdict* verdict);
  void finish(PictureVerdict* verdict, const PictureStep& step);
  [[nodiscard]] double required_shift_px(const PictureStep& step) const;

  PictureGrid grid_;
  PictureConfig config_;
  std::vector<Entry> entries_;
  int newest_ = 0;
  int num_images_ = 0;

  std::vector<BlockValues> differences_;  ///< [back - 1]: of the new image to an earlier one
  BlockMask unsaturated_;
  BlockMask informative_;  ///< the better textured blocks, on which whole pictures are judged
  BlockMask textured_;     ///< blocks with enough texture to judge them one by one
  BlockMask lively_;       ///< blocks that are hardly ever bit-equal while the picture moves
  Likeness previous_;      ///< of the new image to the previous one
  Motion motion_;          ///< to the new image
  std::array<Motion, 2> past_motion_;  ///< to the previous image, and to the one before

  BlockValues usual_shift_px_{};  ///< running mean of the blocks' shifts while the picture moves
  BlockValues equal_rate_{};      ///< how often a block is bit-equal while the picture moves
  int num_learned_ = 0;
  double noise_floor_grey_ = 0.0;
  int num_noise_images_ = 0;
  int num_equal_ = 0;           ///< bit-equal images in a row
  bool has_seen_stop_ = false;  ///< the present rest began with a gradual stop
  Flip flip_ = Flip::kNone;
  PictureVerdict last_;
  int num_repeats_ = 0;
};

}  // namespace plumb
