#include "modules/ground_paper/paper_points_cue.hpp"

namespace plumb {
namespace {

// A match that the motion does not explain is not a road point.
constexpr double kLargestMissPx = 1.5;
constexpr std::size_t kLeastVoters = 4;
constexpr double kLeastStartScore = 4.0;

}  // namespace

Triangulated triangulate(const CameraModel& camera, const Se3& T_old_cam, const PixelMatch& match) {
  const Eigen::Vector3d ray = camera.unproject(match.now);
  const Eigen::Vector2d seen = camera.to_normalized(match.old);
  const Eigen::Vector3d a = T_old_cam.R * ray;
  const Eigen::Vector3d& t = T_old_cam.t;
  // (a_xy Z + t_xy) = seen (a_z Z + t_z), two equations for Z.
  const Eigen::Vector2d slope = a.head<2>() - seen * a.z();
  const Eigen::Vector2d rest = seen * t.z() - t.head<2>();
  Triangulated out;
  const double depth = slope.dot(rest) / slope.squaredNorm();
  out.p_cam = depth * ray;
  const Eigen::Vector3d p_old = T_old_cam * out.p_cam;
  if (!(depth > 0.0) || !(p_old.z() > 0.0)) return out;
  out.miss_px = (camera.project(p_old) - match.old).norm();
  out.ok = out.p_cam.allFinite();
  return out;
}

PaperPointsCue::PaperPointsCue(const CameraModel& camera, const Eigen::Vector3d& normal_cam,
                               double mu)
    : camera_(camera), normal_cam_(normal_cam), mu_(mu) {}

void PaperPointsCue::collect(std::span<const PixelMatch> matches, const Se3& T_old_cam) {
  heights_.clear();
  for (const PixelMatch& match : matches) {
    const Triangulated point = triangulate(camera_, T_old_cam, match);
    if (!point.ok || point.miss_px > kLargestMissPx) continue;
    if (!heights_.push_back(normal_cam_.dot(point.p_cam))) return;  // (1)
  }
}

PaperPointsMeasurement PaperPointsCue::measure(std::span<const PixelMatch> matches,
                                               const Se3& T_old_cam) {
  collect(matches, T_old_cam);
  const HeightVote vote = vote_height({heights_.begin(), heights_.size()}, mu_);
  PaperPointsMeasurement out;
  out.num_matches = static_cast<int>(matches.size());
  out.num_voters = static_cast<int>(heights_.size());
  out.height = vote.height;
  out.score = vote.score;
  out.ok = vote.ok && heights_.size() >= kLeastVoters && vote.height > 0.0;
  return out;
}

double PaperPointsCue::search_height(std::span<const PixelMatch> matches, const Se3& T_old_cam,
                                     double height_m) {
  collect(matches, T_old_cam);
  const HeightVote vote = vote_height_any_unit({heights_.begin(), heights_.size()}, mu_, height_m);
  return vote.ok && vote.score >= kLeastStartScore ? vote.height : 0.0;
}

}  // namespace plumb
