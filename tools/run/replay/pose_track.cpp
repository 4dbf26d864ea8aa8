#include "tools/run/replay/pose_track.hpp"

#include "core/pose_wire.hpp"

namespace plumb {

std::string PoseTrack::row(const ego_motion_t* ego) {
  const bool holds = ego != nullptr && ego->status != ego_motion_t::STATUS_INITIALIZING &&
                     ego->status != ego_motion_t::STATUS_LOST;
  Se3 T_world_cam;
  if (holds && from_wire(ego->q_world_cam, ego->t_world_cam_m, &T_world_cam) == nullptr) {
    T_world_cam_.topLeftCorner<3, 3>() = T_world_cam.R;
    T_world_cam_.topRightCorner<3, 1>() = T_world_cam.t;
  }
  return pose_row(T_world_cam_);
}

}  // namespace plumb
