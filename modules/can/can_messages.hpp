/// The list of CAN messages: one row each, with the defaults of its settings. What they carry is
/// listed in modules/can/signals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace plumb {

/// The version of the layout that PLB_Info sends; +1 with every change of a bit's meaning.
inline constexpr int kDatabaseVersion = 4;

/// What makes a message leave, apart from its cycle.
enum class CanTrigger : std::uint8_t {
  kNone,
  kCameraFrame,   ///< a new camera frame
  kMountMessage,  ///< a new MOUNT
  kObjectList,    ///< a new OBJECTS
  kObject,        ///< once for every object of a new OBJECTS
};

struct MessageRow {
  const char* name;    ///< in the DBC behind can.node and an underscore
  const char* key;     ///< of its settings: can.KEY.id and so on
  int id_offset;       ///< default identifier, from can.base_id on
  int data_id_offset;  ///< default E2E data identifier, from can.base_data_id on
  int cycle_ms;        ///< default; 0: the message has no cycle
  CanTrigger trigger;
  const char* comment;  ///< in the DBC
};

/// In the order in which a burst sends them.
inline constexpr std::array kMessageRows = std::to_array<MessageRow>({
    {"EgoMotion", "ego_motion", 0, 1, 10, CanTrigger::kNone,
     "Metric motion of the camera in one camera frame; repeated until the next frame. First of the "
     "burst that every camera frame causes: the messages of ego motion, ground plane, odometry and "
     "age, back to back."},
    {"EgoMotionDetail", "ego_motion_detail", 1, 2, 10, CanTrigger::kNone,
     "Status, acceleration and standard deviations of the same camera frame's motion."},
    {"GroundPlane", "ground_plane", 2, 3, 10, CanTrigger::kNone,
     "Plane of the road under the camera in one camera frame."},
    {"GroundPlaneDetail", "ground_plane_detail", 3, 4, 10, CanTrigger::kNone,
     "Status, reason, cues and standard deviations of the same camera frame's plane."},
    {"OdometryX", "odometry_x", 4, 5, 20, CanTrigger::kCameraFrame,
     "Integrated pose, first part. Also sent at once for every new camera frame."},
    {"OdometryY", "odometry_y", 5, 6, 20, CanTrigger::kCameraFrame,
     "Integrated pose, second part. Also sent at once for every new camera frame."},
    {"OdometryDistance", "odometry_distance", 6, 7, 20, CanTrigger::kCameraFrame,
     "Integrated pose, third part. Also sent at once for every new camera frame."},
    {"Frame", "frame", 10, 15, 20, CanTrigger::kCameraFrame,
     "Age of a camera frame, and which of its values were not believed. Also sent at once for "
     "every "
     "new camera frame, last of its burst."},
    {"Status", "status", 7, 8, 100, CanTrigger::kNone, "State of the chain, reasons and counters."},
    {"Info", "info", 8, 9, 1000, CanTrigger::kNone, "Versions and uptime."},
    {"Mount", "mount", 9, 14, 1000, CanTrigger::kMountMessage,
     "How the camera sits on its vehicle, watched over straight stretches of road. Also sent at "
     "once for every message of the mount check: once a second and when its status changes."},
    {"ObjectList", "object_list", 16, 10, 100, CanTrigger::kObjectList,
     "Objects on the road, seen in one camera frame. A burst: this message, then position, motion "
     "and state of each object, back to back. Repeated alone by its cycle while nothing new comes; "
     "silent when no objects were ever received."},
    {"ObjectPosition", "object_position", 17, 11, 0, CanTrigger::kObject,
     "Where one object of the burst stands on the road. Multiplexed by the object's index."},
    {"ObjectMotion", "object_motion", 18, 12, 0, CanTrigger::kObject,
     "How one object of the burst moves over ground. Multiplexed by the object's index."},
    {"ObjectState", "object_state", 19, 13, 0, CanTrigger::kObject,
     "What one object of the burst is. Multiplexed by the object's index."},
});
inline constexpr std::size_t kNumMessages = kMessageRows.size();

/// Place of a message in the list. Does not compile for a name that is not in it.
consteval std::size_t message_index(std::string_view name) {
  std::size_t i = 0;
  while (name != kMessageRows[i].name) ++i;
  return i;
}

/// Whether the message belongs to the list of objects.
constexpr bool is_about_objects(CanTrigger trigger) {
  return trigger == CanTrigger::kObjectList || trigger == CanTrigger::kObject;
}

}  // namespace plumb
