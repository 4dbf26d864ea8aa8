/// Recognises a camera that stands still or only turns, and holds its position while it does.
///
/// The image motion that a fitted pose implies is compared with `vo.hold_flow_px`. The reference is the pose at which
/// zero motion began, so that creeping adds up until it is seen.
///
/// Frames   world: cam of the first frame.
/// Units    lengths in [vo], image motion in pixels.
/// Memory   one number per track, taken at construction.
#pragma once

#include <vector>

#include "core/camera_model.hpp"
#include "core/se3.hpp"
#include "modules/vo/local_map.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb::vo {

enum class ZeroMotion {
  kNone,         ///< the camera translates
  kTranslation,  ///< it turns on the spot
  kAll,          ///< it stands still
};

class ZeroMotionDetector {
 public:
  ZeroMotionDetector(const VoConfig& config, const CameraModel& camera);

  /// Judges the pose of the newest image. @pre the window is not empty
  [[nodiscard]] ZeroMotion judge(const LocalMap& map, const Se3& T_cam_world);
  /// The pose to report for the newest image. It is the held one; after kTranslation its rotation is fitted anew about
  /// the held camera centre. @pre judge() has just returned `kind`, which is not kNone
  [[nodiscard]] const Se3& hold(const LocalMap& map, const Se3& T_cam_world, ZeroMotion kind);
  /// The next zero motion begins with a reference of its own.
  void reset() { active_ = false; }

 private:
  [[nodiscard]] double flow_percentile(const LocalMap& map, const Se3& T_to_world,
                                       bool compensate_rotation);

  double max_flow_px_;
  CameraModel camera_;
  Eigen::Vector2d focal_px_;
  bool active_ = false;
  Se3 T_held_world_;  // where zero motion began
  std::vector<double> flow_px_;
};

}  // namespace plumb::vo
