/// Detects a camera that stands still or turns on the spot, and keeps its position constant.
///
/// Without translation, the scale and the depths are not observable, and a small fitted translation
/// would be noise that adds up to drift. The detector predicts the image motion of the tracks that
/// a fitted pose implies. While the part that is due to translation stays below vo.hold_flow_px,
/// the translation is zero. The reference is the pose at which zero motion began, so that a
/// creeping camera moves away from it and is detected.
///
/// Frames:
///   world: cam of the first image.
/// Units:
///   Lengths in [vo], image motion in pixels.
/// Memory:
///   One number per track, allocated by the constructor.
#pragma once

#include <vector>

#include "core/camera_model.hpp"
#include "core/se3.hpp"
#include "modules/vo/local_map.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb::vo {

enum class ZeroMotion {
  kNone,         ///< the camera translates
  kTranslation,  ///< the translation is zero: it turns on the spot
  kAll,          ///< translation and rotation are zero: it stands still
};

class ZeroMotionDetector {
 public:
  ZeroMotionDetector(const VoConfig& config, const CameraModel& camera);

  /// Returns which parts of the motion to the newest image are zero, by its fitted pose.
  /// @pre the window is not empty
  [[nodiscard]] ZeroMotion judge(const LocalMap& map, const Se3& T_cam_world);
  /// Returns the pose of the newest image without the motion that is zero. After kAll it is the
  /// reference. After kTranslation the reference is rotated: the rotation about its camera centre
  /// is fitted to the tracks. @pre judge() has just returned `kind`, which is not kNone
  [[nodiscard]] const Se3& hold(const LocalMap& map, const Se3& T_cam_world, ZeroMotion kind);
  /// Drops the reference. The next zero motion begins with a reference of its own.
  void reset() { active_ = false; }

 private:
  [[nodiscard]] double flow_percentile(const LocalMap& map, const Se3& T_to_world,
                                       bool compensate_rotation);

  double max_flow_px_;
  CameraModel camera_;
  Eigen::Vector2d focal_px_;
  bool active_ = false;  // the last pose had zero motion, and T_ref_world_ is valid
  Se3 T_ref_world_;      // pose at which zero motion began
  std::vector<double> flow_px_;
};

}  // namespace plumb::vo
