/// Every setting of plumb-ground; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct GroundConfig {
  double camera_height_m = 1.65;
  double road_near_m = 5.5;
  double road_far_m = 20.0;
  double road_half_width_m = 1.65;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.camera_height_m", c.camera_height_m, 0.3, 4.0,
          "optical centre above the road; a calibration message that states one wins");
    field("ground.road_near_m", c.road_near_m, 1.0, 20.0,
          "nearest road that the dense cue looks at, ahead of the camera");
    field("ground.road_far_m", c.road_far_m, 5.0, 60.0,
          "farthest road that the dense cue looks at");
    field("ground.road_half_width_m", c.road_half_width_m, 0.5, 6.0,
          "road on either side of the path that counts as plane");
  }
};

}  // namespace plumb
