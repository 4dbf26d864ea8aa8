#include "tools/run/replay/names.hpp"

#include <array>
#include <cstddef>

#include "plumb/detection_t.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/object_t.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {
namespace {

constexpr std::array kVoStatus = {"ok",       "initializing", "standstill", "rotation_only",
                                  "coasting", "lost"};
static_assert(kVoStatus.size() == vo_motion_t::STATUS_LOST + 1);

constexpr std::array kVoReason = {
    "none",           "first_frame", "low_parallax", "too_few_features", "too_few_inliers",
    "image_dark",     "image_flat",  "image_frozen", "frames_missing",   "time_backwards",
    "no_calibration", "restarted"};
static_assert(kVoReason.size() == vo_motion_t::REASON_RESTARTED + 1);

constexpr std::array kPlaneStatus = {"ok", "initializing", "held", "invalid"};
static_assert(kPlaneStatus.size() == ground_plane_t::STATUS_INVALID + 1);

constexpr std::array kPlaneReason = {"none",          "vo_not_ready", "standstill",
                                     "low_baseline",  "no_cue",       "cues_rejected",
                                     "image_missing", "vo_lost",      "no_calibration"};
static_assert(kPlaneReason.size() == ground_plane_t::REASON_NO_CALIBRATION + 1);

constexpr std::array kCueStatus = {"used", "absent", "gated", "failed"};

constexpr std::array kEgoStatus = {"ok",         "initializing", "scale_held",
                                   "standstill", "coasting",     "lost"};
static_assert(kEgoStatus.size() == ego_motion_t::STATUS_LOST + 1);

constexpr std::array kMountStatus = {"collecting", "unsteady", "steady", "moved"};
static_assert(kMountStatus.size() == mount_t::STATUS_MOVED + 1);

constexpr std::array kObjectClass = {"unknown", "car",        "van",    "truck",
                                     "bus",     "pedestrian", "cyclist"};
static_assert(kObjectClass.size() == detection_t::CLASS_CYCLIST + 1);

constexpr std::array kObjectStatus = {"measured", "predicted", "not_localised"};
static_assert(kObjectStatus.size() == object_t::STATUS_NOT_LOCALISED + 1);

constexpr std::array kObjectReason = {"none",     "cut",    "hidden", "calibrated_plane",
                                      "not_seen", "misfit", "no_fit"};
static_assert(kObjectReason.size() == object_t::REASON_NO_FIT + 1);

template <std::size_t kSize>
const char* name_in(const std::array<const char*, kSize>& names, int number) {
  return number >= 0 && static_cast<std::size_t>(number) < kSize
             ? names[static_cast<std::size_t>(number)]
             : "?";
}

}  // namespace

const char* vo_status_name(int status) { return name_in(kVoStatus, status); }
const char* vo_reason_name(int reason) { return name_in(kVoReason, reason); }
const char* plane_status_name(int status) { return name_in(kPlaneStatus, status); }
const char* plane_reason_name(int reason) { return name_in(kPlaneReason, reason); }
const char* cue_status_name(int status) { return name_in(kCueStatus, status); }
const char* ego_status_name(int status) { return name_in(kEgoStatus, status); }
const char* mount_status_name(int status) { return name_in(kMountStatus, status); }
const char* object_class_name(int object_class) { return name_in(kObjectClass, object_class); }
const char* object_status_name(int status) { return name_in(kObjectStatus, status); }
const char* object_reason_name(int reason) { return name_in(kObjectReason, reason); }

}  // namespace plumb
