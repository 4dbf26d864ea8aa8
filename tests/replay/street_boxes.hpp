/// Makes DETECTIONS for the rendered street: the boxes of a perfect detector for a car parked
/// ahead.
#pragma once

#include <vector>

#include "modules/detections/detections_wire.hpp"
#include "tests/replay/street_log.hpp"

namespace plumb::test {

inline constexpr double kParked_m = 45.0;  ///< distance of its rear in the first image
inline constexpr double kParkedLeft_m = 2.5;
inline constexpr std::int64_t kLastBoxFrame = 20;  ///< before the street bends

/// Boxes the parked car's rear, 1.53 m high and 1.67 m wide, for a camera 1.65 m above the road.
inline DetectionFrame street_boxes(std::int64_t seq, const CameraModel& camera = scene_camera()) {
  const double ahead_m = kParked_m - street_drive()[static_cast<std::size_t>(seq)].t.z();
  const auto column = [&](double left_m) { return camera.cx_px - camera.fx_px * left_m / ahead_m; };
  const auto row = [&](double up_m) {
    return camera.cy_px + camera.fy_px * (1.65 - up_m) / ahead_m;
  };
  DetectionFrame frame;
  frame.capture_us = kStreetStart_us + seq * kStreetPeriod_us;
  frame.seq = seq;
  Detection car;
  car.track_id = 4;
  car.object_class = ObjectClass::kCar;
  car.score = 0.9;
  car.occluded = Occlusion::kVisible;
  car.box = {column(kParkedLeft_m + 0.835), row(1.53), column(kParkedLeft_m - 0.835), row(0.0)};
  (void)frame.detections.push_back(car);
  return frame;
}

/// Returns `events` with boxes behind each of the first images.
inline std::vector<StoredEvent> with_boxes(const std::vector<StoredEvent>& events,
                                           const CameraModel& camera = scene_camera()) {
  std::vector<StoredEvent> all;
  std::int64_t seq = 0;
  for (const StoredEvent& event : events) {
    all.push_back(event);
    if (event.channel != kCamera.name || seq > kLastBoxFrame) continue;
    detections_t message;
    to_wire(street_boxes(seq++, camera), &message);
    all.push_back(stored(event.log_us, kDetections, message));
  }
  return all;
}

}  // namespace plumb::test
