#include "tools/evaluate/eval/trajectory_report.hpp"

#include <algorithm>

#include "core/input_error.hpp"
#include "core/numbers.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

void require_same_length(const fs::path& gt_file, const fs::path& est_file, SequenceReport* report,
                         bool allow_partial) {
  if (report->gt.empty()) throw InputError(gt_file.string() + " holds no pose");
  if (report->est.empty()) throw InputError(est_file.string() + " holds no pose");
  if (report->gt.size() == report->est.size()) return;
  if (!allow_partial) {
    throw InputError(gt_file.string() + " has " + std::to_string(report->gt.size()) + " rows and " +
                     est_file.string() + " has " + std::to_string(report->est.size()) +
                     "; --allow-partial compares the rows that both have");
  }
  const std::size_t common = std::min(report->gt.size(), report->est.size());
  report->gt.resize(common);
  report->est.resize(common);
}

}  // namespace

SequenceReport evaluate_sequence(const std::string& name, const fs::path& gt_file,
                                 const fs::path& est_file, const EvalOptions& options) {
  SequenceReport report;
  report.name = name;
  report.gt = read_poses(gt_file);
  report.est = read_poses(est_file);
  require_same_length(gt_file, est_file, &report, options.allow_partial);
  report.path_m = static_cast<double>(path_lengths_m(report.gt).back());
  report.segments = segment_errors(report.gt, report.est, options.metric);
  report.summary = summarize(report.segments, options.metric.lengths_m);
  report.scale = scale_ratio(report.gt, report.est, options.scale_window_m);
  return report;
}

std::vector<SequenceReport> evaluate_folders(const fs::path& gt_dir, const fs::path& est_dir,
                                             const EvalOptions& options) {
  for (const fs::path& folder : {gt_dir, est_dir}) {
    if (!fs::is_directory(folder)) throw InputError(folder.string() + " is not a folder");
  }
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(gt_dir)) {
    const fs::path name = entry.path().filename();
    if (name.extension() == ".txt" && fs::exists(est_dir / name)) names.push_back(name);
  }
  if (names.empty()) {
    throw InputError("no pose file (NAME.txt) is in both " + gt_dir.string() + " and " +
                     est_dir.string());
  }
  std::sort(names.begin(), names.end());
  std::vector<SequenceReport> reports;
  for (const fs::path& name : names) {
    reports.push_back(
        evaluate_sequence(name.stem().string(), gt_dir / name, est_dir / name, options));
  }
  return reports;
}

TrajectoryReport pool(std::vector<SequenceReport> sequences, const EvalOptions& options) {
  TrajectoryReport report;
  std::vector<SegmentError> all;
  MeanError sum;
  for (const SequenceReport& sequence : sequences) {
    all.insert(all.end(), sequence.segments.begin(), sequence.segments.end());
    if (sequence.segments.empty()) continue;
    ++sum.num_segments;
    sum.t_percent += sequence.summary.all.t_percent;
    sum.r_deg_m += sequence.summary.all.r_deg_m;
  }
  const double n = sum.num_segments;
  report.pooled = summarize(all, options.metric.lengths_m);
  report.mean_of_sequences.num_segments = sum.num_segments;
  report.mean_of_sequences.t_percent = n > 0.0 ? sum.t_percent / n : kNan;
  report.mean_of_sequences.r_deg_m = n > 0.0 ? sum.r_deg_m / n : kNan;
  report.sequences = std::move(sequences);
  return report;
}

}  // namespace plumb
