/// The plane that GROUND_PLANE reports: the road ahead, from the filter and this frame's cues.
///
/// Frames:
///   cam: x right, y down, z forward; the normal points down.
/// Units:
///   Metres.
#pragma once

#include "modules/ground/cues/cue.hpp"
#include "modules/ground/filter/plane_filter.hpp"

namespace plumb {

/// What a frame brought, besides the filter.
struct PlaneEvidence {
  VoStatus vo_status = VoStatus::kLost;
  bool has_image = false;
  bool measurable = false;        ///< FramePrior::measurable
  bool height_measured = false;   ///< a cue of the height was fused
  bool height_rejected = false;   ///< the gate rejected one
  HeightMeasurement height_seen;  ///< mean of the fused cues' heights; height_measured only
  PlaneVariance added;            ///< variance on top of the filter's
  CameraHeight camera_height;
};

/// Fills everything but the cues.
///
/// height_m is the height that this frame's cues measured along the fused normal, at the filtered
/// scale. It equals the camera's height when the frame agrees with the filter and the road is flat;
/// it differs by the road's bend and by the cues' noise.
void write_plane(const PlaneFilter& filter, const PlaneEvidence& evidence, PlaneOutput* plane);

}  // namespace plumb
