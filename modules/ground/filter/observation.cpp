#include "modules/ground/filter/observation.hpp"

#include <cmath>

#include "modules/ground/types/plane_state.hpp"

namespace plumb {
namespace {

/// z = value(0) is a component of the plane; H is its unit row.
Linearisation observe_component(double value, const Eigen::Vector3d& plane, int component) {
  Linearisation at;
  at.num_rows = 1;
  at.innovation(0) = value - plane(component);
  at.jacobian(0, component) = 1.0;
  return at;
}

}  // namespace

Linearisation observe_plane(const Eigen::Vector3d& state, const Eigen::Vector3d& plane) {
  return {3, state - plane, Eigen::Matrix3d::Identity()};
}

Linearisation observe_point(const Eigen::Vector3d& centre, const Eigen::Vector3d& plane) {
  const double height = normal_of_state(plane).dot(centre);
  if (!(height > 0.0)) return {};
  Linearisation at;
  at.num_rows = 1;
  at.innovation(0) = std::log(height) - plane(2);
  at.jacobian.block<1, 2>(0, 0) = -(centre / height).transpose() * normal_jacobian(plane);
  at.jacobian(0, 2) = 1.0;
  return at;
}

Linearisation observe_height(const Eigen::Vector3d& value, const Eigen::Vector3d& plane) {
  return observe_component(value(0), plane, 2);
}

Linearisation observe_pitch(const Eigen::Vector3d& value, const Eigen::Vector3d& plane) {
  return observe_component(value(0), plane, 1);
}

Linearisation observe_direction(const Eigen::Vector3d& direction, const Eigen::Vector3d& plane) {
  Linearisation at;
  at.num_rows = 1;
  at.innovation(0) = -normal_of_state(plane).dot(direction);
  at.jacobian.block<1, 2>(0, 0) = direction.transpose() * normal_jacobian(plane);
  return at;
}

Linearisation observe_level(const Eigen::Vector3d& /*unused*/, const Eigen::Vector3d& plane) {
  return observe_component(0.0, plane, 0);
}

}  // namespace plumb
