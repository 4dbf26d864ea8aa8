#include "modules/ground/cues/chord.hpp"

#include <cmath>

namespace plumb {
namespace {

// Long enough to average heave and pose noise, short enough to follow the pitch: half a second at
// 10 frames/s.
constexpr int kChordFrames = 5;

constexpr double kShortestChord = 1e-9;

/// The oldest pose of the window within the chord; null when there is none.
const WindowPose* find_start(const VoOutput& vo) {
  const WindowPose* best = nullptr;
  for (const WindowPose& pose : vo.window) {
    const std::int64_t age = vo.seq - pose.seq;
    if (age < 1 || age > kChordFrames) continue;
    if (best == nullptr || pose.seq < best->seq) best = &pose;
  }
  return best;
}

}  // namespace

Chord measure_chord(const VoOutput& vo) {
  Chord chord;
  chord.step = vo.T_prev_cam.t.norm();
  const WindowPose* start = find_start(vo);
  const Se3& T_old_cam = start != nullptr ? start->T_window_cam : vo.T_prev_cam;
  chord.num_frames = static_cast<int>(vo.seq - (start != nullptr ? start->seq : vo.prev_seq));
  chord.length = T_old_cam.t.norm();
  if (chord.length < kShortestChord) return chord;
  const Eigen::Vector3d travel = T_old_cam.R.transpose() * T_old_cam.t / chord.length;
  const double sign = travel.z() < 0.0 ? -1.0 : 1.0;
  chord.direction = sign * travel;
  chord.curvature = sign * log_so3(T_old_cam.R).y() / chord.length;
  chord.valid = chord.direction.z() > 0.5;
  return chord;
}

Eigen::Vector3d normal_across(const Eigen::Vector3d& direction, double n1) {
  const double n3 = -(n1 * direction.x() + direction.y()) / direction.z();
  return Eigen::Vector3d(n1, 1.0, n3).normalized();
}

}  // namespace plumb
