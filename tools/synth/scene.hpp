/// Everything that stands or moves on and beside the road, with its true poses.
///
/// Frames:
///   map. An object's pose is its bottom centre: x forward, y left, z up.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/se3.hpp"
#include "tools/synth/drive.hpp"
#include "tools/synth/primitive.hpp"
#include "tools/synth/terrain.hpp"

namespace plumb::synth {

enum class VehicleKind : std::uint8_t { kCar, kVan, kTruck };

/// A labelled object at one time.
struct ObjectPose {
  VehicleKind kind = VehicleKind::kCar;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length, width, height
  Se3 T_map_object;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
};

/// How a moving vehicle goes along the route.
struct Mover {
  VehicleKind kind = VehicleKind::kCar;
  std::uint32_t seed = 0;
  double lateral_m = 0.0;  ///< left of the driven lane's centre
  bool leads = false;      ///< keeps ahead of us: goes where we are `headway_s` later, plus `s_m`
  double headway_s = 0.0;
  double s_m = 0.0;        ///< at time zero, or the gap when it leads
  double speed_m_s = 0.0;  ///< along the route, negative when it comes towards us
};

struct SceneConfig {
  int traffic = 6;            ///< moving vehicles
  std::string lead = "none";  ///< vehicle ahead of us: none, car or truck
  double lead_gap_m = 6.0;
  double lead_headway_s = 0.9;
  std::uint64_t seed = 1;
};

class Scene {
 public:
  Scene(const Terrain& terrain, const Drive& drive, const SceneConfig& config);

  /// Still solids; those of parked vehicles carry object numbers 0..num_parked-1.
  [[nodiscard]] const std::vector<Primitive>& still() const { return still_; }
  [[nodiscard]] const std::vector<ObjectPose>& parked() const { return parked_; }

  /// Solids of moving vehicles at a time; their objects follow the parked ones.
  void moving(double time_s, std::vector<Primitive>& solids,
              std::vector<ObjectPose>& objects) const;

  [[nodiscard]] const Terrain& terrain() const { return *terrain_; }

 private:
  [[nodiscard]] ObjectPose pose_of(const Mover& mover, double time_s) const;
  void plan_traffic(const SceneConfig& config);

  const Terrain* terrain_;
  const Drive* drive_;
  std::vector<Primitive> still_;
  std::vector<ObjectPose> parked_;
  std::vector<Mover> movers_;
};

/// Length, width, height of a vehicle of this kind and seed.
[[nodiscard]] Eigen::Vector3d vehicle_size(VehicleKind kind, std::uint32_t seed);

/// Appends the solids of one vehicle.
void add_vehicle(const ObjectPose& pose, std::uint32_t seed, std::int32_t object,
                 std::vector<Primitive>& solids);

/// Upright pose on the ground's tangent plane.
[[nodiscard]] Se3 stand_on(const Terrain& terrain, const Eigen::Vector2d& p_map, double yaw_rad);

/// Houses, trees, hedges, fences, posts and parked vehicles along a route.
void add_scenery(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still,
                 std::vector<ObjectPose>& parked);

}  // namespace plumb::synth
