#include "modules/ground/motion_judge.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

// Standard deviations of the road's speed by which a single height may differ from it. A speed that
// is known less well than that is no judge of them.
constexpr double kMostStds = 2.0;
constexpr double kLargestJudgeStd = 0.08;

// A cue is refused from the first of these misfits on, and until it is below the second one.
// Without the road's speed, it is forgotten.
constexpr double kMostMisfit = 1.2;
constexpr double kGoodMisfit = 0.8;
constexpr double kMisfitTime_s = 1.5;
constexpr double kFirstMisfitTime_s = 0.4;
constexpr double kForgetTime_s = 5.0;
// What a single height can add, so that one wild height is soon forgotten.
constexpr double kMostOfOne = 6.0;

// Weight of a new image in the running mean of the gap between the road's speed and the filter, and
// how many standard deviations of the speed it may have.
constexpr double kGapShare = 0.5;
constexpr double kMostGapStds = 0.5;

}  // namespace

bool MotionJudge::judge(double dt_s, Observations* observations) {
  const CueReport& motion = (*observations)[kCueMotion].report;
  const double std = std::sqrt(motion.height_var) / motion.height;
  const bool judges = motion.status == CueStatus::kUsed && std <= kLargestJudgeStd;
  bool any_new = false;
  for (std::size_t i = 0; i < kNumCues; ++i) {
    if (!kCueTable[i].measures_height || i == kCueMotion) continue;
    const bool was_refused = refused_[i];
    if (judges) {
      judge_cue(i, dt_s, observations);
    } else {
      misfit_[i] *= std::max(0.0, 1.0 - dt_s / kForgetTime_s);
    }
    refused_[i] = misfit_[i] > (was_refused ? kGoodMisfit : kMostMisfit);
    CueReport& report = (*observations)[i].report;
    if (judges && refused_[i] && report.status == CueStatus::kUsed)
      report.status = CueStatus::kFailed;
    any_new |= judges && refused_[i] && !was_refused;
  }
  return any_new;
}

/// Holds one cue's height against that of the road's speed.
void MotionJudge::judge_cue(std::size_t cue, double dt_s, Observations* observations) {
  const CueReport& motion = (*observations)[kCueMotion].report;
  CueReport& report = (*observations)[cue].report;
  if (report.status != CueStatus::kUsed) return;
  const double apart = std::log(report.height / motion.height);
  const double motion_var = motion.height_var / square(motion.height);
  const double var = motion_var + report.height_var / square(report.height);
  judged_s_[cue] += dt_s;
  const double time_s = std::min(kMisfitTime_s, kFirstMisfitTime_s + judged_s_[cue]);
  misfit_[cue] +=
      std::min(1.0, dt_s / time_s) * (std::min(kMostOfOne, square(apart) / var) - misfit_[cue]);
  if (square(apart) > square(kMostStds) * motion_var) report.status = CueStatus::kFailed;
}

void MotionJudge::follow_filter(const Observation& motion, double ln_height) {
  if (motion.report.status != CueStatus::kUsed) {
    gap_ *= 1.0 - kGapShare;  // what it said holds for its own images
    return;
  }
  gap_ += kGapShare * (std::log(motion.report.height) - ln_height - gap_);
  gap_std_ = std::sqrt(motion.report.height_var) / motion.report.height;
}

double MotionJudge::excess() const {
  return std::max(0.0, std::abs(gap_) - kMostGapStds * gap_std_);
}

}  // namespace plumb
