/// Makes LCM logs of a drive down the rendered street.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/channels.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/chain/chain.hpp"
#include "platform/log_file.hpp"
#include "tests/support/scene.hpp"

namespace plumb::test {

inline constexpr std::int64_t kStreetStart_us = 1'000'000'000'000'000;
inline constexpr std::int64_t kStreetPeriod_us = 100'000;

/// An event that owns its bytes.
struct StoredEvent {
  std::int64_t log_us = 0;
  std::string channel;
  std::vector<std::uint8_t> data;
  [[nodiscard]] LogEvent view() const { return {0, log_us, channel, data}; }
};

template <typename Message>
StoredEvent stored(std::int64_t log_us, const Channel& channel, const Message& message) {
  StoredEvent event{log_us, channel.name, {}};
  event.data.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(event.data.data(), 0, static_cast<int>(event.data.size()));
  return event;
}

inline StoredEvent image_event(std::int64_t seq, const ImageView& image,
                               std::int64_t capture_us = -1) {
  if (capture_us < 0) capture_us = kStreetStart_us + seq * kStreetPeriod_us;
  image_t message;
  to_wire(capture_us, seq, image, &message);
  return stored(capture_us, kCamera, message);
}

/// Makes a log with a calibration and one image per pose, 1.65 m above the road and with a little
/// sensor noise.
inline std::vector<StoredEvent> street_log(const std::vector<Se3>& T_world_cam) {
  const Scene scene(scene_camera());
  std::vector<StoredEvent> events = {
      stored(kStreetStart_us, kCameraCalibration, to_wire(scene.camera(), kStreetStart_us))};
  for (std::size_t i = 0; i < T_world_cam.size(); ++i) {
    const RenderedImage image = scene.render(T_world_cam[i], 1.5, static_cast<unsigned>(i + 1));
    events.push_back(image_event(static_cast<std::int64_t>(i), image.view()));
  }
  return events;
}

/// Poses of a drive straight on at 0.9 m per frame and then through a gentle left bend.
inline const std::vector<Se3>& street_drive() {
  static const std::vector<Se3> poses = [] {
    std::vector<Se3> drive = test::drive(22, 0.9);
    const Se3 bend{exp_so3({0.0, -0.004, 0.0}), {0.0, 0.0, 0.9}};
    while (drive.size() < 36) drive.push_back(drive.back() * bend);
    return drive;
  }();
  return poses;
}

inline const std::vector<StoredEvent>& street_events() {
  static const std::vector<StoredEvent> events = street_log(street_drive());
  return events;
}

inline void write_log(const std::string& path, const std::vector<StoredEvent>& events) {
  LogWriter writer(path);
  for (const StoredEvent& event : events) writer.write(event.log_us, event.channel, event.data);
  writer.close();
}

/// Feeds `events` and hands each record to `take`.
inline void replay_events(const std::vector<StoredEvent>& events, CanSink* can,
                          const std::function<void(const Chain&, const FrameRecord&)>& take,
                          const std::function<void(const Chain&)>& at_end = {}) {
  const Chain* self = nullptr;
  Chain replay(PlumbConfig{}, 1, can, [&](const FrameRecord& record) { take(*self, record); });
  self = &replay;
  for (const StoredEvent& event : events) replay.take(event.view());
  replay.finish();
  if (at_end) at_end(replay);
}

}  // namespace plumb::test
