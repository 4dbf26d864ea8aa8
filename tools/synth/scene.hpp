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
#include "tools/synth/lamps.hpp"
#include "tools/synth/primitive.hpp"
#include "tools/synth/terrain.hpp"
#include "tools/synth/traffic.hpp"
#include "tools/synth/vehicle.hpp"

namespace plumb::synth {

struct SceneConfig {
  int traffic = 6;            ///< moving vehicles
  std::string lead = "none";  ///< vehicle ahead of us: none, car or truck
  double lead_gap_m = 6.0;
  double lead_headway_s = 0.9;
  CompanyConfig company;
  Tube tube;                    ///< from the start of the drive
  double street_lamps_m = 0.0;  ///< distance between them; 0 = none
  std::uint64_t seed = 1;
};

class Scene {
 public:
  Scene(const Terrain& terrain, const Drive& drive, const SceneConfig& config);

  /// Still solids; those of parked vehicles carry object numbers 0..num_parked-1.
  [[nodiscard]] const std::vector<Primitive>& still() const { return still_; }
  [[nodiscard]] const std::vector<ObjectPose>& parked() const { return parked_; }
  [[nodiscard]] const std::vector<Lamp>& lamps() const { return lamps_; }

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
  std::vector<Lamp> lamps_;
  std::vector<Mover> movers_;
};

/// Upright pose on the ground's tangent plane.
[[nodiscard]] Se3 stand_on(const Terrain& terrain, const Eigen::Vector2d& p_map, double yaw_rad);

/// Houses, trees, hedges, fences, posts and parked vehicles along a route.
void add_scenery(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still,
                 std::vector<ObjectPose>& parked);

/// What is built beside and above the road of a freeway: barrier, walls, signs across the road.
void add_roadside(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still);

/// Walls, roof and lamps of a tunnel.
void add_tube(const Terrain& terrain, const Tube& tube, std::uint64_t seed,
              std::vector<Primitive>& still, std::vector<Lamp>& lamps);

/// Street lamps on the right of the route, every `spacing_m`.
void add_street_lamps(const Terrain& terrain, double spacing_m, std::uint64_t seed,
                      std::vector<Primitive>& still, std::vector<Lamp>& lamps);

}  // namespace plumb::synth
