/// Inputs and outputs of the ground estimator, and its status words.
///
/// Frames:
///   cam: x right, y down, z forward.
///   world: cam of the first image.
///   ground: x forward, y left, z up, on the road under the camera.
///   T_a_b maps b to a.
///   The plane is normal_cam . X = height; the normal points DOWN.
/// Units:
///   [vo] is VO's own unit of length; names that end in _m are metric.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/numbers.hpp"
#include "core/se3.hpp"
#include "modules/ground/types/camera_height.hpp"
#include "modules/ground/types/cue_measurements.hpp"
#include "modules/ground/types/cue_table.hpp"
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

inline constexpr std::size_t kMaxCueFeatures = 8;

/// What one cue reports about one frame. NaN where the cue does not observe a component.
struct CueReport {
  CueStatus status = CueStatus::kAbsent;
  double height = kNan;  ///< [vo]
  double n1 = kNan;
  double n3 = kNan;
  double height_var = kNan;  ///< [vo^2] of this frame alone
  double n1_var = kNan;
  double n3_var = kNan;
  double quality = 0.0;  ///< [0, 1]
  /// Measured minus predicted (n1, n3, ln height) when the filter fused it; NaN where not observed.
  Eigen::Vector3d innovation = Eigen::Vector3d::Constant(kNan);
  /// Normalised innovation squared over its gate: above 1 the filter rejected the cue. NaN when the
  /// cue was not tested.
  double test_ratio = kNan;
  /// What the cue's covariance was predicted from, as its own algorithm defines it; in process
  /// only, for training and tests. Published method: widths of the slices in h, n1, n3 (dense),
  /// score of the vote (points). Both methods: the variance by the boxes alone (objects).
  std::array<double, kMaxCueFeatures> features{};
  int num_features = 0;
};

/// One entry for each cue of kCueTable.
using CueReports = std::array<CueReport, kNumCues>;

struct DetectionFrame;

/// Boxes whose turn it is, for an algorithm that reads them by itself.
struct DueDetections {
  const DetectionFrame* frame = nullptr;  ///< null: none
  /// Turns from the camera in their image to the camera in the newest one.
  Eigen::Matrix3d R_newest_due = Eigen::Matrix3d::Identity();
};

struct GroundInput {
  const VoOutput* vo = nullptr;  ///< never null
  ImageView image;               ///< image of vo->seq; empty when it did not arrive
  std::span<const ObjectsMeasurement> objects = {};  ///< of the same image (objects_queue.hpp)
  CameraHeight camera_height = {};                   ///< height_m 0: as configured or calibrated
  bool is_height_correction = false;  ///< a new height is better known; false: the body has moved
  DueDetections due = {};             ///< what `objects` was measured from
};

/// The plane of the road ahead (`GroundConfig::road_near_m` to `road_far_m`).
struct PlaneOutput {
  GroundStatus status = GroundStatus::kInvalid;
  GroundReason reason = GroundReason::kNone;
  // The following are NaN unless kOk or kHeld.
  Eigen::Vector3d normal_cam = Eigen::Vector3d::Constant(kNan);  ///< unit, down
  double height_m = kNan;
  double pitch_rad = kNan;                                ///< nose DOWN positive (ISO 8855)
  double roll_rad = kNan;                                 ///< right side down positive
  Eigen::Matrix3d cov = Eigen::Matrix3d::Constant(kNan);  ///< of (pitch, roll, ln height)
  CueReports cues{};
};

/// What is not measured is NaN, never 0.
struct EgoOutput {
  EgoStatus status = EgoStatus::kLost;
  VoReason reason = VoReason::kNone;
  std::int32_t reset_counter = 0;
  Se3 T_prev_cam;                                    ///< [m]
  Matrix6d cov_prev_cam = Matrix6d::Constant(kNan);  ///< of (t, right perturbation of R)
  Eigen::Vector3d velocity_ground_m_s = Eigen::Vector3d::Constant(kNan);
  double speed_std_m_s = kNan;
  Eigen::Vector3d rate_ground_rad_s =
      Eigen::Vector3d::Constant(kNan);  ///< z: yaw rate, left positive
  double yaw_rate_std_rad_s = kNan;
  double accel_forward_m_s2 = kNan;  ///< NaN when not observable, too
  double accel_forward_std_m_s2 = kNan;
  Se3 T_world_cam;                            ///< [m]
  Matrix6d cov_world_cam = Matrix6d::Zero();  ///< of (t in world, right perturbation of R)
  double distance_m = 0.0;
  double log_scale = kNan;  ///< ln(metres per [vo])
  double log_scale_std = kNan;
  /// The step over the road in heights of the camera, which no stated height enters; NaN unless
  /// both were measured.
  double road_step_heights = kNan;
  double road_step_ln_var = kNan;  ///< of its logarithm

  EgoOutput() { T_prev_cam.t.setConstant(kNan); }
};

struct GroundOutput {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  PlaneOutput plane;
  EgoOutput ego;
};

}  // namespace plumb
