/// Turns the integrated poses of images into rows of a KITTI pose file.
#pragma once

#include <string>

#include "modules/datasets/kitti/pose_file.hpp"
#include "plumb/ego_motion_t.hpp"

namespace plumb {

/// One row per image. An image without a valid pose repeats the row before it. Before the first
/// valid pose, rows are the identity.
class PoseTrack {
 public:
  /// `ego` may be null. Returns the row.
  std::string row(const ego_motion_t* ego);

 private:
  PoseMatrix T_world_cam_ = PoseMatrix::Identity();
};

}  // namespace plumb
