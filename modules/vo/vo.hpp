/// Monocular visual odometry: keyframe-anchored inverse-depth tracks and a windowed refinement.
///
/// Pure algorithm: no clock, no I/O, no heap after construction. `main.cpp` is the process around
/// it.
///
/// Frames   cam: x right, y down, z forward.  T_a_b maps b to a.
/// Units    lengths in VO's own, slowly drifting unit [vo]; `scale_epoch` names it. Pixels in img,
/// radians, seconds. Memory   everything is sized by VoConfig and the camera's image size at
/// construction.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "core/image_view.hpp"
#include "core/se3.hpp"
#include "core/stage_probe.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb {

inline constexpr std::size_t kMaxRoadPoints = 384;
inline constexpr std::size_t kMaxWindowPoses = 12;

/// Same numbers as vo_motion_t.STATUS_* (asserted in vo_wire.cpp).
enum class VoStatus : std::int8_t {
  kOk = 0,
  kInitializing = 1,
  kStandstill = 2,
  kRotationOnly = 3,
  kCoasting = 4,
  kLost = 5,
};

/// Same numbers as vo_motion_t.REASON_*.
enum class VoReason : std::int8_t {
  kNone = 0,
  kFirstFrame = 1,
  kLowParallax = 2,
  kTooFewFeatures = 3,
  kTooFewInliers = 4,
  kImageDark = 5,
  kImageFlat = 6,
  kImageFrozen = 7,
  kFramesMissing = 8,
  kTimeBackwards = 9,
  kNoCalibration = 10,
  kRestarted = 11,
};

struct VoInput {
  std::int64_t capture_us = 0;  ///< mid-exposure
  std::int64_t seq = 0;         ///< +1 per captured frame; a gap is a lost frame
  ImageView image;              ///< grey, size of the camera model; need not outlive the call
};

struct WindowPose {
  std::int64_t seq = 0;
  Se3 T_window_cam;  ///< cam now -> cam of frame `seq`, [vo]
};

/// A triangulated point below the horizon. Floats, because that is what travels: replay sees live's
/// bits.
struct RoadPoint {
  Eigen::Vector3f p_cam = Eigen::Vector3f::Zero();  ///< [vo]
  Eigen::Vector2f px = Eigen::Vector2f::Zero();     ///< where it is seen in the newest image
  float rel_std = 0.0F;                             ///< 1-sigma of ln depth
  std::int16_t num_obs = 0;
};

struct VoOutput {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  VoStatus status = VoStatus::kLost;
  VoReason reason = VoReason::kNone;
  std::int32_t scale_epoch = 0;
  double scale_carry_std =
      0.0;  ///< 1-sigma of ln(unit now / unit of the previous epoch); NaN when unknown

  std::int64_t prev_seq = -1;
  Se3 T_prev_cam;                            ///< [vo]
  Matrix6d cov_prev_cam = Matrix6d::Zero();  ///< of (t, right-perturbation of R)

  FixedVector<WindowPose, kMaxWindowPoses> window;  ///< newest first

  int num_tracked = 0;
  int num_inliers = 0;
  int num_new = 0;
  bool is_keyframe = false;
  double median_flow_px = 0.0;
  double median_parallax_px = 0.0;
  double rms_residual_px = 0.0;

  FixedVector<RoadPoint, kMaxRoadPoints> road_points;
};

/// One `update` per image, in order. Deterministic in config, camera, seed and the inputs.
class VisualOdometry {
 public:
  /// @pre config inside the ranges of its visit(); camera.width_px, height_px >= 64
  VisualOdometry(const VoConfig& config, const CameraModel& camera, std::uint64_t seed);
  ~VisualOdometry();
  VisualOdometry(const VisualOdometry&) = delete;
  VisualOdometry& operator=(const VisualOdometry&) = delete;

  /// Takes one image. The result stays valid until the next call.
  const VoOutput& update(const VoInput& input, StageProbe& probe);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
