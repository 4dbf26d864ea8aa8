#include "modules/vo/features.hpp"

#include <algorithm>

#include "core/numbers.hpp"
#include "modules/vo/pose.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

// Standard deviation of the position by the depth up to which a kind is named.
constexpr double kMaxOpenPx = 2.0;
// Gate on the squared deviations from which a feature moves. Between the gate of fit_pose() and
// this one there are, above all, static ones that are matched badly.
constexpr double kMovingChi2 = 16.0;
// How far an attached feature may move, and how far the rotation moves the farthest point at least.
constexpr double kAttachedPx = 0.75;
constexpr double kMinTurnPx = 3.0;

/// How far the camera's rotation since the host moves a point at infinity.
double turn_px(const Track& track, const Se3& T_cam_host, const Eigen::Vector2d& focal_px) {
  const Eigen::Vector3d far = T_cam_host.R * track.host_xy.homogeneous();
  if (far.z() < kMinDepthRatio) return 0.0;
  return focal_px.cwiseProduct(far.head<2>() / far.z() - track.host_xy).norm();
}

FeatureKind kind_of(const Track& track, const Se3& T_cam_host, const Eigen::Vector2d& focal_px) {
  const PointInFrame p = transfer(T_cam_host, track.host_xy, track.rho, track.xy, focal_px);
  if (!p.in_front) return FeatureKind::kUndecided;
  const Eigen::Vector2d d = projection_jacobian(p.Y, focal_px) * T_cam_host.t;
  const double open_px = track.rho_std * d.norm();
  // As in fit_pose(): the residual without its part that the depth may explain.
  const double along = d.isZero() ? 0.0 : p.residual_px.dot(d.normalized());
  const double s2 = square(kPixelStd);
  const double chi2 =
      (p.residual_px.squaredNorm() - square(along)) / s2 + square(along) / (s2 + square(open_px));
  if (chi2 < kInlierChi2)
    return open_px <= kMaxOpenPx ? FeatureKind::kStatic : FeatureKind::kUndecided;
  const bool stays = (track.px - track.host_px).norm() <= kAttachedPx;
  const bool is_attached = stays && turn_px(track, T_cam_host, focal_px) >= kMinTurnPx;
  if (is_attached) return FeatureKind::kAttached;
  return chi2 >= kMovingChi2 ? FeatureKind::kMoving : FeatureKind::kUndecided;
}

}  // namespace

void collect_features(const TrackTable& tracks, const Window& window, const Se3& T_cam_world,
                      const CameraModel& camera, FixedVector<Feature, kMaxFeatures>* features) {
  features->clear();
  const Eigen::Vector2d focal_px(camera.fx_px, camera.fy_px);
  const auto T_cam_slot = window.slots_to_cam(T_cam_world);
  for (const int index : tracks.active()) {
    const Track& track = tracks[index];
    const Se3& T_cam_host = T_cam_slot[static_cast<std::size_t>(track.host)];
    if (!features->push_back({track.px.cast<float>(), kind_of(track, T_cam_host, focal_px)}))
      return;
  }
}

void add_undecided_features(const TrackTable& tracks, std::size_t count,
                            FixedVector<Feature, kMaxFeatures>* features) {
  const std::vector<int>& active = tracks.active();
  for (std::size_t i = active.size() - std::min(count, active.size()); i < active.size(); ++i) {
    const Eigen::Vector2f px = tracks[active[i]].px.cast<float>();
    if (!features->push_back({px, FeatureKind::kUndecided})) return;
  }
}

}  // namespace plumb::vo
