#include "modules/ground/ground_wire.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "core/pose_wire.hpp"
#include "core/same_value.hpp"

namespace plumb {
namespace {

static_assert(same(GroundStatus::kOk, ground_plane_t::STATUS_OK));
static_assert(same(GroundStatus::kInitializing, ground_plane_t::STATUS_INITIALIZING));
static_assert(same(GroundStatus::kHeld, ground_plane_t::STATUS_HELD));
static_assert(same(GroundStatus::kInvalid, ground_plane_t::STATUS_INVALID));
static_assert(same(GroundReason::kNone, ground_plane_t::REASON_NONE));
static_assert(same(GroundReason::kVoNotReady, ground_plane_t::REASON_VO_NOT_READY));
static_assert(same(GroundReason::kStandstill, ground_plane_t::REASON_STANDSTILL));
static_assert(same(GroundReason::kLowBaseline, ground_plane_t::REASON_LOW_BASELINE));
static_assert(same(GroundReason::kNoCue, ground_plane_t::REASON_NO_CUE));
static_assert(same(GroundReason::kCuesRejected, ground_plane_t::REASON_CUES_REJECTED));
static_assert(same(GroundReason::kImageMissing, ground_plane_t::REASON_IMAGE_MISSING));
static_assert(same(GroundReason::kVoLost, ground_plane_t::REASON_VO_LOST));
static_assert(same(GroundReason::kNoCalibration, ground_plane_t::REASON_NO_CALIBRATION));
static_assert(same(EgoStatus::kOk, ego_motion_t::STATUS_OK));
static_assert(same(EgoStatus::kInitializing, ego_motion_t::STATUS_INITIALIZING));
static_assert(same(EgoStatus::kScaleHeld, ego_motion_t::STATUS_SCALE_HELD));
static_assert(same(EgoStatus::kStandstill, ego_motion_t::STATUS_STANDSTILL));
static_assert(same(EgoStatus::kCoasting, ego_motion_t::STATUS_COASTING));
static_assert(same(EgoStatus::kLost, ego_motion_t::STATUS_LOST));
static_assert(same(CueStatus::kUsed, ground_cue_t::STATUS_USED));
static_assert(same(CueStatus::kAbsent, ground_cue_t::STATUS_ABSENT));
static_assert(same(CueStatus::kGated, ground_cue_t::STATUS_GATED));
static_assert(same(CueStatus::kFailed, ground_cue_t::STATUS_FAILED));
static_assert(same(kMaxCues, ground_plane_t::MAX_CUES));

constexpr double kUnitTolerance = 1e-6;
constexpr std::int8_t kLastCueStatus = static_cast<std::int8_t>(CueStatus::kFailed);

bool is_std(double value) { return std::isfinite(value) && value >= 0.0; }

const char* cues_from_wire(const ground_plane_t& message, PlaneOutput* plane) {
  if (message.num_cues < 0 || message.num_cues > ground_plane_t::MAX_CUES ||
      message.cues.size() != static_cast<std::size_t>(message.num_cues)) {
    return "ground plane: wrong number of cues";
  }
  plane->cues.fill({});
  for (std::size_t i = 0; i < message.cues.size(); ++i) {
    const ground_cue_t& cue = message.cues[i];
    if (cue.status < 0 || cue.status > kLastCueStatus) return "ground plane: unknown cue status";
    if (i >= kNumCues) continue;  // a newer program's cue
    CueReport& report = plane->cues[i];
    report.status = static_cast<CueStatus>(cue.status);
    report.height = cue.height;
    report.n1 = cue.n1;
    report.n3 = cue.n3;
    report.height_var = cue.height_var;
    report.n1_var = cue.n1_var;
    report.n3_var = cue.n3_var;
    report.quality = cue.quality;
    report.innovation = Eigen::Vector3d(cue.innovation);
    report.test_ratio = cue.test_ratio;
  }
  return nullptr;
}

const char* plane_from_wire(const ground_plane_t& message, PlaneOutput* plane) {
  if (message.status < ground_plane_t::STATUS_OK || message.status > ground_plane_t::STATUS_INVALID)
    return "ground plane: unknown status";
  if (message.reason < ground_plane_t::REASON_NONE ||
      message.reason > ground_plane_t::REASON_NO_CALIBRATION) {
    return "ground plane: unknown reason";
  }
  plane->status = static_cast<GroundStatus>(message.status);
  plane->reason = static_cast<GroundReason>(message.reason);
  plane->normal_cam = Eigen::Vector3d(message.normal_cam);
  plane->height_m = message.height_m;
  plane->pitch_rad = message.pitch_rad;
  plane->roll_rad = message.roll_rad;
  const bool claims = plane->status == GroundStatus::kOk || plane->status == GroundStatus::kHeld;
  if (claims && !(std::abs(plane->normal_cam.norm() - 1.0) <= kUnitTolerance &&
                  plane->height_m > 0.0 && std::isfinite(plane->height_m) &&
                  std::isfinite(plane->pitch_rad) && std::isfinite(plane->roll_rad))) {
    return "ground plane: its status says that the plane is valid, but it is not";
  }
  plane->cov = Eigen::Matrix3d(&message.cov[0][0]);
  if (claims && from_wire(message.cov, &plane->cov) != nullptr)
    return "ground plane: not a covariance";
  return cues_from_wire(message, plane);
}

const char* rates_from_wire(const ego_motion_t& message, EgoOutput* ego) {
  ego->velocity_ground_m_s = Eigen::Vector3d(message.velocity_ground_m_s);
  ego->speed_std_m_s = message.speed_std_m_s;
  ego->rate_ground_rad_s = Eigen::Vector3d(message.rate_ground_rad_s);
  ego->yaw_rate_std_rad_s = message.yaw_rate_std_rad_s;
  ego->accel_forward_m_s2 = message.accel_forward_m_s2;
  ego->accel_forward_std_m_s2 = message.accel_forward_std_m_s2;
  ego->distance_m = message.distance_m;
  ego->log_scale = message.log_scale;
  ego->log_scale_std = message.log_scale_std;
  // The scale is unknown while the car has not moved yet.
  const bool scale_valid =
      (std::isfinite(ego->log_scale) && is_std(ego->log_scale_std)) ||
      (ego->status == EgoStatus::kStandstill && std::isnan(ego->log_scale_std));
  // Without the interval between the images, there is neither a velocity nor a rate.
  const bool has_rates = !std::isnan(ego->speed_std_m_s);
  const bool rates_valid =
      !has_rates || (ego->velocity_ground_m_s.allFinite() && ego->rate_ground_rad_s.allFinite() &&
                     is_std(ego->speed_std_m_s) && is_std(ego->yaw_rate_std_rad_s));
  const bool valid =
      rates_valid && !std::isinf(ego->accel_forward_m_s2) && is_std(ego->distance_m) && scale_valid;
  return valid ? nullptr : "ego motion: a velocity, rate or scale is not a number";
}

/// The motion since the previous image, which is NaN while it is not measured.
const char* step_from_wire(const ego_motion_t& message, EgoOutput* ego) {
  ego->T_prev_cam = EgoOutput{}.T_prev_cam;
  ego->cov_prev_cam.setConstant(kNan);
  if (std::isnan(message.t_prev_cam_m[0])) return nullptr;
  if (from_wire(message.q_prev_cam, message.t_prev_cam_m, &ego->T_prev_cam) != nullptr)
    return "ego motion: a pose is not a pose";
  if (from_wire(message.cov_prev_cam, &ego->cov_prev_cam) != nullptr)
    return "ego motion: not a covariance";
  return nullptr;
}

const char* ego_from_wire(const ego_motion_t& message, EgoOutput* ego) {
  if (message.status < ego_motion_t::STATUS_OK || message.status > ego_motion_t::STATUS_LOST)
    return "ego motion: unknown status";
  if (message.reason < 0 || message.reason > static_cast<std::int8_t>(VoReason::kRoadMotion))
    return "ego motion: unknown reason";
  ego->status = static_cast<EgoStatus>(message.status);
  ego->reason = static_cast<VoReason>(message.reason);
  ego->reset_counter = message.reset_counter;
  if (from_wire(message.q_world_cam, message.t_world_cam_m, &ego->T_world_cam) != nullptr)
    return "ego motion: a pose is not a pose";
  if (from_wire(message.cov_world_cam, &ego->cov_world_cam) != nullptr)
    return "ego motion: not a covariance";
  if (const char* why = step_from_wire(message, ego)) return why;
  const char* why = rates_from_wire(message, ego);
  const bool silent = ego->status == EgoStatus::kInitializing || ego->status == EgoStatus::kLost;
  return silent ? nullptr : why;  // rates of such a motion are not valid and may be anything
}

void to_wire(const CueReport& cue, ground_cue_t* out) {
  out->status = static_cast<std::int8_t>(cue.status);
  out->height = cue.height;
  out->n1 = cue.n1;
  out->n3 = cue.n3;
  out->height_var = cue.height_var;
  out->n1_var = cue.n1_var;
  out->n3_var = cue.n3_var;
  out->quality = cue.quality;
  for (int i = 0; i < 3; ++i) out->innovation[i] = cue.innovation(i);
  out->test_ratio = cue.test_ratio;
}

}  // namespace

void to_wire(const GroundOutput& output, ground_plane_t* message) {
  const PlaneOutput& plane = output.plane;
  message->utime = output.capture_us;
  message->seq = output.seq;
  message->status = static_cast<std::int8_t>(plane.status);
  message->reason = static_cast<std::int8_t>(plane.reason);
  to_wire(plane.normal_cam, message->normal_cam);
  message->height_m = plane.height_m;
  message->pitch_rad = plane.pitch_rad;
  message->roll_rad = plane.roll_rad;
  to_wire(plane.cov, message->cov);
  message->num_cues = static_cast<std::int8_t>(kNumCues);
  message->cues.resize(kNumCues);
  for (std::size_t i = 0; i < kNumCues; ++i) to_wire(plane.cues[i], &message->cues[i]);
}

void withhold_plane(ground_plane_t* message) {
  message->status = ground_plane_t::STATUS_INITIALIZING;
  message->reason = ground_plane_t::REASON_VO_NOT_READY;
  message->height_m = message->pitch_rad = message->roll_rad = kNan;
  for (int i = 0; i < 3; ++i) {
    message->normal_cam[i] = kNan;
    for (double& value : message->cov[i]) value = kNan;
  }
}

void to_wire(const GroundOutput& output, ego_motion_t* message) {
  const EgoOutput& ego = output.ego;
  message->utime = output.capture_us;
  message->seq = output.seq;
  message->status = static_cast<std::int8_t>(ego.status);
  message->reason = static_cast<std::int8_t>(ego.reason);
  message->reset_counter = ego.reset_counter;
  to_wire(ego.T_prev_cam, message->q_prev_cam, message->t_prev_cam_m);
  to_wire(ego.cov_prev_cam, message->cov_prev_cam);
  to_wire(ego.velocity_ground_m_s, message->velocity_ground_m_s);
  message->speed_std_m_s = ego.speed_std_m_s;
  to_wire(ego.rate_ground_rad_s, message->rate_ground_rad_s);
  message->yaw_rate_std_rad_s = ego.yaw_rate_std_rad_s;
  message->accel_forward_m_s2 = ego.accel_forward_m_s2;
  message->accel_forward_std_m_s2 = ego.accel_forward_std_m_s2;
  to_wire(ego.T_world_cam, message->q_world_cam, message->t_world_cam_m);
  to_wire(ego.cov_world_cam, message->cov_world_cam);
  message->distance_m = ego.distance_m;
  message->log_scale = ego.log_scale;
  message->log_scale_std = ego.log_scale_std;
}

const char* from_wire(const ground_plane_t& plane, const ego_motion_t& ego, GroundOutput* output) {
  if (plane.seq != ego.seq || plane.utime != ego.utime)
    return "ground plane and ego motion are of different images";
  output->capture_us = plane.utime;
  output->seq = plane.seq;
  if (const char* why = plane_from_wire(plane, &output->plane)) return why;
  return ego_from_wire(ego, &output->ego);
}

}  // namespace plumb
