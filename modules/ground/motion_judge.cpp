#include "modules/ground/motion_judge.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb {
namespace {

// A speed that is known less well than the first of these says nothing about a single height, and
// one that is known less well than the second one nothing about scatter either.
constexpr double kLargestJudgeStd = 0.08;
constexpr double kLargestSmoothStd = 0.25;
// Standard deviations of the road's speed by which a single height may differ from it, and the same
// for a cue that has kept to its own deviation for some time: then the pitch behind the road's
// speed is the one that may be wrong.
constexpr double kMostStds = 2.0;
constexpr double kMostStdsOfSteady = 4.0;
constexpr double kSteadyAfter_s = 0.5;

// A cue is refused from the first of these ratios on, or from the second one while the road is
// newly seen, and until it is below the third one. Of good cues it is 1 to 5.
constexpr double kMostScatter = 8.0;
constexpr double kMostScatterAtFirst = 16.0;
constexpr double kSteadyScatter = 4.0;
constexpr double kScatterTime_s = 1.5;
constexpr double kFirstScatterTime_s = 0.4;
// Without the road's speed, it is forgotten.
constexpr double kForgetTime_s = 5.0;
// What a single height can add, so that one wild height is soon forgotten.
constexpr double kMostOfOne = 40.0;

// Weight of a new image in the running mean of the gap between the road's speed and the filter, and
// what it may be in ln height.
constexpr double kGapShare = 0.5;
constexpr double kMostGap = 0.04;

}  // namespace

bool MotionJudge::judge(double dt_s, Observations* observations) {
  const CueReport& motion = (*observations)[kCueMotion].report;
  const double std = std::sqrt(motion.height_var) / motion.height;
  const bool judges = motion.status == CueStatus::kUsed && std <= kLargestSmoothStd;
  bool any_new = false;
  for (std::size_t i = 0; i < kNumCues; ++i) {
    if (!kCueTable[i].measures_height || i == kCueMotion) continue;
    const bool was_refused = cues_[i].refused;
    if (judges) {
      judge_cue(motion, dt_s, &cues_[i], &(*observations)[i].report);
    } else {
      cues_[i].scatter *= std::max(0.0, 1.0 - dt_s / kForgetTime_s);
    }
    any_new |= cues_[i].refused && !was_refused;
  }
  return any_new;
}

/// Holds one cue's height against that of the road's speed, which is smooth.
void MotionJudge::judge_cue(const CueReport& motion, double dt_s, JudgedCue* cue,
                            CueReport* report) {
  if (report->status != CueStatus::kUsed) return;
  const double apart = std::log(report->height / motion.height);
  if (cue->judged_s == 0.0) cue->mean = apart;
  cue->judged_s += dt_s;
  const double time_s = std::min(kScatterTime_s, kFirstScatterTime_s + cue->judged_s);
  const double share = std::min(1.0, dt_s / time_s);
  const double off = apart - cue->mean;
  const double var = report->height_var / square(report->height);
  cue->mean += share * off;
  cue->scatter += share * (std::min(kMostOfOne, (1.0 - share) * square(off) / var) - cue->scatter);
  const double motion_var = motion.height_var / square(motion.height);
  const bool is_known = motion_var <= square(kLargestJudgeStd);
  const double most_scatter = is_known ? kMostScatter : kMostScatterAtFirst;
  cue->refused = cue->scatter > (cue->refused ? kSteadyScatter : most_scatter);
  const bool steady = cue->judged_s > kSteadyAfter_s && cue->scatter < kSteadyScatter;
  const double most_stds = steady ? kMostStdsOfSteady : kMostStds;
  const bool is_far = is_known && square(apart) > square(most_stds) * motion_var;
  if (cue->refused || is_far) report->status = CueStatus::kFailed;
}

void MotionJudge::follow_filter(const Observation& motion, double ln_height) {
  if (motion.report.status != CueStatus::kUsed) {
    gap_ *= 1.0 - kGapShare;  // what it said holds for its own images
    return;
  }
  gap_ += kGapShare * (std::log(motion.report.height) - ln_height - gap_);
}

double MotionJudge::excess() const { return std::max(0.0, std::abs(gap_) - kMostGap); }

}  // namespace plumb
