/// Everything plumb-objects does between its inputs' messages and its output's.
///
/// Pairing  detections are processed with the ground plane and the motion of their own image, however
///          late they come, as long as it is among the last kKept. When they come first they wait: for that plane,
///          for a plane of a later image, for expire(), or until kMaxWaiting others came after them; but in the first
///          case the calibrated plane serves (REASON_CALIBRATED_PLANE).
/// Order    detections of an image that is not newer than the last processed one are refused.
/// Restart  a plane older than the one before is of a source that began anew; so does the tracker.
/// Start    the first sound calibration makes the tracker; detections before it are refused.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/fixed_queue.hpp"
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
  static constexpr std::size_t kKept = 64;  ///< ground planes: six seconds of a 10 Hz camera
  static constexpr std::size_t kMaxWaiting = 3;

  ObjectsNode(const DetectionsConfig& detections, const ObjectsConfig& objects,
              const GroundConfig& ground, Sink sink);

  /// Null when taken, else why it was refused.
  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  [[nodiscard]] const char* take_plane(const ground_plane_t& message);
  [[nodiscard]] const char* take_ego(const ego_motion_t& message);
  [[nodiscard]] const char* take_detections(const detections_t& message);
  /// The planes that detections wait for will not come any more.
  void expire();

  [[nodiscard]] bool calibrated() const { return tracker_.has_value(); }
  [[nodiscard]] bool waiting() const { return !waiting_.empty(); }

 private:
  /// What is kept of one image.
  struct Ground {
    std::int64_t seq = -1;
    std::int64_t capture_us = 0;
    bool plane_holds = false;
    RoadPlane plane;
    bool motion_holds = false;
    std::int32_t reset_counter = 0;
    Se3 T_world_cam;
  };

  const char* pair(const ground_plane_t& plane, const ego_motion_t& ego);
  [[nodiscard]] const Ground* find(std::int64_t seq, std::int64_t capture_us) const;
  [[nodiscard]] RoadPlane calibrated_plane() const;
  void process(const DetectionFrame& frame, const Ground* ground);
  void process_oldest(const Ground* ground);
  void begin_anew();

  DetectionsConfig detections_;
  ObjectsConfig objects_;
  double config_height_m_;
  Sink sink_;
  CameraModel camera_;
  std::optional<ObjectTracker> tracker_;
  std::array<Ground, kKept> kept_{};
  std::size_t next_ = 0;
  ground_plane_t plane_{};  ///< without its ego motion yet
  ego_motion_t ego_{};      ///< without its plane yet
  bool has_plane_ = false;
  bool has_ego_ = false;
  GroundOutput output_;
  DetectionFrame arrived_;
  FixedQueue<DetectionFrame, kMaxWaiting> waiting_;
  std::int64_t newest_plane_us_ = 0;
  bool any_taken_ = false;
  std::int64_t newest_us_ = 0;  ///< of the detections taken last
  bool any_processed_ = false;
  Ground last_;  ///< of the image processed last
  objects_t message_{};
};

}  // namespace plumb
