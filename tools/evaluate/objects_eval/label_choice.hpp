/// Which labels an evaluation takes, and which box belongs to a label.
#pragma once

#include <string>
#include <vector>

#include "modules/detections/detection.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"

namespace plumb {

inline constexpr double kClose_m = 10.0;  ///< and nearer is close, as in the paper's section 6.4

/// Labels with a 3D box, of one of `classes`, whole in the image and at most partly hidden.
[[nodiscard]] bool is_evaluated(const TrackingRow& row, const std::vector<ObjectClass>& classes);

/// The box of a label: its own, or the tracker's that overlaps it most, by half at least. Null when there is none.
[[nodiscard]] const Detection* box_of(const TrackingRow& label, const DetectionFrame& frame,
                                      bool labels_are_boxes);

}  // namespace plumb
