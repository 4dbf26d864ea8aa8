/// What the ground estimator takes and gives: its states, cues' observations, inputs and outputs.
///
/// Frames   cam: x right, y down, z forward.  ground: x forward, y left, z up, on the road under the camera.
///          world: cam of the first image.  T_a_b maps b to a.  Plane: normal_cam . X = height, n points DOWN.
/// Units    [vo] is VO's own unit; names that end in _m are metric.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/se3.hpp"
#include "modules/ground/types/ground_config.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

/// Same numbers as ground_plane_t.STATUS_*.
enum class GroundStatus : std::int8_t { kOk = 0, kInitializing = 1, kHeld = 2, kInvalid = 3 };

/// Same numbers as ground_plane_t.REASON_*.
enum class GroundReason : std::int8_t {
  kNone = 0,
  kVoNotReady = 1,
  kStandstill = 2,
  kLowBaseline = 3,
  kNoCue = 4,
  kCuesRejected = 5,
  kImageMissing = 6,
  kVoLost = 7,
  kNoCalibration = 8,
};

/// Same numbers as ego_motion_t.STATUS_*.
enum class EgoStatus : std::int8_t {
  kOk = 0,
  kInitializing = 1,
  kScaleHeld = 2,
  kStandstill = 3,
  kCoasting = 4,
  kLost = 5,
};

/// Same numbers as ground_cue_t.status.
enum class CueStatus : std::int8_t { kUsed = 0, kAbsent = 1, kGated = 2, kFailed = 3 };

enum CueId : std::size_t { kCueDense = 0, kCuePoints = 1, kCueObjects = 2, kNumCues = 3 };

inline constexpr std::size_t kMaxCueFeatures = 8;

/// One cue's observation. NaN where the cue does not observe a component.
struct CueObservation {
  CueStatus status = CueStatus::kAbsent;
  double height = 0.0;  ///< [vo]
  double n1 = 0.0;
  double n3 = 0.0;
  double height_var = 0.0;  ///< [vo^2]
  double n1_var = 0.0;
  double n3_var = 0.0;
  double quality = 0.0;  ///< [0, 1]
  /// What the cue's covariance was predicted from, as its own algorithm defines it; in process only,
  /// for learning and tests. Paper mode: widths of the slices in h, n1, n3 (dense), the vote's score
  /// (points). Both modes: the variance by the boxes alone (objects).
  std::array<double, kMaxCueFeatures> features{};
  int num_features = 0;
};

/// Of a cue that did not look, with NaN for everything that it would observe.
[[nodiscard]] CueObservation absent_cue();

/// The calibration's where it states one.
[[nodiscard]] double camera_height_of(const GroundConfig& config, const CameraModel& camera);

/// The camera's pitch out of detected objects.
struct ObjectNormal {
  double n3 = 0.0;
  double n3_var = 0.0;   ///< > 0
  double belief = 0.0;   ///< what n3_var was predicted from: the variance by the boxes alone
  double quality = 0.0;  ///< [0, 1]
};

struct GroundInput {
  const VoOutput* vo = nullptr;                ///< never null
  ImageView image;                             ///< image of vo->seq; empty when it did not arrive
  std::span<const ObjectNormal> objects = {};  ///< brought to the same image (object_pitch.hpp)
};

/// The plane of the road ahead (`GroundConfig::road_near_m` to `road_far_m`).
struct PlaneOutput {
  GroundStatus status = GroundStatus::kInvalid;
  GroundReason reason = GroundReason::kNone;
  Eigen::Vector3d normal_cam = Eigen::Vector3d::Zero();  ///< unit, down; kOk, kHeld only
  double height_m = 0.0;                                 ///< kOk, kHeld only
  double pitch_rad = 0.0;                                ///< nose DOWN positive (ISO 8855)
  double roll_rad = 0.0;                                 ///< right side down positive
  Eigen::Matrix3d cov = Eigen::Matrix3d::Zero();         ///< of (pitch, roll, ln height)
  std::array<CueObservation, kNumCues> cues{};
};

struct EgoOutput {
  EgoStatus status = EgoStatus::kLost;
  VoReason reason = VoReason::kNone;
  std::int32_t reset_counter = 0;
  Se3 T_prev_cam;                            ///< [m]
  Matrix6d cov_prev_cam = Matrix6d::Zero();  ///< of (t, right-perturbation of R)
  Eigen::Vector3d velocity_ground_m_s = Eigen::Vector3d::Zero();
  double speed_std_m_s = 0.0;
  Eigen::Vector3d rate_ground_rad_s = Eigen::Vector3d::Zero();  ///< z: yaw rate, left positive
  double yaw_rate_std_rad_s = 0.0;
  double accel_forward_m_s2 = 0.0;  ///< NaN when not observable
  double accel_forward_std_m_s2 = 0.0;
  Se3 T_world_cam;                            ///< [m]
  Matrix6d cov_world_cam = Matrix6d::Zero();  ///< of (t in world, right-perturbation of R)
  double distance_m = 0.0;
  double log_scale = 0.0;  ///< ln(metres per [vo])
  double log_scale_std = 0.0;
};

struct GroundOutput {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  PlaneOutput plane;
  EgoOutput ego;
};

}  // namespace plumb
