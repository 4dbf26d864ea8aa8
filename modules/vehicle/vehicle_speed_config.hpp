/// Every setting of plumb-vehicle; visit() is the only list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct VehicleSpeedConfig {
  std::string dbc_file;
  std::string signal;
  double scale_std = 0.01;
  double delay_s = 0.0;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("vehicle_speed.dbc_file", c.dbc_file, "CAN database of the vehicle");
    field("vehicle_speed.signal", c.signal,
          "its forward speed in that file, as Message.Signal; the unit is m/s, km/h or mph");
    field("vehicle_speed.scale_std", c.scale_std, 0.0, 0.2,
          "relative 1-sigma that all speeds share, such as that of the tyres' circumference");
    field("vehicle_speed.delay_s", c.delay_s, 0.0, 1.0, "age of a speed when its frame arrives");
  }
};

}  // namespace plumb
