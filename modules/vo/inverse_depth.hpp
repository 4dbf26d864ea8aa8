/// Inverse depth of one track from its observations, poses held.
#pragma once

#include <Eigen/Core>

#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Gauss-Newton over rho with Cauchy weights and the track's prior; sets rho and rho_std.
void refine_inverse_depth(Track& track, const Window& window, const Eigen::Vector2d& focal_px,
                          int max_iterations);

/// rho and its deviation in another frame of the window. False when the point is behind it.
[[nodiscard]] bool inverse_depth_in(const Track& track, const Se3& T_frame_host, double* rho,
                                    double* rho_std);

/// Moves the host of `track` from `leaving` to the next keyframe that saw it. False when there is none: the track
/// has lost its depth.
[[nodiscard]] bool change_host(Track& track, int leaving, const Window& window);

}  // namespace plumb::vo
