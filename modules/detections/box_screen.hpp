/// Which boxes may speak about the road: whole, visible, standing on it and not too far off.
///
/// Frames   img as in detection.hpp; ground as in road_plane.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "core/camera_model.hpp"
#include "modules/detections/detection.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/detections/road_plane.hpp"

namespace plumb {

enum class BoxVerdict : std::int8_t {
  kUsed = 0,
  kClassUnknown = 1,  ///< no height is known for it
  kLowScore = 2,
  kTooSmall = 3,
  kTruncated = 4,     ///< said so, or the box ends at the image's border
  kOccluded = 5,      ///< said so, or nearer boxes hide an edge
  kOffRoad = 6,       ///< foot above the horizon, too far away or too far to the side
  kAgainstPlane = 7,  ///< over time its height fits no object of its class that stands on the road
  kOutlier = 8,       ///< contradicts the other boxes of this frame
  kNoRoom = 9,
};

using Verdicts = std::array<BoxVerdict, kMaxDetections>;

/// Shares, 0 to 1, of a box's lower and upper edge that nearer boxes cover; nearer is whose own
/// lower edge lies lower.
struct HiddenEdges {
  double lower_ratio = 0.0;
  double upper_ratio = 0.0;
};
[[nodiscard]] HiddenEdges hidden_edges(const DetectionFrame& frame, std::size_t box);

/// True when `box` ends within `border_px` of the image's border on that side.
struct CutSides {
  bool left = false;
  bool top = false;
  bool right = false;
  bool bottom = false;
  [[nodiscard]] bool any() const { return left || top || right || bottom; }
};
[[nodiscard]] CutSides cut_sides(const CameraModel& camera, const Box& box, double border_px);

/// kUsed or why not, for every detection of the frame. `plane` is what is expected before this frame;
/// its covariance widens the horizon test.
void screen_boxes(const DetectionsConfig& config, const CameraModel& camera, const RoadPlane& plane,
                  const DetectionFrame& frame, Verdicts* verdicts);

}  // namespace plumb
