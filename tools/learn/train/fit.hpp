/// Fits one model to the samples of many drives, and scores it on drives that the fit did not see.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/ground_paper/paper_model.hpp"
#include "tools/learn/train/box_samples.hpp"
#include "tools/learn/train/confidence_line.hpp"
#include "tools/learn/train/targets.hpp"

namespace plumb {

/// Fits the variances of these targets, and the correlation lengths of the cues of the height. For
/// the direction of translation it also fits the road's bend. Everything else, and a target without
/// rows, stays as in `start`. @pre drives not empty
[[nodiscard]] GroundModel fit_targets(const std::vector<DriveSamples>& drives,
                                      const GroundModel& start,
                                      std::span<const Target> targets = kTargets);

/// Fits the standard deviation of a whole drive's scale so that the reported scales have a mean
/// normalised squared error of one on the median drive. With the mean over drives, one bad drive
/// would make the model doubt all others. Samples of another algorithm than "learned" leave it as
/// it is.
void fit_scale_bias(const std::vector<DriveSamples>& drives, GroundModel* model);

/// A line that predicts a variance from a confidence, and the bins that it was fitted to.
struct ConfidenceFit {
  const char* name = "";
  std::vector<ConfidenceBin> bins;
  LinearVariance line;
};
/// Fits the published method's lines, from samples of algorithm "paper".
[[nodiscard]] std::vector<ConfidenceFit> fit_paper(const std::vector<DriveSamples>& drives,
                                                   PaperModel* model);

/// Fits model C_d of Algorithm 1 for the published method; nothing with fewer than two bins.
[[nodiscard]] std::optional<ConfidenceFit> fit_paper_objects(const std::vector<BoxSample>& boxes,
                                                             PaperModel* model);

/// Fits model C_d of Algorithm 1 (objects_n3) and objects_correlated_images, from drives with
/// detections and true planes. Without any it returns null and leaves the model as it is.
[[nodiscard]] std::optional<ConfidenceFit> fit_objects(const std::vector<DriveSamples>& drives,
                                                       GroundModel* model);

/// One frame's error over its standard deviation.
struct TimedError {
  double seq = 0.0;
  double sigmas = 0.0;
};
/// The number of images that share one independent error: the sum of the errors' correlations with
/// those of the frames before and after.
[[nodiscard]] double correlated_images_of(const std::vector<std::vector<TimedError>>& drives);
[[nodiscard]] double correlated_images_in(const std::vector<std::vector<TargetRow>>& drives,
                                          const LogVariance& model);
/// The correlation length, in camera heights, that gives this number of images at such steps.
[[nodiscard]] double correlation_length_of(double num_images, double step_ratio);

/// Scores for one drive and target: of a model that did not see the drive, and of the covariances
/// set by hand.
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

/// Mean normalised squared error of what was reported, for one drive and quantity.
struct OutputScore {
  std::string drive;
  std::string quantity;
  VarianceScore score;
  double rms_error = 0.0;
  double mean_std = 0.0;  ///< root of the mean variance
};
[[nodiscard]] std::vector<OutputScore> score_outputs(const std::vector<DriveSamples>& drives);

/// How the filter judged one cue of kCueTable on one drive.
struct CueScore {
  std::string drive;
  std::string cue;
  int num_used = 0;
  int num_rejected = 0;          ///< by the gate
  double mean_test_ratio = 0.0;  ///< of the used and rejected frames that have one; else NaN
};
/// One score for each cue and drive on which the cue measured anything.
[[nodiscard]] std::vector<CueScore> score_cues(const std::vector<DriveSamples>& drives);

}  // namespace plumb
