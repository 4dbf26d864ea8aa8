/// Settings of the published method; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct PaperConfig {
  std::string cues = "all";
  double rho = 1.5;
  double mu = 50.0;
  double region_width_ratio = 0.2;
  double region_height_ratio = 0.333;
  double least_step_m = 0.1;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double normal_noise_rad = 0.005;
  double height_noise_m = 0.01;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.cues", c.cues, {"all", "dense", "points"},
          "published method: cues to fuse; objects take part in all alone");
    field("ground.paper.rho", c.rho, 1.01, 10.0, "base of the dense cue's cost, equation (7)");
    field("ground.paper.mu", c.mu, 0.1, 10000.0,
          "1/m^2; sharpness of the points' vote, equation (8)");
    field("ground.paper.region_width_ratio", c.region_width_ratio, 0.05, 1.0,
          "width of the region of interest, in the middle of the image");
    field("ground.paper.region_height_ratio", c.region_height_ratio, 0.05, 0.5,
          "height of the region of interest, at the lower edge of the image");
    field("ground.paper.least_step_m", c.least_step_m, 0.01, 10.0,
          "least distance between compared images; at low speed an older image than the previous "
          "one is compared");
    field("ground.paper.pitch_rad", c.pitch_rad, -0.2, 0.2,
          "calibrated pitch, nose down positive: start of the search, and fixed for the points");
    field("ground.paper.roll_rad", c.roll_rad, -0.2, 0.2,
          "calibrated roll, right side down positive");
    field("ground.paper.normal_noise_rad", c.normal_noise_rad, 1e-5, 0.1,
          "process noise of the normal, 1-sigma per image");
    field("ground.paper.height_noise_m", c.height_noise_m, 1e-4, 1.0,
          "process noise of the height, 1-sigma per image");
  }
};

}  // namespace plumb
