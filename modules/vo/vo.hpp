/// Monocular visual odometry.
///
/// Corners are tracked from image to image. Each has its inverse depth in the keyframe that first
/// saw it, and a sliding window of frames is refined by bundle adjustment. The steps are those of
/// pipeline.hpp. The library has no clock and no input or output; VoNode connects it to messages.
///
/// Frames:
///   cam: x right, y down, z forward, origin at the optical centre.
///   img: u right, v down, pixels; (0,0) is the centre of the upper left pixel.
///   T_a_b maps coordinates in b to coordinates in a.
/// Units:
///   Lengths in a unit of visual odometry's own, [vo], which drifts slowly. `scale_epoch` counts
///   the times that this unit was lost. Pixels, radians, seconds.
/// Memory:
///   Everything is sized by VoConfig and the size of the image, and allocated by the constructor.
/// Errors:
///   A failure is a status with a reason. The next image is always accepted.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/camera_model.hpp"
#include "core/fixed_vector.hpp"
#include "core/image_view.hpp"
#include "core/numbers.hpp"
#include "core/se3.hpp"
#include "core/stage_probe.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb {

namespace vo {
class AttachedRegions;
}

inline constexpr std::size_t kMaxRoadPoints = 384;
inline constexpr std::size_t kMaxWindowPoses = 12;
inline constexpr std::size_t kMaxFeatures = 1000;

/// The numbers are those of vo_motion_t.STATUS_*, which explains them.
enum class VoStatus : std::int8_t {
  kOk = 0,
  kInitializing = 1,
  kStandstill = 2,
  kRotationOnly = 3,
  kCoasting = 4,
  kLost = 5,
};

/// The numbers are those of vo_motion_t.REASON_*.
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
  kImageRepeated = 12,
  kImageStale = 13,
  kImageTorn = 14,
  kImagePartlyFrozen = 15,
  kImageMirrored = 16,
  kImageUpsideDown = 17,
  kImageUnproven = 18,
  kTimeStarting = 19,
  kTimeStalled = 20,
  kTimeDoubted = 21,
  kTimeForward = 22,
  kTimeUnit = 23,
  kMotionMissing = 24,
  kImplausible = 25,
  kCalibrationDoubted = 26,
  kOrientationUnproven = 27,
  kRoadMotion = 28,
};

/// The numbers are those of vo_motion_t.FEATURE_*, which explains them.
enum class FeatureKind : std::int8_t {
  kUndecided = 0,
  kStatic = 1,
  kMoving = 2,
  kAttached = 3,
};

struct VoInput {
  std::int64_t capture_us = 0;  ///< mid-exposure; handed on and not used
  std::int64_t seq = 0;         ///< increases by one per captured frame
  ImageView image;              ///< grey, of the camera's size; it is not used after the call
  /// [s] Best guess of the time since the previous image, > 0; it is not used for the first one.
  double interval_s = 0.1;
  /// Nothing is known of the motion since the previous image, for example because the camera was
  /// restarted: then visual odometry begins anew, with a unit of its own.
  bool is_discontinuous = false;
  /// Why the image must not be used: then the motion is predicted. kNone for a usable image.
  VoReason unusable = VoReason::kNone;
};

/// Pose of an earlier frame as it is refined now.
struct WindowPose {
  std::int64_t seq = 0;  ///< of the earlier frame
  Se3 T_window_cam;      ///< [vo] from cam of the newest image to cam of the earlier one
};

/// A triangulated point below the horizon. The numbers are floats as in vo_motion_t, so that the
/// message does not change them.
struct RoadPoint {
  Eigen::Vector3f p_cam = Eigen::Vector3f::Zero();  ///< [vo]
  Eigen::Vector2f px = Eigen::Vector2f::Zero();     ///< position in the newest image
  float rel_std = 0.0F;                             ///< standard deviation of ln depth
  std::int16_t num_obs = 0;                         ///< number of images that saw the point
};

/// A feature in the newest image.
struct Feature {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  FeatureKind kind = FeatureKind::kUndecided;
};

struct VoOutput {
  std::int64_t capture_us = 0;
  std::int64_t capture_mono_us = 0;  ///< the same on CLOCK_MONOTONIC; 0 while unknown
  std::int64_t seq = 0;
  std::int64_t session = 0;  ///< of the sender; 0 in a replay
  VoStatus status = VoStatus::kLost;
  VoReason reason = VoReason::kNone;
  std::int32_t scale_epoch = 0;
  /// Standard deviation of ln(unit now / unit of the previous epoch), in the frame that begins a
  /// new epoch; NaN when the ratio is not known. 0 in all other frames.
  double scale_carry_std = 0.0;

  std::int64_t prev_seq = -1;                ///< of the previous image; -1 for the first one
  double interval_s = kNan;                  ///< from it to this image; NaN while in doubt
  double interval_std_s = 0.0;               ///< of the interval, by the jitter of the stamps
  Se3 T_prev_cam;                            ///< [vo] from cam now to cam of the previous image
  Matrix6d cov_prev_cam = Matrix6d::Zero();  ///< of (t, right perturbation of R)

  FixedVector<WindowPose, kMaxWindowPoses> window;  ///< newest first

  int num_tracked = 0;              ///< features tracked into this image
  int num_inliers = 0;              ///< number of those that agree with the pose
  int num_new = 0;                  ///< features first seen in this image
  bool is_keyframe = false;         ///< this image became a keyframe
  double median_flow_px = 0.0;      ///< from the previous image
  double median_parallax_px = 0.0;  ///< rotation-compensated, from the last keyframe
  double rms_residual_px = 0.0;     ///< of the inliers
  double attached_share = 0.0;      ///< of the image: attached to the camera, and not searched

  FixedVector<RoadPoint, kMaxRoadPoints> road_points;
  FixedVector<Feature, kMaxFeatures> features;

  /// [vo] Height of the camera above the road, by the speed at which the road passes; NaN while
  /// that is not seen.
  double road_height = kNan;
  double road_height_std = kNan;
};

/// Call update() once per image, in order of time. The results depend on nothing but configuration,
/// camera, seed and images.
class VisualOdometry {
 public:
  /// @param seed  seed of the random samples in RANSAC
  /// @pre config is inside the ranges of its visit(); camera.width_px, height_px >= 64
  VisualOdometry(const VoConfig& config, const CameraModel& camera, std::uint64_t seed);
  ~VisualOdometry();
  VisualOdometry(const VisualOdometry&) = delete;
  VisualOdometry& operator=(const VisualOdometry&) = delete;

  /// Processes one image. The result is valid until the next call.
  const VoOutput& update(const VoInput& input, StageProbe& probe);

  /// What is known of the regions that are attached to the camera, to keep it over restarts.
  [[nodiscard]] vo::AttachedRegions& attached();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
