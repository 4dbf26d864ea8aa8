/// The features of the newest image by kind: static, moving or attached to the camera.
///
/// A feature is static when the fitted pose explains its position, and moving when it is far from
/// doing so. With an uncertain depth almost any position is explained, so the kind is undecided as
/// long as the depth leaves more than a few pixels open. Attached is what has kept its place in the
/// image since its host keyframe although the camera has turned: the farthest point of the world
/// would have moved.
///
/// The kinds are for people who look at them. No estimate depends on them.
#pragma once

#include "core/camera_model.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

/// Collects the active tracks, in the order of the table, until `features` is full.
/// @param T_cam_world  fitted pose of the newest image
/// @pre the outliers of the fit have not been retired
void collect_features(const TrackTable& tracks, const Window& window, const Se3& T_cam_world,
                      const CameraModel& camera, FixedVector<Feature, kMaxFeatures>* features);

/// Adds the last `count` active tracks, of which no kind is known.
void add_undecided_features(const TrackTable& tracks, std::size_t count,
                            FixedVector<Feature, kMaxFeatures>* features);

}  // namespace plumb::vo
