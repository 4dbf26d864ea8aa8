/// Everything that plumb-objects does between its input messages and its output message.
///
/// Pairing:
///   Detections are processed with the ground plane and the motion of their own image, as long as
///   that is among the last kKept. Detections that arrive before their plane wait for it. The wait
///   also ends with a plane of a later image, with expire(), or when kMaxWaiting later detections
///   arrive; the calibrated plane is then used (REASON_CALIBRATED_PLANE).
/// Capture time on this machine's clock:
///   It comes with the plane of the image. Without that plane it is not known.
/// Order:
///   Detections of an image that is not newer than the last one are refused.
/// Initialisation:
///   The tracker is created when a calibration begins to hold (CalibrationKeeper). Detections
///   before it are refused. A plane that is older than the one before means that the source
///   restarted, and resets the tracker.
/// Memory:
///   All storage is allocated at construction, except the tracker, which a calibration creates.
/// Errors:
///   take_*() return null when the message is accepted, and else the reason as a string literal.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/fixed_queue.hpp"
#include "modules/camera/calibration_keeper_wire.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/ground/ground_wire.hpp"
#include "modules/ground/types/ground_config.hpp"
#include "modules/objects/objects.hpp"
#include "modules/objects/objects_wire.hpp"

namespace plumb {

class ObjectsNode {
 public:
  using Sink = std::function<void(const objects_t&)>;
  static constexpr std::size_t kKept = 64;  ///< ground planes, for six seconds at 10 Hz
  static constexpr std::size_t kMaxWaiting = 3;

  ObjectsNode(const DetectionsConfig& detections, const ObjectsConfig& objects,
              const GroundConfig& ground, Sink sink);

  /// States the calibration, instead of the first message.
  void configure_camera(const CameraModel& camera);
  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  [[nodiscard]] const char* take_plane(const ground_plane_t& message);
  [[nodiscard]] const char* take_ego(const ego_motion_t& message);
  [[nodiscard]] const char* take_detections(const detections_t& message);
  /// Processes waiting detections without their planes, which are late.
  void expire();

  [[nodiscard]] bool calibrated() const { return tracker_.has_value(); }
  [[nodiscard]] bool waiting() const { return !waiting_.empty(); }
  /// Planes without the motion of their image and motions without its plane.
  [[nodiscard]] std::int64_t num_lost() const { return num_lost_; }
  /// Detections that were processed without the plane of their image.
  [[nodiscard]] std::int64_t num_unpaired() const { return num_unpaired_; }

 private:
  /// The plane and the motion of one image.
  struct Ground {
    std::int64_t seq = -1;
    std::int64_t capture_us = 0;
    std::int64_t capture_mono_us = 0;  ///< 0: not known
    bool plane_valid = false;
    RoadPlane plane;
    bool motion_valid = false;
    std::int32_t reset_counter = 0;
    Se3 T_world_cam;
  };

  void build();
  const char* pair(const ground_plane_t& plane, const ego_motion_t& ego);
  [[nodiscard]] const Ground* find(std::int64_t seq, std::int64_t capture_us) const;
  [[nodiscard]] RoadPlane calibrated_plane() const;
  void process(const DetectionFrame& frame, const Ground* ground);
  void process_oldest(const Ground* ground);
  void reset();

  DetectionsConfig detections_;
  ObjectsConfig objects_;
  double config_height_m_;
  Sink sink_;
  CalibrationKeeper calibration_;
  std::optional<ObjectTracker> tracker_;
  std::array<Ground, kKept> kept_{};
  std::size_t next_ = 0;
  ground_plane_t plane_{};  ///< waits for the ego motion of its image
  ego_motion_t ego_{};      ///< waits for the plane of its image
  bool has_plane_ = false;
  bool has_ego_ = false;
  std::int64_t num_lost_ = 0;
  std::int64_t num_unpaired_ = 0;
  GroundOutput output_;
  DetectionFrame arrived_;
  FixedQueue<DetectionFrame, kMaxWaiting> waiting_;
  std::int64_t newest_plane_us_ = 0;
  bool any_taken_ = false;
  std::int64_t newest_us_ = 0;  ///< capture time of the newest detections
  bool any_processed_ = false;
  Ground last_;  ///< plane and motion of the last processed image
  objects_t message_{};
};

}  // namespace plumb
