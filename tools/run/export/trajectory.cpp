#include "tools/run/export/trajectory.hpp"

#include <algorithm>
#include <charconv>

#include "core/pose_wire.hpp"
#include "modules/datasets/text.hpp"
#include "tools/run/export/vehicle_frame.hpp"
#include "tools/run/replay/pose_track.hpp"
#include "tools/run/replay/text_output.hpp"

namespace plumb {
namespace {

/// The shortest text that reads back to the same bits.
std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The pose of a frame in the wire's form, which for the camera is that of the message.
struct WirePose {
  double q[4];
  double t_m[3];
};

WirePose pose_of(const FrameResult& frame, const Se3* T_vehicle_cam) {
  WirePose pose{};
  if (T_vehicle_cam != nullptr) {
    to_wire(vehicle_pose(*T_vehicle_cam, camera_pose(frame)), pose.q, pose.t_m);
  } else {
    std::copy(std::begin(frame.ego->q_world_cam), std::end(frame.ego->q_world_cam), pose.q);
    std::copy(std::begin(frame.ego->t_world_cam_m), std::end(frame.ego->t_world_cam_m), pose.t_m);
  }
  return pose;
}

std::string tum_row(std::int64_t capture_us, const WirePose& pose) {
  std::string row = format("%lld.%06lld", static_cast<long long>(capture_us / 1'000'000),
                           static_cast<long long>(capture_us % 1'000'000));
  for (const double value : pose.t_m) row += ' ' + shortest(value);
  for (const int i : {1, 2, 3, 0}) row += ' ' + shortest(pose.q[i]);
  return row;
}

}  // namespace

std::int64_t write_tum(const DriveResults& drive, TrajectoryFrame frame,
                       const std::filesystem::path& path) {
  const Se3 T_vehicle_cam = vehicle_from_camera(drive);
  TextOutput file(path);
  std::int64_t num_rows = 0;
  for (const FrameResult& result : drive.frames) {
    if (!has_pose(result)) continue;
    file.row(
        tum_row(result.capture_us,
                pose_of(result, frame == TrajectoryFrame::kOfVehicle ? &T_vehicle_cam : nullptr)));
    ++num_rows;
  }
  file.close();
  return num_rows;
}

std::int64_t write_kitti(const DriveResults& drive, TrajectoryFrame frame,
                         const std::filesystem::path& path) {
  const Se3 T_vehicle_cam = vehicle_from_camera(drive);
  PoseTrack track;
  TextOutput file(path);
  for (const FrameResult& result : drive.frames) {
    std::optional<ego_motion_t> ego = result.ego;
    if (frame == TrajectoryFrame::kOfVehicle && has_pose(result))
      to_wire(vehicle_pose(T_vehicle_cam, camera_pose(result)), ego->q_world_cam,
              ego->t_world_cam_m);
    file.row(track.row(ego ? &*ego : nullptr));
  }
  file.close();
  return static_cast<std::int64_t>(drive.frames.size());
}

}  // namespace plumb
