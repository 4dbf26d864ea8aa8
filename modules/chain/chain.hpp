/// The live chain in one process: CAMERA of a log -> vo -> ground -> can, with DETECTIONS ->
/// objects, as fast as it goes.
///
/// It runs the classes that plumb-vo, plumb-ground and plumb-can run, and hands on the messages
/// they would publish, so its results are theirs bit for bit as long as no image is lost. Nothing
/// but the log's own time stamps enters.
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

/// What became of one image.
struct FrameRecord {
  std::int64_t seq = 0;
  std::int64_t capture_us = 0;
  const char* refused = nullptr;    ///< why the chain did not take the image; null when it did
  const vo_motion_t* vo = nullptr;  ///< null when refused, like the two below
  const ground_plane_t* plane = nullptr;
  const ego_motion_t* ego = nullptr;
  const StageTimer* vo_timer = nullptr;
  const StageTimer* ground_timer = nullptr;
};

/// Takes the log's events in order.
class Chain {
 public:
  using Sink = std::function<void(const FrameRecord&)>;

  using ObjectsSink = std::function<void(const objects_t&)>;

  /// `can_sink` may be null. `sink` is called once per image, `objects_sink` (may be empty) once
  /// per image that was searched for objects.
  Chain(const PlumbConfig& config, std::uint64_t seed, CanSink* can_sink, Sink sink,
        ObjectsSink objects_sink = {});

  void take(const LogEvent& event);
  /// The log is over: CAN frames that wait are sent.
  void finish();

  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }
  /// "frame 12: why", or "CAMERA_CALIBRATION: why", of what was refused first; empty when nothing
  /// was.
  [[nodiscard]] const std::string& first_refusal() const { return first_refusal_; }
  [[nodiscard]] std::int64_t num_lost() const { return vo_.num_lost(); }
  [[nodiscard]] bool calibrated() const { return vo_.calibrated(); }
  [[nodiscard]] const GroundNode& ground() const { return ground_; }
  /// From this log alone: a state file is neither read nor written.
  [[nodiscard]] const MountReport& mount() const { return mount_.report(); }
  [[nodiscard]] const StageTimer& vo_timer() const { return vo_timer_; }
  [[nodiscard]] const StageTimer& ground_timer() const { return ground_timer_; }

 private:
  void take_calibration(std::span<const std::uint8_t> bytes);
  void take_image(std::span<const std::uint8_t> bytes);
  void take_detections(std::span<const std::uint8_t> bytes);
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
  const ground_plane_t* plane_ = nullptr;  ///< of the image in hand
  const ego_motion_t* ego_ = nullptr;
  const mount_t* mount_message_ = nullptr;  ///< null for most images
  std::int64_t num_frames_ = 0;
  std::int64_t num_refused_ = 0;
  std::string first_refusal_;
};

}  // namespace plumb
