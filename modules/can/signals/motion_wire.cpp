// The signals of ego motion and odometry, out of EGO_MOTION.
#include "modules/can/signals/signal_tables.hpp"

#include <cmath>

#include "modules/can/judge_wire.hpp"
#include "modules/can/signals/rows.hpp"
#include "modules/can/validity_wire.hpp"
#include "plumb/status_names.hpp"

namespace plumb {
namespace {

using Ego = JudgedMotion;

constexpr std::array<const char*, 2> kStandstillNames = {"moving", "standstill"};

/// Heading of the optical axis about the first image's up axis, left positive.
double heading_rad(const double (&q)[4]) {
  const double forward_x = 2.0 * (q[1] * q[3] + q[0] * q[2]);  // R(0,2), to the right
  const double forward_z = 1.0 - 2.0 * (q[1] * q[1] + q[2] * q[2]);
  return std::atan2(-forward_x, forward_z);
}

constexpr Signal motion_validity() {
  return {"EgoMotion_Validity",
          {12, 2},
          "",
          validity_of_group<Ego>(Group::kMain),
          "What speeds and rates of this message and of EgoMotionDetail are worth: 0 invalid (they "
          "are sent as not available), 1 degraded (motion or scale is predicted, or one value is "
          "not available), 2 valid.",
          kValidityNames,
          kNoFreshInput};
}

constexpr Signal pose_validity(const char* name) {
  return {name,
          {12, 2},
          "",
          validity_of_group<Ego>(Group::kPose),
          "What the values of the odometry messages are worth: 0 invalid (they are sent as not "
          "available), 1 degraded (the newest motion or the scale is predicted or not believed), 2 "
          "valid.",
          kValidityNames,
          kNoFreshInput};
}

/// A value of the integrated pose.
template <typename Read>
constexpr SignalValue of_pose(Read read) {
  return essential(when_valid<Ego>(read, Group::kPose));
}

constexpr double kPositionModulus_m = 80'000.0;
constexpr double kHeightModulus_m = 3'200.0;
constexpr double kDistanceModulus_m = 1'000'000.0;

// EGO_MOTION's world is the first image's camera: x right, y down, z forward.
constexpr Signal kEgoMotionSignals[] = {
    crc("EgoMotion_Crc"),
    alive_counter("EgoMotion_AliveCtr"),
    motion_validity(),
    {"EgoMotion_Standstill",
     {14, 2},
     "",
     when_valid<Ego>([](const Ego& m) { return m.status == Ego::STATUS_STANDSTILL; }),
     "1: the camera stands still. It is measured; degraded where equal images are all that says "
     "so.",
     kStandstillNames},
    frame_counter("EgoMotion_FrameCtr"),
    {"EgoMotion_Speed",
     {24, 16, 0.005, -100.0},
     "m/s",
     essential(with_deviation("EgoMotion_SpeedStd", when_valid<Ego>([](const Ego& m) {
                                return m.velocity_ground_m_s[0];
                              }))),
     "Speed of the camera over the road, along x of ISO 8855 (forward), forward positive."},
    {"EgoMotion_YawRate",
     {40, 16, 0.00005, -1.6384},
     "rad/s",
     wanted(with_deviation("EgoDetail_YawRateStd",
                           when_valid<Ego>([](const Ego& m) { return m.rate_ground_rad_s[2]; }))),
     "Yaw rate about z of ISO 8855 (up), turning left positive."},
    {"EgoMotion_SpeedStd",
     {56, 8, 0.02},
     "m/s",
     when_valid<Ego>([](const Ego& m) { return m.speed_std_m_s; }),
     "Standard deviation of EgoMotion_Speed."},
};
static_assert(fit_message(kEgoMotionSignals));

constexpr Signal kEgoMotionDetailSignals[] = {
    crc("EgoDetail_Crc"),
    alive_counter("EgoDetail_AliveCtr"),
    {"EgoDetail_Status",
     {12, 4},
     "",
     when_received<Ego>([](const Ego& m) { return m.status; }),
     "Status of the ego motion.",
     kEgoMotionStatusNames},
    frame_counter("EgoDetail_FrameCtr"),
    {"EgoDetail_AccelX",
     {24, 12, 0.01, -20.0},
     "m/s^2",
     with_deviation("EgoDetail_AccelXStd",
                    when_valid<Ego>([](const Ego& m) { return m.accel_forward_m_s2; })),
     "Acceleration along x of ISO 8855 (forward): time derivative of the forward speed, speeding "
     "up positive. Not available when it cannot be observed."},
    {"EgoDetail_AccelXStd",
     {36, 8, 0.02},
     "m/s^2",
     when_valid<Ego>([](const Ego& m) { return m.accel_forward_std_m_s2; }),
     "Standard deviation of EgoDetail_AccelX."},
    {"EgoDetail_YawRateStd",
     {44, 10, 0.0001},
     "rad/s",
     when_valid<Ego>([](const Ego& m) { return m.yaw_rate_std_rad_s; }),
     "Standard deviation of EgoMotion_YawRate."},
    {"EgoDetail_SpeedY",
     {54, 10, 0.02, -10.0},
     "m/s",
     when_valid<Ego>([](const Ego& m) { return m.velocity_ground_m_s[1]; }),
     "Speed of the camera along y of ISO 8855 (left), to the left positive."},
};
static_assert(fit_message(kEgoMotionDetailSignals));

constexpr Signal kOdometryXSignals[] = {
    crc("OdomX_Crc"),
    alive_counter("OdomX_AliveCtr"),
    pose_validity("OdomX_Validity"),
    frame_counter("OdomX_FrameCtr"),
    {"OdomX_PosX", wrapping({24, 24, 0.005, -40'000.0}, kPositionModulus_m), "m",
     of_pose([](const Ego& m) { return m.t_world_cam_m[2]; }),
     "Position of the camera along x of the odometry axes: those of the first image, x forward "
     "along the optical axis, y left, z up. Integrated, drifts. Modulo 80000 m: use differences."},
    {"OdomX_Heading",
     {48, 16, 0.0001, -3.2768},
     "rad",
     of_pose([](const Ego& m) { return heading_rad(m.q_world_cam); }),
     "Heading of the optical axis about z (up) of the odometry axes, left positive, -pi to pi. "
     "Integrated, drifts."},
};
static_assert(fit_message(kOdometryXSignals));

constexpr Signal kOdometryYSignals[] = {
    crc("OdomY_Crc"),
    alive_counter("OdomY_AliveCtr"),
    pose_validity("OdomY_Validity"),
    frame_counter("OdomY_FrameCtr"),
    {"OdomY_PosY", wrapping({24, 24, 0.005, -40'000.0}, kPositionModulus_m), "m",
     of_pose([](const Ego& m) { return -m.t_world_cam_m[0]; }),
     "Position of the camera along y (left) of the odometry axes, left positive. Integrated, "
     "drifts. Modulo 80000 m: use differences."},
    {"OdomY_PosZ", wrapping({48, 16, 0.05, -1'600.0}, kHeightModulus_m), "m",
     of_pose([](const Ego& m) { return -m.t_world_cam_m[1]; }),
     "Position of the camera along z (up) of the odometry axes, up positive. Integrated, drifts. "
     "Modulo 3200 m: use differences."},
};
static_assert(fit_message(kOdometryYSignals));

constexpr Signal kOdometryDistanceSignals[] = {
    crc("OdomDist_Crc"),
    alive_counter("OdomDist_AliveCtr"),
    pose_validity("OdomDist_Validity"),
    frame_counter("OdomDist_FrameCtr"),
    {"OdomDist_Distance", wrapping({24, 24, 0.0625}, kDistanceModulus_m), "m",
     of_pose([](const Ego& m) { return m.distance_m; }),
     "Length of the path since the first image. Modulo 1000000 m: use differences."},
    {"OdomDist_ResetCtr",
     {48, 8},
     "",
     when_received<Ego>([](const Ego& m) { return modulo_255(m.reset_count); }),
     "+1 whenever the integrated pose lost its continuity, also when the process that integrates "
     "it began anew; modulo 255. It begins at any value: only a change tells."},
    {"OdomDist_ScaleStd",
     {56, 8, 0.002},
     "",
     wanted(when_valid<Ego>([](const Ego& m) { return m.log_scale_std; }, Group::kPose)),
     "Standard deviation of the logarithm of the metric scale: 0.01 is 1 percent of every length."},
};
static_assert(fit_message(kOdometryDistanceSignals));

constexpr SignalTable kMotionTables[] = {
    {message_index("EgoMotion"), kEgoMotionSignals},
    {message_index("EgoMotionDetail"), kEgoMotionDetailSignals},
    {message_index("OdometryX"), kOdometryXSignals},
    {message_index("OdometryY"), kOdometryYSignals},
    {message_index("OdometryDistance"), kOdometryDistanceSignals},
};

}  // namespace

std::span<const SignalTable> motion_signals() { return kMotionTables; }

}  // namespace plumb
