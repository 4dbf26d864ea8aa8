#include "tools/evaluate/eval/plots.hpp"

#include <Eigen/LU>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "tools/evaluate/eval/gnuplot.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("cannot make folder " + folder.string() + ": " + error.message());
}

/// The path from above in the first frame's own axes, so that all paths begin at the origin and
/// head up.
Curve top_view(const std::string& title, const std::vector<PoseMatrix>& poses) {
  Curve curve{title, {}, {}};
  const PoseMatrix T_first_world = poses.front().inverse();
  for (const PoseMatrix& T_world_cam : poses) {
    const PoseMatrix T_first_cam = T_first_world * T_world_cam;
    curve.x.push_back(T_first_cam(0, 3));
    curve.y.push_back(T_first_cam(2, 3));
  }
  return curve;
}

/// Translation and rotation error, one curve per sequence and one for all.
std::vector<Plot> error_plots(const TrajectoryReport& report, const std::string& over,
                              std::vector<BinError> MetricSummary::*bins) {
  Plot t{"translation error", over, "percent", {}, false, true};
  Plot r{"rotation error", over, "deg/m", {}, false, true};
  const auto add = [&](const std::string& name, const MetricSummary& summary) {
    Curve t_curve{name, {}, {}};
    Curve r_curve{name, {}, {}};
    for (const BinError& bin : summary.*bins) {
      if (bin.error.num_segments == 0) continue;
      t_curve.x.push_back(bin.at);
      t_curve.y.push_back(bin.error.t_percent);
      r_curve.x.push_back(bin.at);
      r_curve.y.push_back(bin.error.r_deg_m);
    }
    if (t_curve.x.empty()) return;
    t.curves.push_back(t_curve);
    r.curves.push_back(r_curve);
  };
  for (const SequenceReport& sequence : report.sequences) add(sequence.name, sequence.summary);
  if (t.curves.size() > 1) add("all", report.pooled);
  return {t, r};
}

}  // namespace

std::vector<fs::path> draw_plots(const TrajectoryReport& report, const fs::path& folder,
                                 const std::string& format) {
  make_folder(folder);
  std::vector<fs::path> files;
  for (const SequenceReport& sequence : report.sequences) {
    files.push_back(folder / (sequence.name + "_trajectory." + format));
    draw({{sequence.name + ", seen from above",
           "right of the first heading [m]",
           "ahead [m]",
           {top_view("truth", sequence.gt), top_view("estimate", sequence.est)},
           true,
           false}},
         files.back());
  }
  if (report.pooled.all.num_segments == 0) return files;
  files.push_back(folder / ("error_by_length." + format));
  draw(error_plots(report, "segment length [m]", &MetricSummary::by_length), files.back());
  files.push_back(folder / ("error_by_speed." + format));
  draw(error_plots(report, "speed [m/s]", &MetricSummary::by_speed), files.back());
  return files;
}

std::vector<fs::path> draw_plots(const PlaneReport& report, const fs::path& folder,
                                 const std::string& format) {
  if (report.pairs.empty()) return {};
  make_folder(folder);
  Curve true_height{"truth", {}, {}, true}, height{"estimate", {}, {}};
  Curve true_pitch{"truth", {}, {}, true}, pitch{"estimate", {}, {}};
  for (const PlanePair& pair : report.pairs) {
    const auto frame = static_cast<double>(pair.seq);
    for (Curve* curve : {&true_height, &height, &true_pitch, &pitch}) curve->x.push_back(frame);
    true_height.y.push_back(pair.true_height_m);
    height.y.push_back(pair.height_m);
    true_pitch.y.push_back(degrees(pair.true_pitch_rad));
    pitch.y.push_back(degrees(pair.pitch_rad));
  }
  const fs::path file = folder / ("planes." + format);
  draw({{"camera height above the road", "frame", "m", {true_height, height}, false, false},
        {"pitch of the camera against the road, nose down positive",
         "frame",
         "deg",
         {true_pitch, pitch},
         false,
         false}},
       file);
  return {file};
}

}  // namespace plumb
