/// Observations of the plane as the cues make them, for tests of the filter.
#pragma once

#include "modules/ground/filter/observation.hpp"

namespace plumb::test {

inline PlaneObservation plane_at(const Eigen::Vector3d& state, const Eigen::Matrix3d& cov) {
  PlaneObservation observation;
  observation.function = observe_plane;
  observation.value = state;
  observation.cov = cov;
  return observation;
}

inline PlaneObservation point_at(const Eigen::Vector3d& centre, double var) {
  PlaneObservation observation;
  observation.function = observe_point;
  observation.value = centre;
  observation.cov(0, 0) = var;
  observation.first_component = 2;
  return observation;
}

inline PlaneObservation pitch_of_road(double n3, double var) {
  PlaneObservation observation;
  observation.function = observe_pitch;
  observation.value(0) = n3;
  observation.cov(0, 0) = var;
  observation.first_component = 1;
  return observation;
}

inline PlaneObservation path_along(const Eigen::Vector3d& direction, double var) {
  PlaneObservation observation;
  observation.function = observe_direction;
  observation.value = direction;
  observation.cov(0, 0) = var;
  observation.road = RoadPart::kUnderCar;
  observation.gated = false;
  return observation;
}

}  // namespace plumb::test
