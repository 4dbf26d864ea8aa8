/// What the path alone says about the road: the camera moves along it, so the plane's normal stands
/// on the chord.
///
/// Frames  cam: x right, y down, z forward, of the newest image.
/// Units   [vo]; curvature in 1/[vo], positive in a right turn.
#pragma once

#include <Eigen/Core>

#include "modules/vo/vo.hpp"

namespace plumb {

struct Travel {
  bool valid = false;
  double step = 0.0;                                     ///< |t| of this frame [vo]
  int num_chord_frames = 0;                              ///< images between the chord's ends
  double chord_length = 0.0;                             ///< [vo]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< along the chord, in cam now
  double curvature = 0.0;                                ///< of the path, seen from above
};

/// Chord over about `kChordFrames` images out of the refined window. @pre vo.status is one that
/// moves
[[nodiscard]] Travel measure_travel(const VoOutput& vo);

/// The unit normal with sideways part `n1` that is perpendicular to `direction` (n . t = 0).
[[nodiscard]] Eigen::Vector3d normal_across(const Eigen::Vector3d& direction, double n1);

}  // namespace plumb
