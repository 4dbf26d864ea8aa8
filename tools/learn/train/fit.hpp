/// The reduce step: samples of many drives -> one model, with scores on drives that the fit did not see.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/learn/train/belief_line.hpp"
#include "tools/learn/train/targets.hpp"

namespace plumb {

/// Fits the models of these targets, the cues' with their memories, travel's with the road's bend; what `start` holds and the samples say nothing about
/// stays. A target without rows keeps its model. @pre drives not empty
[[nodiscard]] GroundModel fit_targets(const std::vector<DriveSamples>& drives,
                                      const GroundModel& start,
                                      std::span<const Target> targets = kTargets);

/// Deviation of a whole drive's scale, so that what was reported gets a mean square of one on the typical drive, their
/// median: on the mean, one bad drive would make all others doubt themselves. Samples of another algorithm than
/// "learned" leave it as it is.
void fit_scale_bias(const std::vector<DriveSamples>& drives, GroundModel* model);

/// A line that tells a variance by one belief, and what it was drawn through.
struct BeliefFit {
  const char* name = "";
  std::vector<BeliefBin> bins;
  LinearVariance line;
};
/// The published method's lines (algorithm "paper").
[[nodiscard]] std::vector<BeliefFit> fit_paper(const std::vector<DriveSamples>& drives,
                                               GroundModel* model);

/// Model C_d of Algorithm 1, objects_n3 and objects_repetition: out of the samples of drives with detections and true
/// planes; without any, null and the model stays.
[[nodiscard]] std::optional<BeliefFit> fit_objects(const std::vector<DriveSamples>& drives,
                                                   GroundModel* model);

/// One frame's error over its deviation.
struct TimedError {
  double seq = 0.0;
  double sigmas = 0.0;
};
/// Sum of the errors' correlations with those of the frames before, both ways, and the memory that has the same sum.
[[nodiscard]] double repetition_of_errors(const std::vector<std::vector<TimedError>>& drives);
[[nodiscard]] double repetition_in(const std::vector<std::vector<TargetRow>>& drives,
                                   const LogVariance& model);
[[nodiscard]] double memory_of_repetition(double repetition, double step_ratio);

/// One drive and target: a model that did not see the drive, beside the one set by hand.
struct HeldOutScore {
  std::string drive;
  Target target = Target::kDenseHeight;
  VarianceScore learned;
  VarianceScore hand;
};
/// @pre at least two drives
[[nodiscard]] std::vector<HeldOutScore> leave_one_out(const std::vector<DriveSamples>& drives,
                                                      const GroundModel& start,
                                                      std::span<const Target> targets = kTargets);

/// Mean squared ratio of error and reported deviation, per drive and quantity.
struct OutputScore {
  std::string drive;
  std::string quantity;
  VarianceScore score;
  double rms_error = 0.0;
  double mean_std = 0.0;  ///< root of the mean variance
};
[[nodiscard]] std::vector<OutputScore> score_outputs(const std::vector<DriveSamples>& drives);

}  // namespace plumb
