/// Every setting of plumb-vo; visit() is the one list of keys, ranges and meanings.
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

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("vo.max_tracks", c.max_tracks, 64, 1000, "features tracked at once");
    field(
        "vo.min_corner_grey2", c.min_corner_grey2, 0.05, 100.0,
        "smaller eigenvalue of a corner's mean structure tensor; a fifth of it below the horizon");
    field("vo.keyframe_parallax_px", c.keyframe_parallax_px, 5.0, 100.0,
          "median rotation-compensated flow that makes a keyframe");
    field("vo.keyframe_overlap_ratio", c.keyframe_overlap_ratio, 0.2, 0.95,
          "share of the last keyframe's features still tracked, below which the next one is made");
    field("vo.fixed_keyframes", c.fixed_keyframes, 1, 6,
          "oldest keyframes that refinement leaves alone");
    field("vo.start_flow_px", c.start_flow_px, 2.0, 40.0,
          "median flow at which the first two views are solved");
    field("vo.hold_flow_px", c.hold_flow_px, 0.05, 1.0,
          "flow due to translation below which the camera's place is held");
    field("vo.coast_limit_s", c.coast_limit_s, 0.1, 10.0,
          "predicted for no longer than this, then lost");
    field("vo.coast_decay_s", c.coast_decay_s, 0.1, 60.0,
          "time constant of the predicted motion's decay");
    field("vo.dark_grey", c.dark_grey, 0.0, 64.0, "images with a lower mean are dark");
    field("vo.flat_std_grey", c.flat_std_grey, 0.0, 32.0, "images with a lower deviation are flat");
  }
};

}  // namespace plumb
