#include "modules/can/can_load.hpp"

namespace plumb {

double max_frames_per_s(const Messages& messages, const CanTraffic& traffic) {
  double frames_per_s = 0.0;
  for (const Message& message : messages) {
    const CanTrigger trigger = message.row->trigger;
    const double cycles_per_s = message.address.cycle_ms > 0 ? 1e3 / message.address.cycle_ms : 0.0;
    if (is_about_objects(trigger) && traffic.objects_hz <= 0.0) continue;
    if (trigger == CanTrigger::kObject) {
      frames_per_s += traffic.objects_hz * static_cast<double>(traffic.num_objects);
    } else if (trigger == CanTrigger::kObjectList) {
      frames_per_s += traffic.objects_hz > cycles_per_s ? traffic.objects_hz : cycles_per_s;
    } else {
      frames_per_s += cycles_per_s;
      if (trigger == CanTrigger::kCameraFrame) frames_per_s += traffic.camera_hz;
      if (trigger == CanTrigger::kMountMessage) frames_per_s += 1.0;
    }
  }
  return frames_per_s;
}

double max_bus_load(const Messages& messages, const CanTraffic& traffic, double bits_per_s) {
  const int frame_bits = max_frame_bits(messages[0].address.extended);
  return max_frames_per_s(messages, traffic) * frame_bits / bits_per_s;
}

}  // namespace plumb
