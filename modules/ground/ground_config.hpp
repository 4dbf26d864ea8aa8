/// Every setting of plumb-ground; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct GroundConfig {
  double camera_height_m = 1.65;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("ground.camera_height_m", c.camera_height_m, 0.3, 4.0,
          "optical centre above the road; a calibration message that states one wins");
  }
};

}  // namespace plumb
