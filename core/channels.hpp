/// Every LCM channel of the system, in the order of the data flow.
/// No other file spells a channel's name.
#pragma once

#include <cstdint>

namespace plumb {

struct Channel {
  const char* name;
  const char* publisher;  ///< the only process that may publish on it
  double rate_hz;         ///< nominal rate
  std::int64_t stale_us;  ///< a reader treats a message older than this as absent
};

inline constexpr Channel kCamera{"CAMERA", "camera", 10.0, 300'000};
inline constexpr Channel kCameraCalibration{"CAMERA_CALIBRATION", "camera", 1.0, 5'000'000};
inline constexpr Channel kVoMotion{"VO_MOTION", "vo", 10.0, 300'000};
inline constexpr Channel kGroundPlane{"GROUND_PLANE", "ground", 10.0, 300'000};
inline constexpr Channel kEgoMotion{"EGO_MOTION", "ground", 10.0, 300'000};
inline constexpr Channel kVehicleSpeed{"VEHICLE_SPEED", "vehicle", 50.0, 500'000};
inline constexpr Channel kMount{"MOUNT", "ground", 1.0, 3'000'000};
inline constexpr Channel kDetections{"DETECTIONS", "detect", 10.0, 500'000};
inline constexpr Channel kObjects{"OBJECTS", "objects", 10.0, 300'000};
inline constexpr Channel kGroundTruth{"GROUND_TRUTH", "log", 10.0, 0};
inline constexpr Channel kHealthCamera{"HEALTH_CAMERA", "camera", 2.0, 1'500'000};
inline constexpr Channel kHealthVo{"HEALTH_VO", "vo", 2.0, 1'500'000};
inline constexpr Channel kHealthGround{"HEALTH_GROUND", "ground", 2.0, 1'500'000};
inline constexpr Channel kHealthVehicle{"HEALTH_VEHICLE", "vehicle", 2.0, 1'500'000};
inline constexpr Channel kHealthDetect{"HEALTH_DETECT", "detect", 2.0, 1'500'000};
inline constexpr Channel kHealthObjects{"HEALTH_OBJECTS", "objects", 2.0, 1'500'000};
inline constexpr Channel kHealthCan{"HEALTH_CAN", "can", 2.0, 1'500'000};

}  // namespace plumb
