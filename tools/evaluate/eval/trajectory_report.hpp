/// Reads one or several sequences, compares them with the truth and sums up.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/evaluate/eval/kitti_metric.hpp"
#include "tools/evaluate/eval/scale_ratio.hpp"

namespace plumb {

struct EvalOptions {
  MetricOptions metric;
  double scale_window_m = 10.0;
  bool allow_partial =
      false;  ///< files of different length: compare the rows both have, from the first on
};

struct SequenceReport {
  std::string name;
  std::vector<PoseMatrix> gt;
  std::vector<PoseMatrix> est;
  double path_m = 0.0;  ///< of the truth
  std::vector<SegmentError> segments;
  MetricSummary summary;
  ScaleRatio scale;
};

struct TrajectoryReport {
  std::vector<SequenceReport> sequences;
  MetricSummary pooled;  ///< every segment of every sequence weighs the same
  MeanError
      mean_of_sequences;  ///< every sequence weighs the same; those without a segment do not count
};

/// Throws InputError when a file is wrong, or rows differ in number and partial is not allowed.
[[nodiscard]] SequenceReport evaluate_sequence(const std::string& name,
                                               const std::filesystem::path& gt_file,
                                               const std::filesystem::path& est_file,
                                               const EvalOptions& options);

/// Evaluates every `.txt` of `gt_dir` that `est_dir` has too, in the order of names.
/// Throws InputError when a folder is missing or no name is in both.
[[nodiscard]] std::vector<SequenceReport> evaluate_folders(const std::filesystem::path& gt_dir,
                                                           const std::filesystem::path& est_dir,
                                                           const EvalOptions& options);

[[nodiscard]] TrajectoryReport pool(std::vector<SequenceReport> sequences,
                                    const EvalOptions& options);

}  // namespace plumb
