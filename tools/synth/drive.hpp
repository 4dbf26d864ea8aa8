/// The vehicle's motion: along the route, on its springs, over a rough road.
///
/// Frames:
///   map: as in route.hpp.
///   veh: x forward, y left, z up, on the road under the rear axle.
///   cam: x right, y down, z forward.
///   Pitch is positive with the nose down, roll with the right side down (ISO 8855).
#pragma once

#include <cstdint>
#include <vector>

#include "core/se3.hpp"
#include "tools/synth/route.hpp"
#include "tools/synth/terrain.hpp"

namespace plumb::synth {

struct MountConfig {
  double height_m = 1.65;  ///< optical centre above the road, vehicle at rest
  double ahead_m = 1.68;   ///< before the rear axle
  double pitch_rad = 0.0;  ///< nose down
  double roll_rad = 0.0;   ///< right side down
  double yaw_rad = 0.0;    ///< to the left
};

/// The camera is knocked: from a moment on it is turned about its optical centre.
struct KnockConfig {
  double at_s = 0.0;  ///< never when not positive
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
  double yaw_rad = 0.0;
};

struct DriveConfig {
  MountConfig mount;
  KnockConfig knock;
  double suspension = 1.0;      ///< scales every motion on the springs; 0 = rigid
  double yaw_rate_rad_s = 0.0;  ///< turntable: added rotation about the camera's vertical
  double turn_from_s = 0.0;     ///< the turntable turns there and back in this time;
  double turn_to_s = 0.0;       ///< all the time when the span is empty
  std::uint64_t seed = 1;
};

struct VehicleState {
  double s_m = 0.0;
  double speed_m_s = 0.0;
  double accel_m_s2 = 0.0;
  double yaw_rate_rad_s = 0.0;
  double z_m = 0.0;      ///< of the body's reference above map zero: mean road height plus heave
  double heave_m = 0.0;  ///< of the body against the road
  double pitch_rad = 0.0;
  double roll_rad = 0.0;
};

class Drive {
 public:
  /// Integrates the whole drive. @pre route.schedule is filled
  Drive(const Terrain& terrain, const DriveConfig& config);

  [[nodiscard]] VehicleState state(double time_s) const;
  [[nodiscard]] Se3 T_map_veh(double time_s) const;
  [[nodiscard]] Se3 T_map_cam(double time_s) const;
  [[nodiscard]] double duration_s() const;

 private:
  [[nodiscard]] double turntable_rate_rad_s(double time_s) const;
  [[nodiscard]] double turntable_rad(double time_s) const;
  void integrate();

  const Terrain* terrain_;
  DriveConfig config_;
  Se3 T_veh_cam_;
  Se3 T_veh_cam_knocked_;
  std::vector<VehicleState> states_;  ///< every Schedule::kTimeStep
};

}  // namespace plumb::synth
