/// Direction of translation over a chord of the camera's path: the camera moves parallel to the
/// road, so that the plane's normal is perpendicular to the chord. A car that reverses moves along
/// the same line: the direction points ahead all the same.
///
/// Frames:
///   cam: x right, y down, z forward, of the newest image.
/// Units:
///   [vo]; curvature in 1/[vo], positive in a right turn.
#pragma once

#include <Eigen/Core>

#include "modules/ground/types/cue_measurements.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

/// The chord over about `kChordFrames` images of VO's refined window. @pre VO's status says that
/// vo.T_prev_cam is a motion
[[nodiscard]] Chord measure_chord(const VoOutput& vo);

/// The unit normal with sideways part `n1` that is perpendicular to `direction`.
[[nodiscard]] Eigen::Vector3d normal_across(const Eigen::Vector3d& direction, double n1);

}  // namespace plumb
