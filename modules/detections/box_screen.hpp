/// Selects the boxes that tell something about the road: those that are whole, visible, on the road
/// and not too far away.
///
/// Frames:
///   img as in detection.hpp; ground as in road_plane.hpp.
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
  kClassUnknown = 1,  ///< the class has no known height
  kLowScore = 2,
  kTooSmall = 3,
  kTruncated = 4,     ///< the detector says so, or the box ends at the border of the image
  kOccluded = 5,      ///< the detector says so, or nearer boxes hide an edge
  kOffRoad = 6,       ///< the foot is above the horizon, too far away or too far to the side
  kAgainstPlane = 7,  ///< its height over time fits no object of its class on the road
  kOutlier = 8,       ///< the box contradicts the other boxes of its frame
  kNoRoom = 9,        ///< the height filter has no slot left
};

using Verdicts = std::array<BoxVerdict, kMaxDetections>;

/// Shares of a box's lower and upper edge that nearer boxes cover, in [0, 1]. The box with the
/// lower bottom edge is the nearer one.
struct HiddenEdges {
  double lower_ratio = 0.0;
  double upper_ratio = 0.0;
};
[[nodiscard]] HiddenEdges hidden_edges(const DetectionFrame& frame, std::size_t box);

/// The sides on which a box ends within `border_px` of the image's border.
struct CutSides {
  bool left = false;
  bool top = false;
  bool right = false;
  bool bottom = false;
  [[nodiscard]] bool any() const { return left || top || right || bottom; }
};
[[nodiscard]] CutSides cut_sides(const CameraModel& camera, const Box& box, double border_px);

/// Decides for every detection of the frame whether it is used and, if not, why. `plane` is the
/// prediction for this frame; its covariance widens the horizon test.
void screen_boxes(const DetectionsConfig& config, const CameraModel& camera, const RoadPlane& plane,
                  const DetectionFrame& frame, Verdicts* verdicts);

}  // namespace plumb
