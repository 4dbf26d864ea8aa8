/// Every setting of the default algorithm of plumb-ground; visit() is the one list of keys, ranges
/// and meanings.
#pragma once

#include <string>

#include "modules/ground/types/ego_config.hpp"
#include "modules/ground/types/filter_config.hpp"

namespace plumb {

struct GroundConfig {
  std::string covariance = "learned";
  std::string model_file;
  int detections_delay_images = 1;
  int images_kept = 64;
  double camera_height_m = 1.65;
  double camera_height_std_m = 0.01;
  double road_near_m = 5.5;
  double road_far_m = 20.0;
  double road_half_width_m = 1.65;
  FilterConfig filter;
  EgoConfig ego;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.covariance", c.covariance, {"learned", "fixed"},
          "variances of the cues: predicted by the trained model for each frame, or set by hand");
    field("ground.model_file", c.model_file,
          "model written by plumb-train fit; empty: config/ground_model.toml as of the build");
    field("ground.detections_delay_images", c.detections_delay_images, 0, 8,
          "detected objects measure the pitch this many images after their own, so that results do "
          "not depend on the detector's time; later detections are refused; 0: never used");
    field("ground.images_kept", c.images_kept, 4, 64,
          "images that can wait for their motion; each costs its pixels in bytes");
    field("ground.camera_height_m", c.camera_height_m, 0.3, 4.0,
          "optical centre above the road; a calibration message that states one takes precedence");
    field("ground.camera_height_std_m", c.camera_height_std_m, 0.0, 1.0,
          "1-sigma of that height; the scale is as uncertain");
    field("ground.road_near_m", c.road_near_m, 1.0, 20.0,
          "nearest road that the dense cue looks at, ahead of the camera");
    field("ground.road_far_m", c.road_far_m, 5.0, 60.0,
          "farthest road that the dense cue looks at");
    field("ground.road_half_width_m", c.road_half_width_m, 0.5, 6.0,
          "road on either side of the path that counts as plane");
    FilterConfig::visit(c.filter, field);
    EgoConfig::visit(c.ego, field);
  }
};

}  // namespace plumb
