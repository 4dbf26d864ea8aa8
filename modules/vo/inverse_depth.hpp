/// Inverse depth of one track from its observations, with constant poses.
///
/// Units:
///   rho in 1/[vo], pixels.
#pragma once

#include <Eigen/Core>

#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Estimates rho and rho_std from all observations and the track's prior, by Gauss-Newton with
/// Cauchy weights.
void refine_inverse_depth(Track& track, const Window& window, const Eigen::Vector2d& focal_px,
                          int max_iterations);

/// Converts rho and its standard deviation to another frame. Returns false when the point is behind
/// that frame.
[[nodiscard]] bool inverse_depth_in(const Track& track, const Se3& T_frame_host, double* rho,
                                    double* rho_std);

/// Makes the next keyframe that saw `track` its host instead of the one in slot `leaving`. Returns
/// false when there is none, or when the point is behind it; the track is then useless.
[[nodiscard]] bool change_host(Track& track, int leaving, const Window& window);

}  // namespace plumb::vo
