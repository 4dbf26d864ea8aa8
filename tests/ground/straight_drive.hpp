#pragma once

#include <cmath>

#include "modules/ground/ground.hpp"

namespace plumb::test {

inline constexpr double kSpeed_m_s = 10.0;

/// One result of the chain on a straight road, at 10 images a second.
inline GroundOutput straight_on(const Eigen::Vector3d& mount_rad) {
  GroundOutput output;
  output.plane.status = GroundStatus::kOk;
  output.plane.pitch_rad = mount_rad.x();
  output.plane.roll_rad = mount_rad.y();
  output.ego.status = EgoStatus::kOk;
  output.ego.T_prev_cam.t =
      0.1 * kSpeed_m_s * Eigen::Vector3d(std::sin(mount_rad.z()), 0.0, std::cos(mount_rad.z()));
  output.ego.velocity_ground_m_s = {kSpeed_m_s, 0.0, 0.0};
  return output;
}

}  // namespace plumb::test
