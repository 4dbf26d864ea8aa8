/// Holds the heights of the other cues, and that of the filter, against the height that the road's
/// speed gives (MotionCue).
///
/// What is attached to the camera, and texture that compression has smeared, may align better with
/// another plane than with the road. One such height can be refused when it is far from that of
/// the road's speed. A cue whose heights scatter by far more than it states, image after image,
/// says what does not hold on this road, and is refused altogether. The road's speed is smooth, so
/// that the scatter about it is the cue's; its own error stays the same for some time and does not
/// count.
///
/// Units:
///   Natural logarithms of heights; seconds.
#pragma once

#include <array>

#include "modules/ground/cue_fuser.hpp"

namespace plumb {

class MotionJudge {
 public:
  /// Marks the heights that are refused as failed. `dt_s` is the interval since the last image.
  /// @return whether a cue that was used until now is refused from this image on
  [[nodiscard]] bool judge(double dt_s, Observations* observations);

  /// Follows how far the road's speed is from the filter's height. The other cues may agree among
  /// themselves on a plane that the road's speed contradicts.
  void follow_filter(const Observation& motion, double ln_height);
  /// How much farther the two are from each other than they usually are.
  [[nodiscard]] double excess() const;
  /// The filter starts anew.
  void forget_filter() { gap_ = 0.0; }

 private:
  struct JudgedCue {
    double judged_s = 0.0;  ///< for so long
    double mean = 0.0;      ///< ln height over that by the road's speed, running mean
    double scatter = 0.0;   ///< squared distance from it over the stated variance, running mean
    bool refused = false;
  };

  static void judge_cue(const CueReport& motion, double dt_s, JudgedCue* cue, CueReport* report);

  std::array<JudgedCue, kNumCues> cues_{};
  double gap_ = 0.0;  // ln height by the road's speed less the filter's, running mean
};

}  // namespace plumb
