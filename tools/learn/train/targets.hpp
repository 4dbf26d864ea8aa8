/// What is learned: errors of the cues and of the reported plane, each with its features, from
/// samples.
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
  kChord,
  kPlanePitch,
  kPlaneRoll,
  kPlaneHeight
};
inline constexpr std::array<Target, 8> kTargets{
    Target::kDenseHeight, Target::kDenseN1,    Target::kDenseN3,   Target::kPoints,
    Target::kChord,       Target::kPlanePitch, Target::kPlaneRoll, Target::kPlaneHeight};
/// Variances that are reported on top of the filter's own. They depend on the model of the cues, so
/// that the samples must come from a run with that model.
inline constexpr std::array<Target, 3> kPlaneTargets{Target::kPlanePitch, Target::kPlaneRoll,
                                                     Target::kPlaneHeight};

[[nodiscard]] bool is_plane(Target target);
[[nodiscard]] const char* target_name(Target target);

struct TargetRow {
  VarianceRow row;
  double hand_var = 0.0;  ///< from FixedCovariance; for the plane the filter's alone
  double seq = 0.0;
  double step_ratio = 0.0;
  bool direct = true;  ///< false: dense_n3 from the height's error, without a true plane
};

/// Weight of each of a drive's `num` frames. A long drive counts more than a short one, but not in
/// proportion, because its frames are alike.
[[nodiscard]] double drive_weight(std::size_t num);

/// Rows of one drive. Frames without a true plane use the road's bend and dense_height (already
/// fitted) of `model`: there the error of the height is nearly all tilt times slope. The direction
/// of translation is compared with itself one chord before: over so short a distance only its noise
/// changes. Rows of the plane come only from samples of "learned" runs.
[[nodiscard]] std::vector<TargetRow> rows_of(Target target, const DriveSamples& drive,
                                             const GroundModel& model);

[[nodiscard]] LogVariance& model_of(Target target, GroundModel* model);
[[nodiscard]] const LogVariance& model_of(Target target, const GroundModel& model);

[[nodiscard]] SlopePrior prior_of(Target target);
[[nodiscard]] VarianceBounds bounds_of(Target target);

}  // namespace plumb
