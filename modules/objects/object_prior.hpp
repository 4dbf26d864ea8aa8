/// Turns a detection into a measurement of its edges and into the prior of a new object.
///
/// Frames:
///   img as in detection.hpp; ground as in track_view.hpp.
/// Source:
///   Song and Chandraker, CVPR 2014, section 3: priors on the size of a class.
#pragma once

#include <cstddef>

#include "modules/detections/detection.hpp"
#include "modules/objects/box_fit.hpp"
#include "modules/objects/track_view.hpp"

namespace plumb {

/// Mean and standard deviation of the height of a class, also for objects without a class.
[[nodiscard]] HeightPrior height_prior(const TrackView& view, ObjectClass object_class);

/// How far inside its outline an object of this class touches the road.
[[nodiscard]] Contact contact_of(const ObjectsConfig& config, ObjectClass object_class);

/// The edges of a detection's box and their variances.
/// An edge that nearer boxes hide has a larger variance.
[[nodiscard]] MeasuredBox measured_box(const DetectionsConfig& config, const CameraModel& camera,
                                       const DetectionFrame& frame, std::size_t index);

/// True when the image cuts no edge of the box.
[[nodiscard]] bool is_whole(const MeasuredBox& box);

/// The prior of a new object with this box and the heading `yaw_rad`.
[[nodiscard]] StateEstimate prior_of(const TrackView& view, const Detection& detection,
                                     const MeasuredBox& box, double yaw_rad);

}  // namespace plumb
