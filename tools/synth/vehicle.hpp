/// What drives and walks: kinds, sizes and shapes.
///
/// Frames:
///   An object's pose is its bottom centre: x forward, y left, z up.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/se3.hpp"
#include "tools/synth/primitive.hpp"

namespace plumb::synth {

enum class VehicleKind : std::uint8_t { kCar, kVan, kTruck, kArticulated, kBus, kTram, kPerson };

/// A labelled object at one time.
struct ObjectPose {
  VehicleKind kind = VehicleKind::kCar;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length, width, height
  Se3 T_map_object;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// Length, width, height of a vehicle of this kind and seed.
[[nodiscard]] Eigen::Vector3d vehicle_size(VehicleKind kind, std::uint32_t seed);

/// Appends the solids of one vehicle.
void add_vehicle(const ObjectPose& pose, std::uint32_t seed, std::int32_t object,
                 std::vector<Primitive>& solids);

}  // namespace plumb::synth
