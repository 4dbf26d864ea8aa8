/// Every setting about boxes that ground and objects share; visit() is the only list of keys,
/// ranges and meanings.
#pragma once

#include <cstddef>

#include "modules/detections/detection.hpp"

namespace plumb {

/// The distribution of an object's height before it is observed.
struct HeightPrior {
  double mean_m = 0.0;
  double std_m = 0.0;
};

struct DetectionsConfig {
  HeightPrior car{1.53, 0.12};
  HeightPrior van{2.10, 0.25};
  HeightPrior truck{3.30, 0.45};
  HeightPrior bus{3.10, 0.35};
  HeightPrior pedestrian{1.72, 0.12};
  HeightPrior cyclist{1.72, 0.10};

  double min_score = 0.4;
  double min_box_height_px = 16.0;
  double border_px = 3.0;
  double max_truncated_ratio = 0.05;
  double max_hidden_ratio = 0.5;
  double max_distance_m = 90.0;
  double max_lateral_m = 20.0;

  double edge_std_px = 1.2;
  double edge_std_ratio = 0.03;
  double belief_offset_px2 = 0.5;
  double belief_slope = 0.15;
  double height_bias_std_ratio = 0.02;
  double road_bend_std_rad_m = 1e-4;

  double mean_pitch_rad = 0.0;
  double pitch_std_rad = 0.0090;
  double pitch_time_s = 3.0;
  double pitch_jitter_std_rad = 0.003;

  /// Mean and standard deviation of a class. The mean of kUnknown is 0: its height is not known.
  [[nodiscard]] HeightPrior height_prior(ObjectClass object_class) const {
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
    return {};
  }

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("detections.car_height_m", c.car.mean_m, 1.0, 2.5, "mean height of cars");
    field("detections.car_height_std_m", c.car.std_m, 0.02, 0.5, "standard deviation of it");
    field("detections.van_height_m", c.van.mean_m, 1.4, 3.5, "mean height of vans");
    field("detections.van_height_std_m", c.van.std_m, 0.02, 1.0, "standard deviation of it");
    field("detections.truck_height_m", c.truck.mean_m, 1.5, 4.5, "mean height of trucks");
    field("detections.truck_height_std_m", c.truck.std_m, 0.02, 1.5, "standard deviation of it");
    field("detections.bus_height_m", c.bus.mean_m, 2.0, 4.5, "mean height of buses");
    field("detections.bus_height_std_m", c.bus.std_m, 0.02, 1.0, "standard deviation of it");
    field("detections.pedestrian_height_m", c.pedestrian.mean_m, 1.2, 2.0,
          "mean height of pedestrians");
    field("detections.pedestrian_height_std_m", c.pedestrian.std_m, 0.02, 0.5,
          "standard deviation of it");
    field("detections.cyclist_height_m", c.cyclist.mean_m, 1.2, 2.2,
          "mean height of riders on their cycles");
    field("detections.cyclist_height_std_m", c.cyclist.std_m, 0.02, 0.5,
          "standard deviation of it");
    field("detections.min_score", c.min_score, 0.0, 1.0, "boxes with a lower score are ignored");
    field("detections.min_box_height_px", c.min_box_height_px, 4.0, 200.0,
          "boxes of a smaller height are ignored");
    field("detections.border_px", c.border_px, 0.0, 50.0,
          "a box that ends this close to the image's border counts as cut by it");
    field("detections.max_truncated_ratio", c.max_truncated_ratio, 0.0, 1.0,
          "boxes with a larger truncation are not used for the plane");
    field("detections.max_hidden_ratio", c.max_hidden_ratio, 0.0, 1.0,
          "a box is not used for the plane when nearer ones hide more of its lower or upper edge");
    field("detections.max_distance_m", c.max_distance_m, 10.0, 300.0,
          "boxes of objects that are farther away are ignored");
    field("detections.max_lateral_m", c.max_lateral_m, 2.0, 100.0,
          "boxes of objects farther to the side are not used for the plane");
    field("detections.edge_std_px", c.edge_std_px, 0.05, 20.0,
          "standard deviation of a box's edge: the part that is the same for all boxes");
    field("detections.edge_std_ratio", c.edge_std_ratio, 0.0, 0.5,
          "standard deviation of a box's edge: the part that grows with the box's height");
    field("detections.belief_offset_px2", c.belief_offset_px2, 0.0, 400.0,
          "variance of an edge when its candidates agree exactly");
    field("detections.belief_slope", c.belief_slope, 0.0, 10.0,
          "variance of an edge per px^2 of variance among its candidates");
    field("detections.height_bias_std_ratio", c.height_bias_std_ratio, 0.0, 0.2,
          "standard deviation of the relative height error that all objects share");
    field("detections.road_bend_std_rad_m", c.road_bend_std_rad_m, 0.0, 0.01,
          "standard deviation of the road's slope under an object, per metre of its distance");
    field("detections.mean_pitch_rad", c.mean_pitch_rad, -0.2, 0.2,
          "pitch of the calibrated plane, nose down positive");
    field("detections.pitch_std_rad", c.pitch_std_rad, 0.0005, 0.1,
          "standard deviation of the slow part of the pitch");
    field("detections.pitch_time_s", c.pitch_time_s, 0.05, 60.0,
          "correlation time of the slow part of the pitch");
    field("detections.pitch_jitter_std_rad", c.pitch_jitter_std_rad, 0.0001, 0.1,
          "standard deviation of the fast part of the pitch");
  }
};

}  // namespace plumb
