/// Chooses the labels of an evaluation and the box that belongs to a label.
#pragma once

#include <string>
#include <vector>

#include "modules/detections/detection.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"

namespace plumb {

inline constexpr double kClose_m =
    10.0;  ///< up to here an object is close, as in section 6.4 of the paper

/// Whether the label has a 3D box and one of `classes`, is whole in the image and at most partly
/// hidden.
[[nodiscard]] bool is_evaluated(const TrackingRow& row, const std::vector<ObjectClass>& classes);

/// The label's own box, or the tracker's box that overlaps it most. Null when none overlaps by at
/// least half.
[[nodiscard]] const Detection* box_of(const TrackingRow& label, const DetectionFrame& frame,
                                      bool labels_are_boxes);

}  // namespace plumb
