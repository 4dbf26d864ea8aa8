/// Parts that vehicles are made of.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "tools/synth/vehicle.hpp"

namespace plumb::synth {

/// A point of a side profile: x forward, z up, of the vehicle.
struct ProfilePoint {
  double x;
  double z;
};

/// Extrudes a convex side profile (counted counter-clockwise seen from the right) across the width;
/// the walls lean in by `lean` per metre of height.
[[nodiscard]] Primitive extrude(const std::vector<ProfilePoint>& profile, double half_width,
                                double lean, const ObjectPose& pose);

[[nodiscard]] Primitive box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& half,
                               const ObjectPose& pose);

/// The albedo of a car's paint.
[[nodiscard]] float paint_of(std::uint32_t seed);

/// Two wheels `x_m` before the vehicle's middle.
void add_axle(const ObjectPose& pose, double x_m, double radius_m, std::vector<Primitive>& solids);

void add_articulated(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids);
void add_bus(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids);
void add_tram(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids);
void add_person(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids);

}  // namespace plumb::synth
