#include "modules/ground/cues/travel.hpp"

#include <cmath>

namespace plumb {
namespace {

// Long enough to average heave and pose noise, short enough to follow pitch: half a second at 10
// frames/s.
constexpr int kChordFrames = 5;

constexpr double kShortestChord = 1e-9;

const WindowPose* find_chord(const VoOutput& vo) {
  const WindowPose* best = nullptr;
  for (const WindowPose& pose : vo.window) {
    const std::int64_t age = vo.seq - pose.seq;
    if (age < 1 || age > kChordFrames) continue;
    if (best == nullptr || pose.seq < best->seq) best = &pose;
  }
  return best;
}

}  // namespace

Travel measure_travel(const VoOutput& vo) {
  Travel travel;
  travel.step = vo.T_prev_cam.t.norm();
  const WindowPose* chord = find_chord(vo);
  const Se3& T_old_cam = chord != nullptr ? chord->T_window_cam : vo.T_prev_cam;
  travel.num_chord_frames =
      static_cast<int>(vo.seq - (chord != nullptr ? chord->seq : vo.prev_seq));
  travel.chord_length = T_old_cam.t.norm();
  if (travel.chord_length < kShortestChord) return travel;
  travel.direction = T_old_cam.R.transpose() * T_old_cam.t / travel.chord_length;
  travel.curvature = log_so3(T_old_cam.R).y() / travel.chord_length;
  travel.valid = travel.direction.z() > 0.5;
  return travel;
}

Eigen::Vector3d normal_across(const Eigen::Vector3d& direction, double n1) {
  const double n3 = -(n1 * direction.x() + direction.y()) / direction.z();
  return Eigen::Vector3d(n1, 1.0, n3).normalized();
}

}  // namespace plumb
