#include "modules/mount/mount_wire.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "core/same_value.hpp"

namespace plumb {
namespace {

static_assert(same(MountStatus::kCollecting, mount_t::STATUS_COLLECTING));
static_assert(same(MountStatus::kUnsteady, mount_t::STATUS_UNSTEADY));
static_assert(same(MountStatus::kSteady, mount_t::STATUS_STEADY));
static_assert(same(MountStatus::kMoved, mount_t::STATUS_MOVED));
static_assert(same(MountStatus::kMisaligned, mount_t::STATUS_MISALIGNED));
static_assert(same(MountReason::kNone, mount_t::REASON_NONE));
static_assert(same(MountReason::kNoMotion, mount_t::REASON_NO_MOTION));
static_assert(same(MountReason::kNoPlane, mount_t::REASON_NO_PLANE));
static_assert(same(MountReason::kSlow, mount_t::REASON_SLOW));
static_assert(same(MountReason::kTurning, mount_t::REASON_TURNING));
static_assert(same(MountReason::kUpsideDown, mount_t::REASON_UPSIDE_DOWN));
static_assert(same(HeightStatus::kStated, mount_t::HEIGHT_STATED));
static_assert(same(HeightStatus::kLearning, mount_t::HEIGHT_LEARNING));
static_assert(same(HeightStatus::kLearned, mount_t::HEIGHT_LEARNED));
static_assert(same(HeightStatus::kContradicted, mount_t::HEIGHT_CONTRADICTED));

constexpr double kMostSpeed_m_s = 150.0;

}  // namespace

void to_wire(const MountReport& report, std::int64_t capture_us, mount_t* message) {
  message->utime = capture_us;
  message->status = static_cast<std::int8_t>(report.status);
  message->reason = static_cast<std::int8_t>(report.reason);
  message->progress = report.progress;
  message->num_stretches = report.num_stretches;
  for (int i = 0; i < 3; ++i) {
    message->reference_rad[i] = report.reference ? report.reference->mean_rad(i) : kNan;
    message->reference_std_rad[i] = report.reference ? report.reference->std_rad(i) : kNan;
    message->recent_rad[i] = report.recent_rad(i);
    message->spread_rad[i] = report.spread_rad(i);
  }
}

void to_wire(const HeightReport& report, mount_t* message) {
  message->height_status = static_cast<std::int8_t>(report.status);
  message->height_num_stretches = report.num_stretches;
  message->vehicle_height_m = report.by_vehicle.height_m;
  message->vehicle_height_std_m = report.by_vehicle.std_m;
  message->height_m = report.used.height_m;
  message->height_std_m = report.used.std_m;
}

const char* from_wire(const vehicle_speed_t& message, VehicleSpeed* speed) {
  if (message.utime < 0) return "vehicle speed has a negative time";
  if (!(std::abs(message.speed_m_s) <= kMostSpeed_m_s)) return "vehicle speed is out of range";
  if (!(message.scale_std >= 0.0 && message.scale_std <= 1.0))
    return "deviation of the vehicle speed is not in [0, 1]";
  *speed = {message.utime, message.speed_m_s, message.scale_std};
  return nullptr;
}

}  // namespace plumb
