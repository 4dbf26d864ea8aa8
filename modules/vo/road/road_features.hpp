/// Contrast across the direction of travel on the road ahead: ends of lane marks, cracks, patches
/// and texture.
///
/// The feature of a cell is the second difference of the smoothed grey values along the road. Two
/// weights keep it between -1 and 1: one for its size against a noise of one grey level, so that a
/// dark road counts as much as a bright one, and one against contrast along the road, because kerbs
/// and continuous lines look the same wherever the car is on them.
///
/// Frames:
///   cam: x right, y down, z forward.
/// Units:
///   Grey levels in, [-] out. Lengths in heights of the camera.
/// Memory:
///   Three grids, in place.
#pragma once

#include <Eigen/Core>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "modules/vo/road/road_grid.hpp"

namespace plumb::vo {

class RoadFeatures {
 public:
  explicit RoadFeatures(const CameraModel& camera) : camera_(camera) {}

  /// Fills `features` with those of `image`; 0 where the image does not show the road.
  /// @param direction  of travel in cam, as (x/z, y/z): the road's normal is perpendicular to it
  void find(const ImageView& image, const Eigen::Vector2d& direction, RoadGrid* features);

 private:
  void sample(const ImageView& image, const Eigen::Vector2d& direction);
  void smooth();
  void difference(RoadGrid* features) const;

  CameraModel camera_;
  RoadGrid grey_{};  // NaN outside of the image
  RoadGrid smoothed_{};
  RoadGrid along_{};  // smoothed along the road only
};

}  // namespace plumb::vo
