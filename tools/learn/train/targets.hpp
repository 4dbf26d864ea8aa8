/// What is learned: errors of the cues and of the reported plane, each with its features, taken out of samples.
#pragma once

#include <array>
#include <vector>

#include "tools/learn/train/sample_file.hpp"
#include "tools/learn/train/variance_fit.hpp"

namespace plumb {

enum class Target : std::size_t {
  kDenseHeight = 0,
  kDenseN1,
  kDenseN3,
  kPoints,
  kTravel,
  kPlanePitch,
  kPlaneRoll,
  kPlaneHeight
};
inline constexpr std::array<Target, 8> kTargets{
    Target::kDenseHeight, Target::kDenseN1,    Target::kDenseN3,   Target::kPoints,
    Target::kTravel,      Target::kPlanePitch, Target::kPlaneRoll, Target::kPlaneHeight};
/// What is reported beside the filter's own variances. They follow from a model of the cues: samples must come from it.
inline constexpr std::array<Target, 3> kPlaneTargets{Target::kPlanePitch, Target::kPlaneRoll,
                                                     Target::kPlaneHeight};

[[nodiscard]] bool is_plane(Target target);
[[nodiscard]] const char* target_name(Target target);

struct TargetRow {
  VarianceRow row;
  double hand_var = 0.0;  ///< of FloorCovariance; of the plane: nothing beside the filter
  double seq = 0.0;
  double step_ratio = 0.0;
  bool direct =
      true;  ///< false: dense_n3 of a frame without a true plane, out of the height's error
};

/// What each of a drive's `num` frames weighs: a long drive counts for more than a short one, but not in proportion, for
/// its frames are alike.
[[nodiscard]] double drive_weight(std::size_t num);

/// Rows of one drive. Of `model`, the road's bend and dense_height (already fitted) serve frames without a true plane:
/// there the error of the height is nearly all tilt times slope. The direction of travel is held against itself a chord
/// before: what changes over so short a way is its noise. The plane's rows come from samples of "learned" runs only.
[[nodiscard]] std::vector<TargetRow> rows_of(Target target, const DriveSamples& drive,
                                             const GroundModel& model);

[[nodiscard]] LogVariance& model_of(Target target, GroundModel* model);
[[nodiscard]] const LogVariance& model_of(Target target, const GroundModel& model);

[[nodiscard]] SlopePrior prior_of(Target target);
[[nodiscard]] VarianceBounds bounds_of(Target target);

}  // namespace plumb
