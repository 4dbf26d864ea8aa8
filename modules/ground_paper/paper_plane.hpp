/// The plane and the scale that the published method reports, from its filter.
///
/// Units:
///   Metres.
#pragma once

#include "modules/ground/ego/ego_motion.hpp"
#include "modules/ground/types/ground_types.hpp"
#include "modules/ground_paper/plane_kalman.hpp"

namespace plumb {

/// What one frame brought.
struct PaperFrame {
  VoStatus vo_status = VoStatus::kLost;
  bool has_image = false;
  bool measurable = false;   ///< there was an older image at a distance that shows depth
  bool measured = false;     ///< a height was fused
  double height_m = 0.0;     ///< fused observation at the corrected scale; measured only
  double height_var = 0.0;   ///< its variance over the square of h*
  double var_before = 0.0;   ///< of h, before the cues
  double metres_per_vo = 0;  ///< scale that the cues' heights refer to
};

/// Fills everything but the cues. `filter` is null before it has started; h* is the camera's
/// height.
void write_plane(const PlaneKalman* filter, const PaperFrame& frame, double camera_height_m,
                 PlaneOutput* plane);

/// @pre filter has started
[[nodiscard]] ScaleEstimate paper_scale(const PlaneKalman& filter, const PaperFrame& frame,
                                        double metres_per_vo, double camera_height_m);

}  // namespace plumb
