/// Every setting of the mount check; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct MountConfig {
  double stretch_m = 50.0;
  int num_stretches = 10;
  double max_spread_rad = 0.01;
  double alarm_rad = 0.0175;
  std::string state_file;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("mount.stretch_m", c.stretch_m, 5.0, 1000.0,
          "way on a straight road over which one look at the mount is averaged");
    field("mount.num_stretches", c.num_stretches, 4, 64, "stretches that make the reference");
    field("mount.max_spread_rad", c.max_spread_rad, 0.001, 0.1,
          "stretches that scatter by more (1-sigma) make no reference");
    field("mount.alarm_rad", c.alarm_rad, 0.002, 0.2,
          "the camera has moved when pitch, roll or yaw is off the reference by more; at half of "
          "it the alarm ends");
    field("mount.state_file", c.state_file,
          "keeps the reference over restarts; delete it after work on the camera; empty: none");
  }
};

}  // namespace plumb
