/// The settings of visual odometry.
#pragma once

#include <string>

namespace plumb {

struct VoConfig {
  int max_tracks = 450;
  double min_corner_grey2 = 2.5;
  double keyframe_parallax_px = 25.0;
  double keyframe_overlap_ratio = 0.7;
  int fixed_keyframes = 4;
  double start_flow_px = 6.0;
  double hold_flow_px = 0.35;
  double coast_limit_s = 2.0;
  double coast_decay_s = 3.0;
  double dark_grey = 6.0;
  double flat_std_grey = 3.0;
  std::string state_file;

  /// Calls field(key, member, lowest, highest, meaning) for every setting. This is the one list of
  /// keys and ranges.
  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("vo.max_tracks", c.max_tracks, 64, 1000,
          "largest number of features that are tracked at once");
    field("vo.min_corner_grey2", c.min_corner_grey2, 0.05, 100.0,
          "threshold of a corner: smaller eigenvalue of the mean structure tensor; "
          "15 % of it below the horizon");
    field("vo.keyframe_parallax_px", c.keyframe_parallax_px, 5.0, 100.0,
          "median rotation-compensated flow above which a keyframe is made");
    field(
        "vo.keyframe_overlap_ratio", c.keyframe_overlap_ratio, 0.2, 0.95,
        "share of the last keyframe's features that are still tracked, below which the next one is "
        "made");
    field("vo.fixed_keyframes", c.fixed_keyframes, 1, 6,
          "number of the oldest keyframes that refinement does not move");
    field("vo.start_flow_px", c.start_flow_px, 2.0, 40.0,
          "median flow from which the first two views are solved");
    field("vo.hold_flow_px", c.hold_flow_px, 0.05, 1.0,
          "flow due to translation below which there is zero motion");
    field("vo.coast_limit_s", c.coast_limit_s, 0.1, 10.0,
          "longest time for which the motion is predicted; then the status is lost");
    field("vo.coast_decay_s", c.coast_decay_s, 0.1, 60.0,
          "time constant with which the predicted motion decays");
    field("vo.dark_grey", c.dark_grey, 0.0, 64.0, "mean below which an image is dark");
    field("vo.flat_std_grey", c.flat_std_grey, 0.0, 32.0,
          "standard deviation below which an image is flat");
    field("vo.state_file", c.state_file,
          "file that keeps over restarts what is attached to the camera; delete it after work on "
          "the camera; empty: no file");
  }
};

}  // namespace plumb
