/// Judges each image before visual odometry uses it: time stamp, number and picture.
///
/// An image is refused when it is none of this source in its order: a repetition, a straggler, an
/// image of a second publisher or of a source that has begun anew and is not yet believed. Any
/// other image is handed on, with the interval that its stamps vouch for and with the reason why
/// its picture must not be used, if there is one (modules/integrity).
///
/// Units:
///   microseconds of the source's clock; `arrival_us` of CLOCK_MONOTONIC.
/// Memory:
///   That of PictureMemory, allocated at construction.
#pragma once

#include <cstdint>

#include "modules/camera/image_wire.hpp"
#include "modules/integrity/clock_offset.hpp"
#include "modules/integrity/integrity_config.hpp"
#include "modules/integrity/picture_memory.hpp"
#include "modules/integrity/steady_numbers.hpp"
#include "modules/integrity/time_base.hpp"
#include "modules/vo/vo.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {

class ImageJudge {
 public:
  /// @pre the image size satisfies PictureGrid's precondition
  ImageJudge(const IntegrityConfig& config, int width_px, int height_px);

  /// Judges time stamp and number. Returns null, or why the image is refused.
  [[nodiscard]] const char* judge_time(const ImageFrame& frame, std::int64_t arrival_us);
  /// Judges the picture of the image that judge_time() took last, and returns the input of visual
  /// odometry. Its numbers are steady ones.
  [[nodiscard]] VoInput judge_picture(const ImageView& image);

  /// Writes into the message what the judge knows of the image that it judged last: the source's
  /// numbers, times and reasons. Learns from it whether the picture was upright.
  void complete(vo_motion_t* motion);

  /// Number of images that never came, by the gaps in their numbers.
  [[nodiscard]] std::int64_t num_lost() const { return num_lost_; }

 private:
  [[nodiscard]] bool has_distant_number(const ImageFrame& frame, const TimeVerdict& verdict) const;
  [[nodiscard]] double guess_interval_s() const;

  TimeBase time_;
  PictureMemory pictures_;
  ClockOffset clock_;
  SteadyNumbers numbers_;
  TimeVerdict verdict_;
  struct Image {
    std::int64_t seq = -1;  ///< -1: there is none
    std::int64_t capture_us = 0;
  };
  Image image_;                    ///< the one that judge_time() took last
  Image previous_;                 ///< the one that was handed on before it, in the same time line
  Image handed_on_;                ///< the newest one that was handed on
  int num_refused_ = 0;            ///< since then
  bool is_discontinuous_ = false;  ///< nothing connects `image_` with `handed_on_`
  bool is_picture_used_ = false;   ///< nothing speaks against the newest picture
  bool is_orientation_doubted_ = false;  ///< the last usable picture was not known to be upright
  std::int64_t capture_mono_us_ = 0;
  double interval_s_ = kNan;       ///< from `previous_` to `image_`; NaN while in doubt
  double interval_std_s_ = kNan;   ///< of interval_s_, by the jitter of the stamps
  double guessed_interval_s_ = 0;  ///< the best guess of the same, always > 0
  std::int64_t num_lost_ = 0;
};

}  // namespace plumb
