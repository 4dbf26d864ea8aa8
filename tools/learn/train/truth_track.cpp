#include "tools/learn/train/truth_track.hpp"

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "core/pose_wire.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/log_file.hpp"
#include "plumb/ground_truth_t.hpp"

namespace plumb {

TruthTrack::TruthTrack(const std::string& log, const std::string& plane_file) {
  LogReader reader(log);
  LogEvent event;
  while (reader.next(&event)) {
    if (event.channel != kGroundTruth.name) continue;
    ground_truth_t truth;
    if (!decode_bounded(event.data, &truth)) throw InputError(log + ": a GROUND_TRUTH is damaged");
    Se3 T_world_cam;
    if (truth.has_pose != 0 &&
        from_wire(truth.q_world_cam, truth.t_world_cam_m, &T_world_cam) == nullptr)
      T_world_cam_[truth.seq] = T_world_cam;
    TruePlane plane{Eigen::Map<const Eigen::Vector3d>(truth.normal_cam), truth.height_m};
    if (truth.has_plane != 0 && plane.height_m > 0.0 && plane.normal_cam.y() > 0.0)
      planes_[truth.seq] = plane;
  }
  if (T_world_cam_.empty())
    throw InputError(log + " holds no true pose on GROUND_TRUTH; convert it with poses");
  if (!plane_file.empty()) planes_ = read_planes(plane_file);
}

std::optional<Se3> TruthTrack::motion(std::int64_t from, std::int64_t to) const {
  const auto a = T_world_cam_.find(from);
  const auto b = T_world_cam_.find(to);
  if (a == T_world_cam_.end() || b == T_world_cam_.end()) return {};
  return a->second.inverse() * b->second;
}

const TruePlane* TruthTrack::plane(std::int64_t seq) const {
  const auto found = planes_.find(seq);
  return found == planes_.end() ? nullptr : &found->second;
}

}  // namespace plumb
