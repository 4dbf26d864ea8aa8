/// Detections that wait for their turn, and the camera's pitch from them, brought to the newest
/// image: the measurement of the objects cue.
///
/// Delay:
///   Detections of an image are used `ground.detections_delay_images` images after it, however
///   early they came, so that results depend on the messages and not on the time that a detector
///   took. Later ones are refused. In between, the pitch turns with the camera by VO's rotation.
/// Feedback:
///   Objects learn their heights from the dense cue's pitch in their own image, never from the
///   filter that fuses this cue.
/// Frames:
///   cam, as in road_plane.hpp.
/// Source:
///   Song and Chandraker, CVPR 2014: equations (9) and (10), see objects_pitch.hpp; model C_d of
///   Algorithm 1.
/// Memory:
///   kMaxWaiting frames of detections and an ObjectsPitch in place, 500 kB; nothing grows.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "modules/ground/cues/objects_pitch.hpp"
#include "modules/ground/types/ground_types.hpp"
#include "modules/ground/types/linear_variance.hpp"

namespace plumb {

class ObjectsQueue {
 public:
  static constexpr std::size_t kMaxDelay = 8;
  static constexpr std::size_t kMaxWaiting = 8;

  /// @pre both configs inside the ranges of their visit()
  ObjectsQueue(const GroundConfig& config, const DetectionsConfig& detections,
               const CameraModel& camera, const LinearVariance& model);

  /// Returns null when taken, else why the frame was refused. When full, the oldest frame is
  /// dropped, and counted unless its turn has passed.
  [[nodiscard]] const char* take(const DetectionFrame& frame);
  /// Proceeds to the image of `vo`, taken at `camera_height`. Returns the pitch from its objects,
  /// or nothing; valid until the next call.
  std::span<const ObjectsMeasurement> update(const VoOutput& vo, const CameraHeight& camera_height);
  /// The detections that the last update() took, whether they gave a pitch or not.
  [[nodiscard]] const DueDetections& due() const { return due_; }
  /// Frames that were dropped before their turn.
  [[nodiscard]] std::int64_t num_overflowed() const { return num_overflowed_; }
  /// Takes the plane that the ground estimator found in that image.
  void note(const PlaneOutput& plane);

 private:
  /// What is known about an image whose detections may still come.
  struct Place {
    std::int64_t seq = -1;
    std::int64_t capture_us = 0;
    Eigen::Matrix3d R_newest_place = Eigen::Matrix3d::Identity();
    bool has_roll = false;
    double roll_rad = 0.0;
    double roll_var_rad2 = 0.0;
    bool has_pitch = false;  ///< from the dense cue in this image alone
    double pitch_rad = 0.0;
    double pitch_var_rad2 = 0.0;
  };

  void proceed_to(const VoOutput& vo);
  [[nodiscard]] const DetectionFrame* find(const Place& place) const;
  [[nodiscard]] bool measure(const Place& place, const DetectionFrame& frame, double height_m);

  std::size_t delay_;
  bool adapts_;
  LinearVariance model_;
  ObjectsPitch pitch_;
  std::array<Place, kMaxDelay + 1> places_{};  ///< newest first
  std::size_t num_places_ = 0;
  std::array<DetectionFrame, kMaxWaiting> waiting_{};
  std::size_t next_waiting_ = 0;
  std::int64_t last_taken_us_ = 0;
  std::int64_t last_due_us_ = 0;
  std::int64_t num_overflowed_ = 0;
  ObjectsMeasurement measured_;
  DueDetections due_;
};

}  // namespace plumb
