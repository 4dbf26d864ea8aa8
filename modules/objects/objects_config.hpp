/// Every setting of plumb-objects; visit() is the only list of keys, ranges and meanings. The
/// heights of objects and the accuracy of boxes are in detections_config.hpp.
#pragma once

#include <string>

#include "modules/detections/detection.hpp"

namespace plumb {

/// The distribution of a class's width and length-to-width ratio before an object is observed.
struct FootprintPrior {
  double width_m = 0.0;
  double width_std_m = 0.0;
  double ratio = 0.0;
  double ratio_std = 0.0;
};

struct ObjectsConfig {
  std::string plane = "measured";
  FootprintPrior car{1.67, 0.12, 2.40, 0.22};
  FootprintPrior van{1.90, 0.15, 2.60, 0.30};
  FootprintPrior truck{2.50, 0.20, 3.50, 1.00};
  FootprintPrior bus{2.60, 0.15, 4.20, 0.80};
  FootprintPrior pedestrian{0.65, 0.12, 1.00, 0.25};
  FootprintPrior cyclist{0.60, 0.10, 2.90, 0.30};
  FootprintPrior unknown{1.50, 0.60, 1.80, 0.80};
  double unknown_height_m = 1.60;
  double unknown_height_std_m = 0.50;

  double contact_inset_m = 0.40;
  double contact_inset_std_m = 0.20;
  double side_std_m = 0.10;
  double accel_std_m_s2 = 2.5;
  double relative_accel_std_m_s2 = 10.0;
  double start_speed_std_m_s = 10.0;
  double plane_error_time_s = 1.0;
  double cross_slope_std = 0.02;
  double foot_height_std_m = 0.05;
  double max_coast_s = 1.0;
  double least_overlap_ratio = 0.3;

  [[nodiscard]] const FootprintPrior& footprint(ObjectClass object_class) const {
    switch (object_class) {
      case ObjectClass::kCar:
        return car;
      case ObjectClass::kVan:
        return van;
      case ObjectClass::kTruck:
        return truck;
      case ObjectClass::kBus:
        return bus;
      case ObjectClass::kPedestrian:
        return pedestrian;
      case ObjectClass::kCyclist:
        return cyclist;
      case ObjectClass::kUnknown:
        break;
    }
    return unknown;
  }

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("objects.plane", c.plane, {"measured", "calibrated"},
          "plane of the road under the objects: GROUND_PLANE where it is valid, or for comparison "
          "always "
          "the calibrated plane");
    const auto footprint = [&field](const char* width, const char* width_std, const char* ratio,
                                    const char* ratio_std, auto& prior) {
      field(width, prior.width_m, 0.2, 4.0, "mean width of the class");
      field(width_std, prior.width_std_m, 0.01, 2.0, "standard deviation of the width");
      field(ratio, prior.ratio, 0.3, 10.0, "mean of length over width");
      field(ratio_std, prior.ratio_std, 0.01, 5.0, "standard deviation of length over width");
    };
    footprint("objects.car_width_m", "objects.car_width_std_m", "objects.car_length_ratio",
              "objects.car_length_ratio_std", c.car);
    footprint("objects.van_width_m", "objects.van_width_std_m", "objects.van_length_ratio",
              "objects.van_length_ratio_std", c.van);
    footprint("objects.truck_width_m", "objects.truck_width_std_m", "objects.truck_length_ratio",
              "objects.truck_length_ratio_std", c.truck);
    footprint("objects.bus_width_m", "objects.bus_width_std_m", "objects.bus_length_ratio",
              "objects.bus_length_ratio_std", c.bus);
    footprint("objects.pedestrian_width_m", "objects.pedestrian_width_std_m",
              "objects.pedestrian_length_ratio", "objects.pedestrian_length_ratio_std",
              c.pedestrian);
    footprint("objects.cyclist_width_m", "objects.cyclist_width_std_m",
              "objects.cyclist_length_ratio", "objects.cyclist_length_ratio_std", c.cyclist);
    footprint("objects.unknown_width_m", "objects.unknown_width_std_m",
              "objects.unknown_length_ratio", "objects.unknown_length_ratio_std", c.unknown);
    field("objects.unknown_height_m", c.unknown_height_m, 0.5, 4.0,
          "mean height of objects without a class");
    field("objects.unknown_height_std_m", c.unknown_height_std_m, 0.02, 2.0,
          "standard deviation of the height of objects without a class");
    field("objects.contact_inset_m", c.contact_inset_m, 0.0, 1.0,
          "distance inside its outline at which a vehicle touches the road");
    field("objects.contact_inset_std_m", c.contact_inset_std_m, 0.0, 1.0,
          "standard deviation of that distance");
    field("objects.side_std_m", c.side_std_m, 0.0, 1.0,
          "standard deviation of the systematic lateral offset between the centre of an object and "
          "that of its box, which the rounded shape of a body causes");
    field("objects.accel_std_m_s2", c.accel_std_m_s2, 0.1, 20.0,
          "standard deviation of an object's acceleration");
    field("objects.relative_accel_std_m_s2", c.relative_accel_std_m_s2, 0.1, 50.0,
          "standard deviation of the acceleration relative to the camera, while its motion is "
          "unknown");
    field("objects.start_speed_std_m_s", c.start_speed_std_m_s, 0.5, 60.0,
          "standard deviation of the velocity of a new object");
    field("objects.plane_error_time_s", c.plane_error_time_s, 0.05, 30.0,
          "correlation time of the error of the plane");
    field(
        "objects.cross_slope_std", c.cross_slope_std, 0.0, 0.2,
        "standard deviation of the road's slope between the camera's lane and an object beside it");
    field("objects.foot_height_std_m", c.foot_height_std_m, 0.0, 0.5,
          "standard deviation of the height of kerbs and bumps under an object");
    field("objects.max_coast_s", c.max_coast_s, 0.1, 5.0,
          "longest time for which a track is predicted without a box");
    field(
        "objects.least_overlap_ratio", c.least_overlap_ratio, 0.05, 0.95,
        "smallest intersection over union that continues a track when the detector does not track");
  }
};

}  // namespace plumb
