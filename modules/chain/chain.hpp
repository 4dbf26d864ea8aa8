/// The chain in one process: all that the live processes do with the messages of a log, as fast as
/// possible. This is the one wiring of the modules. Replay, trainer, calibration and tests use it.
///
/// Flow:
///   message of the log   | taken by, in this order      | which gives
///   CAMERA_CALIBRATION   | vo, ground, objects          |
///   CAMERA               | ground, which stores it; vo  | VO_MOTION
///     VO_MOTION          | ground                       | GROUND_PLANE, EGO_MOTION
///     GROUND_PLANE       | mount (ground's own output)  | MOUNT, about once a second
///     and EGO_MOTION     | objects, can                 |
///     MOUNT              | can                          |
///   VEHICLE_SPEED        | mount, whose height ground   |
///                        | uses for later images        |
///   DETECTIONS           | ground, for later images;    |
///                        | objects                      | OBJECTS
///     OBJECTS            | can                          | CAN frames, on the sink
///   Other channels are ignored.
/// Live:
///   The nodes are those of plumb-vo, plumb-ground, plumb-objects and plumb-can, and each of them
///   gets its messages in the order in which it gets them live. The results are those of the live
///   processes bit for bit as long as no message is lost or late. Only time stamps in the log
///   count, and no clock does. State files are neither read nor written.
/// Errors:
///   A message that a node refuses is counted, and the first reason is kept.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "modules/can/can_wire.hpp"
#include "modules/chain/model_file_source.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/ground/ground_node.hpp"
#include "modules/mount/mount_node.hpp"
#include "modules/objects/objects_node.hpp"
#include "modules/vo/vo_node.hpp"
#include "platform/log_file.hpp"
#include "platform/stage_timer.hpp"

namespace plumb {

/// The results for one image. Messages are valid during the call of the sink.
struct FrameRecord {
  std::int64_t seq = 0;
  std::int64_t capture_us = 0;
  const char* refused = nullptr;    ///< why the chain did not take the image; null when it did
  const vo_motion_t* vo = nullptr;  ///< null when refused, as the two below
  const ground_plane_t* plane = nullptr;
  const ego_motion_t* ego = nullptr;
  const StageTimer* vo_timer = nullptr;
  const StageTimer* ground_timer = nullptr;
};

/// Takes the events of a log in their order.
class Chain {
 public:
  using Sink = std::function<void(const FrameRecord&)>;
  using ObjectsSink = std::function<void(const objects_t&)>;

  /// `can_sink` may be null. `sink` is called once per image, and `objects_sink`, which may be
  /// empty, once per message on DETECTIONS that has been used.
  Chain(const PlumbConfig& config, std::uint64_t seed, CanSink* can_sink, Sink sink,
        ObjectsSink objects_sink = {});

  void take(const LogEvent& event);
  /// Sends the CAN frames that wait. Call it after the last message.
  void finish();

  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }
  /// The first refusal, as "frame 12: why" or "CAMERA_CALIBRATION: why"; empty without one.
  [[nodiscard]] const std::string& first_refusal() const { return first_refusal_; }
  [[nodiscard]] std::int64_t num_lost() const { return vo_.num_lost(); }
  [[nodiscard]] bool calibrated() const { return vo_.calibrated(); }
  [[nodiscard]] const GroundNode& ground() const { return ground_; }
  /// The mount as found from this log alone.
  [[nodiscard]] const MountReport& mount() const { return mount_.report(); }
  [[nodiscard]] const HeightReport& height() const { return mount_.height_report(); }
  [[nodiscard]] const StageTimer& vo_timer() const { return vo_timer_; }
  [[nodiscard]] const StageTimer& ground_timer() const { return ground_timer_; }

 private:
  void take_calibration(std::span<const std::uint8_t> bytes);
  void take_image(std::span<const std::uint8_t> bytes);
  const char* take_motion(const vo_motion_t& motion);
  void take_detections(std::span<const std::uint8_t> bytes);
  void take_vehicle_speed(std::span<const std::uint8_t> bytes);
  void watch_mount();
  void take_objects(const objects_t& objects);
  void send_can();
  void refuse(const std::string& what, const char* why);

  TrainedModels models_;
  StageTimer vo_timer_;
  StageTimer ground_timer_;
  VoNode vo_;
  GroundNode ground_;
  MountNode mount_;
  ObjectsNode objects_;
  CanOutput can_;
  CanSink* can_sink_;
  Sink sink_;
  ObjectsSink objects_sink_;
  const ground_plane_t* plane_ = nullptr;  ///< of the current image
  const ego_motion_t* ego_ = nullptr;
  const mount_t* mount_message_ = nullptr;  ///< null for most images
  std::int64_t num_frames_ = 0;
  std::int64_t num_refused_ = 0;
  std::string first_refusal_;
};

}  // namespace plumb
