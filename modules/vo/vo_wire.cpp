#include "modules/vo/vo_wire.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/pose_wire.hpp"
#include "core/same_value.hpp"

namespace plumb {
namespace {

static_assert(same(VoStatus::kOk, vo_motion_t::STATUS_OK));
static_assert(same(VoStatus::kInitializing, vo_motion_t::STATUS_INITIALIZING));
static_assert(same(VoStatus::kStandstill, vo_motion_t::STATUS_STANDSTILL));
static_assert(same(VoStatus::kRotationOnly, vo_motion_t::STATUS_ROTATION_ONLY));
static_assert(same(VoStatus::kCoasting, vo_motion_t::STATUS_COASTING));
static_assert(same(VoStatus::kLost, vo_motion_t::STATUS_LOST));
static_assert(same(VoReason::kNone, vo_motion_t::REASON_NONE));
static_assert(same(VoReason::kFirstFrame, vo_motion_t::REASON_FIRST_FRAME));
static_assert(same(VoReason::kLowParallax, vo_motion_t::REASON_LOW_PARALLAX));
static_assert(same(VoReason::kTooFewFeatures, vo_motion_t::REASON_TOO_FEW_FEATURES));
static_assert(same(VoReason::kTooFewInliers, vo_motion_t::REASON_TOO_FEW_INLIERS));
static_assert(same(VoReason::kImageDark, vo_motion_t::REASON_IMAGE_DARK));
static_assert(same(VoReason::kImageFlat, vo_motion_t::REASON_IMAGE_FLAT));
static_assert(same(VoReason::kImageFrozen, vo_motion_t::REASON_IMAGE_FROZEN));
static_assert(same(VoReason::kFramesMissing, vo_motion_t::REASON_FRAMES_MISSING));
static_assert(same(VoReason::kTimeBackwards, vo_motion_t::REASON_TIME_BACKWARDS));
static_assert(same(VoReason::kNoCalibration, vo_motion_t::REASON_NO_CALIBRATION));
static_assert(same(VoReason::kRestarted, vo_motion_t::REASON_RESTARTED));
static_assert(same(VoReason::kImageRepeated, vo_motion_t::REASON_IMAGE_REPEATED));
static_assert(same(VoReason::kImageStale, vo_motion_t::REASON_IMAGE_STALE));
static_assert(same(VoReason::kImageTorn, vo_motion_t::REASON_IMAGE_TORN));
static_assert(same(VoReason::kImagePartlyFrozen, vo_motion_t::REASON_IMAGE_PARTLY_FROZEN));
static_assert(same(VoReason::kImageMirrored, vo_motion_t::REASON_IMAGE_MIRRORED));
static_assert(same(VoReason::kImageUpsideDown, vo_motion_t::REASON_IMAGE_UPSIDE_DOWN));
static_assert(same(VoReason::kImageUnproven, vo_motion_t::REASON_IMAGE_UNPROVEN));
static_assert(same(VoReason::kTimeStarting, vo_motion_t::REASON_TIME_STARTING));
static_assert(same(VoReason::kTimeStalled, vo_motion_t::REASON_TIME_STALLED));
static_assert(same(VoReason::kTimeDoubted, vo_motion_t::REASON_TIME_DOUBTED));
static_assert(same(VoReason::kTimeForward, vo_motion_t::REASON_TIME_FORWARD));
static_assert(same(VoReason::kTimeUnit, vo_motion_t::REASON_TIME_UNIT));
static_assert(same(VoReason::kMotionMissing, vo_motion_t::REASON_MOTION_MISSING));
static_assert(same(VoReason::kImplausible, vo_motion_t::REASON_IMPLAUSIBLE));
static_assert(same(VoReason::kCalibrationDoubted, vo_motion_t::REASON_CALIBRATION_DOUBTED));
static_assert(same(VoReason::kOrientationUnproven, vo_motion_t::REASON_ORIENTATION_UNPROVEN));
static_assert(same(VoReason::kRoadMotion, vo_motion_t::REASON_ROAD_MOTION));
static_assert(same(FeatureKind::kUndecided, vo_motion_t::FEATURE_UNDECIDED));
static_assert(same(FeatureKind::kStatic, vo_motion_t::FEATURE_STATIC));
static_assert(same(FeatureKind::kMoving, vo_motion_t::FEATURE_MOVING));
static_assert(same(FeatureKind::kAttached, vo_motion_t::FEATURE_ATTACHED));
static_assert(sizeof(vo_motion_t::features_kind) == kMaxFeatures);
static_assert(sizeof(vo_motion_t::road_points_cam) / sizeof(vo_motion_t::road_points_cam[0]) ==
              kMaxRoadPoints);
static_assert(sizeof(vo_motion_t::window_seq) / sizeof(vo_motion_t::window_seq[0]) ==
              kMaxWindowPoses);

std::int16_t to_count(int count) { return static_cast<std::int16_t>(std::clamp(count, 0, 32767)); }

void window_to_wire(const VoOutput& output, vo_motion_t* message) {
  message->num_window = static_cast<std::int8_t>(output.window.size());
  for (std::size_t i = 0; i < output.window.size(); ++i) {
    message->window_seq[i] = output.window[i].seq;
    to_wire(output.window[i].T_window_cam, message->q_window_cam[i], message->t_window_cam[i]);
  }
}

void points_to_wire(const VoOutput& output, vo_motion_t* message) {
  message->num_road_points = static_cast<std::int16_t>(output.road_points.size());
  for (std::size_t i = 0; i < output.road_points.size(); ++i) {
    const RoadPoint& point = output.road_points[i];
    for (int k = 0; k < 3; ++k) message->road_points_cam[i][k] = point.p_cam[k];
    for (int k = 0; k < 2; ++k) message->road_points_px[i][k] = point.px[k];
    message->road_points_rel_std[i] = point.rel_std;
    message->road_points_num_obs[i] = point.num_obs;
  }
}

void features_to_wire(const VoOutput& output, vo_motion_t* message) {
  message->num_features = static_cast<std::int16_t>(output.features.size());
  for (std::size_t i = 0; i < output.features.size(); ++i) {
    const Feature& feature = output.features[i];
    for (int k = 0; k < 2; ++k) message->features_px[i][k] = feature.px[k];
    message->features_kind[i] = static_cast<std::int8_t>(feature.kind);
  }
}

const char* window_from_wire(const vo_motion_t& message, VoOutput* output) {
  output->window.clear();
  if (message.num_window < 0 || message.num_window > static_cast<int>(kMaxWindowPoses))
    return "VO motion: number of window poses is out of range";
  for (std::size_t i = 0; i < static_cast<std::size_t>(message.num_window); ++i) {
    WindowPose pose;
    pose.seq = message.window_seq[i];
    if (from_wire(message.q_window_cam[i], message.t_window_cam[i], &pose.T_window_cam) != nullptr)
      return "VO motion: a window pose is not a pose";
    const std::int64_t newer = i == 0 ? message.seq : message.window_seq[i - 1];
    if (pose.seq > newer || !output->window.push_back(pose))
      return "VO motion: window poses are not newest first";
  }
  return nullptr;
}

const char* points_from_wire(const vo_motion_t& message, VoOutput* output) {
  output->road_points.clear();
  if (message.num_road_points < 0 || message.num_road_points > static_cast<int>(kMaxRoadPoints))
    return "VO motion: number of road points is out of range";
  for (std::size_t i = 0; i < static_cast<std::size_t>(message.num_road_points); ++i) {
    const float* p_cam = message.road_points_cam[i];
    const float* px = message.road_points_px[i];
    RoadPoint point;
    point.p_cam = Eigen::Vector3f(p_cam[0], p_cam[1], p_cam[2]);
    point.px = Eigen::Vector2f(px[0], px[1]);
    point.rel_std = message.road_points_rel_std[i];
    point.num_obs = message.road_points_num_obs[i];
    const bool valid = point.p_cam.allFinite() && point.p_cam.z() > 0.0F && point.px.allFinite() &&
                       std::isfinite(point.rel_std) && point.rel_std >= 0.0F && point.num_obs >= 0;
    if (!valid || !output->road_points.push_back(point))
      return "VO motion: a road point is not a point before the camera";
  }
  return nullptr;
}

const char* features_from_wire(const vo_motion_t& message, VoOutput* output) {
  output->features.clear();
  if (message.num_features < 0 || message.num_features > static_cast<int>(kMaxFeatures))
    return "VO motion: number of features is out of range";
  for (std::size_t i = 0; i < static_cast<std::size_t>(message.num_features); ++i) {
    Feature feature;
    feature.px = Eigen::Vector2f(message.features_px[i][0], message.features_px[i][1]);
    feature.kind = static_cast<FeatureKind>(message.features_kind[i]);
    const bool valid = feature.px.allFinite() &&
                       message.features_kind[i] >= vo_motion_t::FEATURE_UNDECIDED &&
                       message.features_kind[i] <= vo_motion_t::FEATURE_ATTACHED;
    if (!valid || !output->features.push_back(feature))
      return "VO motion: a feature has no place in the image or no known kind";
  }
  return nullptr;
}

const char* summary_from_wire(const vo_motion_t& message, VoOutput* output) {
  if (message.num_tracked < 0 || message.num_inliers < 0 || message.num_new < 0)
    return "VO motion: a feature count is negative";
  if (!std::isfinite(message.median_flow_px) || !std::isfinite(message.median_parallax_px) ||
      !std::isfinite(message.rms_residual_px) || !(message.attached_share >= 0.0F) ||
      !(message.attached_share <= 1.0F)) {
    return "VO motion: the tracking summary is not finite";
  }
  output->num_tracked = message.num_tracked;
  output->num_inliers = message.num_inliers;
  output->num_new = message.num_new;
  output->is_keyframe = message.is_keyframe != 0;
  output->median_flow_px = static_cast<double>(message.median_flow_px);
  output->median_parallax_px = static_cast<double>(message.median_parallax_px);
  output->rms_residual_px = static_cast<double>(message.rms_residual_px);
  output->attached_share = static_cast<double>(message.attached_share);
  return nullptr;
}

}  // namespace

void to_wire(const VoOutput& output, vo_motion_t* message) {
  // Without this, rows beyond the counts would keep the values of the previous frame.
  std::memset(message, 0, sizeof *message);
  message->utime = output.capture_us;
  message->seq = output.seq;
  message->session = output.session;
  message->capture_mono_us = output.capture_mono_us;
  message->status = static_cast<std::int8_t>(output.status);
  message->reason = static_cast<std::int8_t>(output.reason);
  message->scale_epoch = output.scale_epoch;
  message->scale_carry_std = output.scale_carry_std;
  message->prev_seq = output.prev_seq;
  message->interval_s = output.interval_s;
  message->interval_std_s = output.interval_std_s;
  to_wire(output.T_prev_cam, message->q_prev_cam, message->t_prev_cam);
  to_wire(output.cov_prev_cam, message->cov_prev_cam);
  window_to_wire(output, message);
  message->num_tracked = to_count(output.num_tracked);
  message->num_inliers = to_count(output.num_inliers);
  message->num_new = to_count(output.num_new);
  message->is_keyframe = output.is_keyframe ? 1 : 0;
  message->median_flow_px = static_cast<float>(output.median_flow_px);
  message->median_parallax_px = static_cast<float>(output.median_parallax_px);
  message->rms_residual_px = static_cast<float>(output.rms_residual_px);
  message->attached_share = static_cast<float>(output.attached_share);
  points_to_wire(output, message);
  features_to_wire(output, message);
  message->road_height = output.road_height;
  message->road_height_std = output.road_height_std;
}

const char* from_wire(const vo_motion_t& message, VoOutput* output) {
  if (message.status < vo_motion_t::STATUS_OK || message.status > vo_motion_t::STATUS_LOST)
    return "VO motion: unknown status";
  if (message.reason < vo_motion_t::REASON_NONE || message.reason > vo_motion_t::REASON_ROAD_MOTION)
    return "VO motion: unknown reason";
  if (std::isinf(message.scale_carry_std) || message.scale_carry_std < 0.0)
    return "VO motion: the standard deviation of the scale is negative or infinite";
  if (std::isinf(message.interval_s) || message.interval_s <= 0.0)
    return "VO motion: the interval between the images is not positive and finite";
  if (!std::isnan(message.interval_s) &&
      !(message.interval_std_s >= 0.0 && std::isfinite(message.interval_std_s)))
    return "VO motion: the standard deviation of the interval is negative or not finite";
  const bool has_height = !std::isnan(message.road_height);
  if (has_height && !(message.road_height > 0.0 && std::isfinite(message.road_height) &&
                      message.road_height_std > 0.0 && std::isfinite(message.road_height_std)))
    return "VO motion: the height above the road is not positive and finite";
  output->road_height = message.road_height;
  output->road_height_std = has_height ? message.road_height_std : kNan;
  output->capture_us = message.utime;
  output->seq = message.seq;
  output->session = message.session;
  output->capture_mono_us = message.capture_mono_us;
  output->status = static_cast<VoStatus>(message.status);
  output->reason = static_cast<VoReason>(message.reason);
  output->scale_epoch = message.scale_epoch;
  output->scale_carry_std = message.scale_carry_std;
  output->prev_seq = message.prev_seq;
  output->interval_s = message.interval_s;
  output->interval_std_s = message.interval_std_s;
  if (from_wire(message.q_prev_cam, message.t_prev_cam, &output->T_prev_cam) != nullptr)
    return "VO motion: the relative pose is not a pose";
  if (from_wire(message.cov_prev_cam, &output->cov_prev_cam) != nullptr)
    return "VO motion: the covariance is not a covariance";
  if (const char* why = window_from_wire(message, output)) return why;
  if (const char* why = summary_from_wire(message, output)) return why;
  if (const char* why = features_from_wire(message, output)) return why;
  return points_from_wire(message, output);
}

}  // namespace plumb
