#include "modules/chain/chain.hpp"

#include <initializer_list>

#include "core/channels.hpp"
#include "modules/camera/front_end.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/chain/ground_algorithm.hpp"
#include "platform/bounded_decode.hpp"

namespace plumb {
namespace {

template <typename Config>
Config without_file(Config config) {
  config.state_file.clear();
  return config;
}

/// The first reason that is not null; null when all are.
const char* first_of(std::initializer_list<const char*> reasons) {
  for (const char* reason : reasons) {
    if (reason != nullptr) return reason;
  }
  return nullptr;
}

}  // namespace

Chain::Chain(const PlumbConfig& config, std::uint64_t seed, CanSink* can_sink, Sink sink,
             ObjectsSink objects_sink)
    : models_(load_models(config.ground.model_file)),
      vo_(without_file(config.vo), seed, &vo_timer_, config.integrity),
      ground_(
          config.ground, config.detections, &ground_timer_,
          [this](const ground_plane_t& plane, const ego_motion_t& ego) {
            plane_ = &plane;
            ego_ = &ego;
            if (ground_.output() != nullptr) watch_mount();
          },
          models_.ground, ground_factory(config, models_)),
      mount_(without_file(config.mount)),
      objects_(config.detections, config.objects, config.ground,
               [this](const objects_t& objects) { take_objects(objects); }),
      can_(config.can, config.vehicle),
      can_sink_(can_sink),
      sink_(std::move(sink)),
      objects_sink_(std::move(objects_sink)) {
  if (const auto camera = stated_model(config.camera)) {
    vo_.configure_camera(*camera);
    ground_.configure_camera(*camera);
    objects_.configure_camera(*camera);
  }
}

void Chain::take(const LogEvent& event) {
  if (event.channel == kCameraCalibration.name) take_calibration(event.data);
  if (event.channel == kCamera.name) take_image(event.data);
  if (event.channel == kDetections.name) take_detections(event.data);
  if (event.channel == kVehicleSpeed.name) take_vehicle_speed(event.data);
}

void Chain::take_calibration(std::span<const std::uint8_t> bytes) {
  camera_calibration_t message;
  if (!decode_bounded(bytes, &message)) {
    return refuse(kCameraCalibration.name, "not a camera_calibration_t");
  }
  const char* why = first_of({vo_.take_calibration(message), ground_.take_calibration(message),
                              objects_.take_calibration(message)});
  if (why != nullptr) refuse(kCameraCalibration.name, why);
}

void Chain::take_image(std::span<const std::uint8_t> bytes) {
  ImageFrame frame;
  if (const char* why = read_image(bytes, &frame)) return refuse("an image", why);
  FrameRecord record;
  record.seq = frame.seq;
  record.capture_us = frame.capture_us;
  record.vo_timer = &vo_timer_;
  record.ground_timer = &ground_timer_;
  plane_ = nullptr;
  ego_ = nullptr;
  mount_message_ = nullptr;
  // Live, CAMERA reaches plumb-ground before the motion that plumb-vo makes of it.
  const char* ground_refused = ground_.take_image(bytes);
  const char* vo_refused = vo_.take_image(bytes, frame.capture_us);
  record.vo = vo_.motion();
  if (record.vo != nullptr) {
    vo_timer_.end();
    if (const char* why = take_motion(*record.vo)) ground_refused = why;
  }
  record.refused = first_of({vo_refused, ground_refused});
  if (plane_ != nullptr) {
    record.plane = plane_;
    record.ego = ego_;
    const char* plane_refused = objects_.take_plane(*plane_);
    const char* ego_refused = objects_.take_ego(*ego_);
    record.refused = first_of({record.refused, ego_refused, plane_refused});
    send_can();
  }
  if (record.refused != nullptr) refuse("frame " + std::to_string(frame.seq), record.refused);
  ++num_frames_;
  sink_(record);
}

const char* Chain::take_motion(const vo_motion_t& motion) {
  const char* refused = ground_.take_motion(motion);
  ground_.expire();  // The image of a motion never comes later in a log.
  ground_timer_.end();
  return refused;
}

void Chain::take_detections(std::span<const std::uint8_t> bytes) {
  detections_t message;
  if (!decode_bounded(bytes, &message)) return refuse(kDetections.name, "not a detections_t");
  const char* why = first_of({ground_.take_detections(message), objects_.take_detections(message)});
  objects_.expire();  // The plane of an image never comes later in a log.
  if (why != nullptr) refuse(kDetections.name, why);
}

void Chain::take_vehicle_speed(std::span<const std::uint8_t> bytes) {
  vehicle_speed_t message;
  if (!decode_bounded(bytes, &message)) return refuse(kVehicleSpeed.name, "not a vehicle_speed_t");
  if (const char* why = mount_.take_speed(message)) refuse(kVehicleSpeed.name, why);
}

void Chain::watch_mount() {
  mount_message_ = mount_.update(*ground_.output(), ground_.stated_height(), ground_.num_cameras());
  if (const CameraHeight* height = mount_.better_height()) ground_.correct_camera_height(*height);
}

void Chain::take_objects(const objects_t& objects) {
  if (objects_sink_) objects_sink_(objects);
  if (can_sink_ == nullptr) return;
  can_.advance(objects.utime, *can_sink_);
  can_.on_objects(objects, objects.utime);
}

void Chain::send_can() {
  if (can_sink_ == nullptr) return;
  can_.advance(plane_->utime, *can_sink_);
  can_.on_ground_plane(*plane_, plane_->utime);
  can_.on_ego_motion(*ego_, ego_->utime);
  if (mount_message_ != nullptr) can_.on_mount(*mount_message_, mount_message_->utime);
}

void Chain::finish() {
  if (can_sink_ != nullptr) can_.finish(*can_sink_);
}

void Chain::refuse(const std::string& what, const char* why) {
  if (num_refused_++ == 0) first_refusal_ = what + ": " + why;
}

}  // namespace plumb
