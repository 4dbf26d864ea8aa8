#include "modules/vo/image_judge_wire.hpp"

#include <algorithm>

namespace plumb {
namespace {

/// Interval of images before any is known.
constexpr double kUsualIntervalS = 0.1;
constexpr double kLongestIntervalS = 1.0;
/// A longer gap in the numbers tells nothing of the motion.
constexpr std::int64_t kMaxSteps = 100;

VoReason reason_of(PictureReason reason) {
  switch (reason) {
    case PictureReason::kNone:
      return VoReason::kNone;
    case PictureReason::kRepeated:
      return VoReason::kImageRepeated;
    case PictureReason::kFrozen:
      return VoReason::kImageFrozen;
    case PictureReason::kStale:
      return VoReason::kImageStale;
    case PictureReason::kTorn:
      return VoReason::kImageTorn;
    case PictureReason::kPartlyFrozen:
      return VoReason::kImagePartlyFrozen;
    case PictureReason::kMirrored:
      return VoReason::kImageMirrored;
    case PictureReason::kUpsideDown:
      return VoReason::kImageUpsideDown;
    case PictureReason::kUnproven:
      return VoReason::kImageUnproven;
  }
  return VoReason::kNone;
}

/// Why the time since the previous image is in doubt.
VoReason reason_of(TimeReason reason) {
  switch (reason) {
    case TimeReason::kStampStalled:
      return VoReason::kTimeStalled;
    case TimeReason::kJumpForward:
      return VoReason::kTimeForward;
    case TimeReason::kJumpBack:
      return VoReason::kTimeBackwards;
    case TimeReason::kWrongUnit:
    case TimeReason::kImplausibleRate:
      return VoReason::kTimeUnit;
    case TimeReason::kStarting:
      return VoReason::kTimeStarting;
    default:
      return VoReason::kTimeDoubted;
  }
}

}  // namespace

ImageJudge::ImageJudge(const IntegrityConfig& config, int width_px, int height_px)
    : time_(config.time), pictures_(width_px, height_px, config.picture), clock_(config.clock) {}

const char* ImageJudge::judge_time(const ImageFrame& frame, std::int64_t arrival_us) {
  const std::int32_t base = verdict_.reset_count;
  const TimeVerdict verdict = time_.update({frame.capture_us, frame.seq, frame.session});
  if (!verdict.is_next_picture() || has_distant_number(frame, verdict)) {
    ++num_refused_;
    return describe(verdict.reason);
  }
  verdict_ = verdict;
  num_lost_ += verdict.num_lost;
  image_ = {frame.seq, frame.capture_us};
  previous_ = handed_on_;
  // Whoever was refused on the way to another time line came from another camera position.
  is_discontinuous_ =
      image_.seq <= previous_.seq || (verdict.reset_count != base && num_refused_ > 0);
  num_refused_ = 0;
  if (is_discontinuous_) {
    numbers_.begin_anew(image_.seq);
    previous_ = Image{};
  }
  const bool vouched = previous_.seq >= 0 && verdict.reference_seq == previous_.seq;
  interval_s_ = vouched ? verdict.interval_s : kNan;
  interval_std_s_ = vouched ? verdict.interval_std_s : kNan;
  guessed_interval_s_ = guess_interval_s();
  capture_mono_us_ = 0;
  if (verdict.is_valid()) {
    clock_.update(frame.capture_us, arrival_us, {frame.session, verdict.reset_count});
    capture_mono_us_ = clock_.capture_us(frame.capture_us).value_or(0);
  }
  return nullptr;
}

/// Whether the number alone says that the image belongs to somebody else. An image of doubtful time
/// may be one of ours only if its number is near.
bool ImageJudge::has_distant_number(const ImageFrame& frame, const TimeVerdict& verdict) const {
  constexpr std::int64_t kNear = 16;
  return !verdict.is_valid() && handed_on_.seq >= 0 &&
         (frame.seq > handed_on_.seq + kNear || frame.seq <= handed_on_.seq);
}

/// The time since the previous image that its number suggests, when its stamp does not tell it.
double ImageJudge::guess_interval_s() const {
  if (interval_s_ > 0.0) return interval_s_;
  const bool has_previous = previous_.seq >= 0;
  const auto steps = static_cast<double>(
      has_previous ? std::clamp<std::int64_t>(image_.seq - previous_.seq, 1, kMaxSteps) : 1);
  const double nominal_s = time_.nominal_interval_s();
  if (nominal_s > 0.0) return steps * nominal_s;
  const double stamped_s =
      1e-6 * (static_cast<double>(image_.capture_us) - static_cast<double>(previous_.capture_us));
  const bool is_usable = has_previous && stamped_s > 0.0 && stamped_s < kLongestIntervalS;
  return is_usable ? stamped_s : steps * kUsualIntervalS;
}

VoInput ImageJudge::judge_picture(const ImageView& image) {
  const bool is_contiguous =
      verdict_.reason == TimeReason::kNone || verdict_.reason == TimeReason::kStarting;
  if (is_discontinuous_) pictures_.reset();
  PictureVerdict verdict = pictures_.update(image, {is_contiguous, guessed_interval_s_});
  // The pictures before were not upright, so this one may be.
  const bool is_turned = verdict.reason == PictureReason::kUpsideDown && is_orientation_doubted_;
  if (is_turned) {
    pictures_.reset();
    verdict = {};
  }
  is_picture_used_ = verdict.is_fresh();
  handed_on_ = image_;
  return {.capture_us = image_.capture_us,
          .seq = numbers_.take(image_.seq),
          .image = image,
          .interval_s = guessed_interval_s_,
          .is_discontinuous = is_discontinuous_ || is_turned,
          .unusable = reason_of(verdict.reason)};
}

void ImageJudge::complete(vo_motion_t* motion) {
  if (is_picture_used_) {
    is_orientation_doubted_ = motion->reason == vo_motion_t::REASON_IMAGE_UPSIDE_DOWN ||
                              motion->reason == vo_motion_t::REASON_ORIENTATION_UNPROVEN;
  }
  motion->seq = image_.seq;
  motion->capture_mono_us = capture_mono_us_;
  motion->prev_seq = previous_.seq;
  motion->interval_s = interval_s_;
  motion->interval_std_s = interval_std_s_;
  const bool is_doubted = previous_.seq >= 0 && !(interval_s_ > 0.0);
  if (is_doubted && motion->reason == vo_motion_t::REASON_NONE) {
    motion->reason = static_cast<std::int8_t>(reason_of(verdict_.reason));
  }
  // The carry of the scale comes from the speed, and so from the interval.
  if (is_doubted && motion->scale_carry_std > 0.0) motion->scale_carry_std = kNan;
  // Images of an earlier time line have no number that a reader could know.
  for (std::int8_t i = 0; i < motion->num_window; ++i) {
    if (!numbers_.is_present(motion->window_seq[i])) {
      motion->num_window = i;
      break;
    }
    motion->window_seq[i] = numbers_.source(motion->window_seq[i]);
  }
}

}  // namespace plumb
