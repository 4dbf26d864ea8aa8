#include "modules/vo/inverse_depth.hpp"

#include <algorithm>
#include <cmath>

#include "modules/vo/pose.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr double kDepthCauchy2 = 1.0;  // [px^2] c^2 of the kernel
constexpr double kInformation = 1.0 / (kPixelStd * kPixelStd);
// The prior at a new host is wide, so that the observations decide. It is not so wide that the
// depth is lost at a standstill, where the observations carry no information.
constexpr double kRehostStd = 3.0;
constexpr double kRehostMinStd = 0.05;

}  // namespace

void refine_inverse_depth(Track& track, const Window& window, const Eigen::Vector2d& focal_px,
                          int max_iterations) {
  const Se3 T_world_host = window[track.host].T_cam_world.inverse();
  const double prior_information = 1.0 / (track.prior_std * track.prior_std);
  double information = 0.0;
  for (int i = 0; i < max_iterations; ++i) {
    information = 0.0;
    double b = 0.0;
    for (const int slot : window.order()) {
      if (slot == track.host || !track.seen_in(slot)) continue;
      const Se3 T_frame_host = window[slot].T_cam_world * T_world_host;
      const PointInFrame p =
          transfer(T_frame_host, track.host_xy, track.rho, track.xy_in(slot), focal_px);
      if (!p.in_front) continue;
      const Eigen::Vector2d d = projection_jacobian(p.Y, focal_px) * T_frame_host.t;
      const double w = kInformation / (1.0 + p.residual_px.squaredNorm() / kDepthCauchy2);
      information += w * d.squaredNorm();
      b += w * d.dot(p.residual_px);
    }
    b += prior_information * (track.prior_rho - track.rho);
    const double step = b / (information + prior_information);
    track.rho += std::clamp(step, -0.5 * track.rho - 0.01, track.rho + 0.02);
    track.rho = std::max(track.rho, kMinRho);
    if (std::abs(step) < 1e-4 * track.rho) break;
  }
  track.rho_std = 1.0 / std::sqrt(information + prior_information);
}

bool inverse_depth_in(const Track& track, const Se3& T_frame_host, double* rho, double* rho_std) {
  const Eigen::Vector3d Y = transfer_point(T_frame_host, track.host_xy, track.rho);
  if (Y.z() < kMinDepthRatio) return false;
  *rho = std::max(track.rho / Y.z(), kMinRho);
  // With Yz = (R m)_z + rho tz, d(rho / Yz)/drho = (Yz - rho tz) / Yz^2.
  const double slope = std::abs(Y.z() - track.rho * T_frame_host.t.z()) / (Y.z() * Y.z());
  *rho_std = track.rho_std * slope;
  return true;
}

bool change_host(Track& track, int leaving, const Window& window) {
  for (const int slot : window.order()) {
    if (slot == leaving || !window[slot].is_keyframe() || !track.seen_in(slot)) continue;
    const Se3 T_new_old = window[slot].T_cam_world * window[leaving].T_cam_world.inverse();
    double rho = 0.0;
    double rho_std = 0.0;
    if (!inverse_depth_in(track, T_new_old, &rho, &rho_std)) return false;
    track.rho = rho;
    track.rho_std = rho_std;
    track.prior_rho = rho;
    track.prior_std = std::max(kRehostMinStd, kRehostStd * rho_std);
    track.host = slot;
    track.host_xy = track.xy_in(slot);
    return true;
  }
  return false;
}

}  // namespace plumb::vo
