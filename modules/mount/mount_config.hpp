/// Every setting of the mount check; visit() is the only list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct MountConfig {
  double stretch_m = 50.0;
  int num_stretches = 10;
  double max_spread_rad = 0.01;
  double alarm_rad = 0.0175;
  double misaligned_rad = 0.175;
  double height_stretch_m = 25.0;
  double height_bias_std = 0.004;
  std::string state_file;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("mount.stretch_m", c.stretch_m, 5.0, 1000.0,
          "distance travelled on a straight road over which one measurement of the mount is "
          "averaged");
    field("mount.num_stretches", c.num_stretches, 4, 64,
          "number of such stretches that make the reference");
    field("mount.max_spread_rad", c.max_spread_rad, 0.001, 0.1,
          "no reference is made when the standard deviation among the stretches is larger");
    field("mount.alarm_rad", c.alarm_rad, 0.002, 0.2,
          "the camera has moved when pitch, roll or yaw differs from the reference by more; the "
          "alarm ends at half of it");
    field("mount.misaligned_rad", c.misaligned_rad, 0.05, 0.8,
          "the camera is misaligned when the direction of travel is farther than this from the "
          "optical axis, up or down or to a side");
    field("mount.height_stretch_m", c.height_stretch_m, 5.0, 1000.0,
          "distance travelled on a straight road that gives one measurement of the camera's height "
          "from the vehicle's speed");
    field("mount.height_bias_std", c.height_bias_std, 0.0, 0.1,
          "1-sigma of what all stretches share when the height of the camera is learned from the "
          "vehicle's speed, besides the error of that speed; ratio");
    field("mount.state_file", c.state_file,
          "file that keeps the reference over restarts; delete it after work on the camera; empty: "
          "no file");
  }
};

}  // namespace plumb
