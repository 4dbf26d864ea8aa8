/// Every setting of plumb-ground; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

/// What the published method leaves to its user (modules/ground/paper); mode "paper" only.
struct PaperConfig {
  double rho = 1.5;
  double mu = 50.0;
  double region_width_ratio = 0.2;
  double region_height_ratio = 0.333;
  double least_step_m = 0.1;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double normal_noise_rad = 0.005;
  double height_noise_m = 0.01;
};

struct GroundConfig {
  std::string mode = "default";
  std::string covariance = "learned";
  std::string model_file;
  std::string cues = "all";
  int detections_delay_images = 1;
  double camera_height_m = 1.65;
  double road_near_m = 5.5;
  double road_far_m = 20.0;
  double road_half_width_m = 1.65;
  PaperConfig paper;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.mode", c.mode, {"default", "paper"},
          "algorithm: ours, or the one of Song and Chandraker 2014, for comparison");
    field("ground.covariance", c.covariance, {"learned", "fixed"},
          "how far cues are trusted: by what training found for such frames; or as set by hand "
          "(paper mode: one trained covariance for all frames)");
    field("ground.model_file", c.model_file,
          "model written by plumb-train fit; empty: config/ground_model.toml as of the build");
    field("ground.cues", c.cues, {"all", "dense", "points"}, "paper mode: cues of height to fuse");
    field(
        "ground.detections_delay_images", c.detections_delay_images, 0, 8,
        "detected objects tell the pitch this many images after their own, so that results do not "
        "depend on the detector's time; those later are refused; 0: never used");
    field("ground.camera_height_m", c.camera_height_m, 0.3, 4.0,
          "optical centre above the road; a calibration message that states one wins");
    field("ground.road_near_m", c.road_near_m, 1.0, 20.0,
          "nearest road that the dense cue looks at, ahead of the camera");
    field("ground.road_far_m", c.road_far_m, 5.0, 60.0,
          "farthest road that the dense cue looks at");
    field("ground.road_half_width_m", c.road_half_width_m, 0.5, 6.0,
          "road on either side of the path that counts as plane");
    field("ground.paper.rho", c.paper.rho, 1.01, 10.0, "base of the dense cue's cost, (7)");
    field("ground.paper.mu", c.paper.mu, 0.1, 10000.0, "1/m^2; sharpness of the points' vote, (8)");
    field("ground.paper.region_width_ratio", c.paper.region_width_ratio, 0.05, 1.0,
          "width of the region of interest, in the middle of the image");
    field("ground.paper.region_height_ratio", c.paper.region_height_ratio, 0.05, 0.5,
          "height of the region of interest, at the lower edge of the image");
    field("ground.paper.least_step_m", c.paper.least_step_m, 0.01, 10.0,
          "nearer images are not compared; at low speed an older one than the previous is");
    field("ground.paper.pitch_rad", c.paper.pitch_rad, -0.2, 0.2,
          "calibrated pitch, nose down positive: start of the search, and fixed for the points");
    field("ground.paper.roll_rad", c.paper.roll_rad, -0.2, 0.2,
          "calibrated roll, right side down positive");
    field("ground.paper.normal_noise_rad", c.paper.normal_noise_rad, 1e-5, 0.1,
          "process noise of the normal, 1-sigma per image");
    field("ground.paper.height_noise_m", c.paper.height_noise_m, 1e-4, 1.0,
          "process noise of the height, 1-sigma per image");
  }
};

}  // namespace plumb
