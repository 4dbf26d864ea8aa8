/// The camera's pitch out of detected objects, brought to the newest image: what the paper calls the third cue.
///
/// Delay    detections of an image are used `ground.detections_delay_images` images after it, however early they came:
///          so results depend on the messages, not on how long a detector took. Those that come later are refused. In
///          between the pitch turns with the camera, by VO's rotation.
/// Feedback objects learn their heights from the dense cue's pitch of their own image, never from the filter that this
///          cue enters.
/// Frames   cam, as road_plane.hpp.
/// Source   Song and Chandraker, CVPR 2014: eq. (9), (10) (detection_cue.hpp); model C_d of Algorithm 1.
/// Memory   kMaxWaiting frames of detections and a DetectionCue in place, 500 kB; nothing grows.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "modules/ground/cues/detection_cue.hpp"
#include "modules/ground/types/ground_types.hpp"
#include "modules/ground/types/linear_variance.hpp"

namespace plumb {

class ObjectPitch {
 public:
  static constexpr std::size_t kMaxDelay = 8;
  static constexpr std::size_t kMaxWaiting = 8;

  /// @pre both configs inside the ranges of their visit()
  ObjectPitch(const GroundConfig& config, const DetectionsConfig& detections,
              const CameraModel& camera, const LinearVariance& model);

  /// Null when taken, else why it was refused. A full store lets the oldest go.
  [[nodiscard]] const char* take(const DetectionFrame& frame);
  /// Goes on to the image of `vo`. Its objects' pitch, if there is one; valid until the next call.
  std::span<const ObjectNormal> update(const VoOutput& vo);
  /// What the ground estimator made of that image.
  void note(const PlaneOutput& plane);

 private:
  /// What is known of an image whose detections may still come.
  struct Place {
    std::int64_t seq = -1;
    std::int64_t capture_us = 0;
    Eigen::Matrix3d R_newest_place = Eigen::Matrix3d::Identity();
    bool roll_holds = false;
    double roll_rad = 0.0;
    double roll_var_rad2 = 0.0;
    bool pitch_holds = false;  ///< by the dense cue of this image alone
    double pitch_rad = 0.0;
    double pitch_var_rad2 = 0.0;
  };

  void move_on(const VoOutput& vo);
  [[nodiscard]] const DetectionFrame* find(const Place& place) const;
  [[nodiscard]] bool observe(const Place& place, const DetectionFrame& frame);

  std::size_t delay_;
  bool adapts_;
  double height_m_;
  LinearVariance model_;
  DetectionCue cue_;
  std::array<Place, kMaxDelay + 1> places_{};  ///< newest first
  std::size_t num_places_ = 0;
  std::array<DetectionFrame, kMaxWaiting> waiting_{};
  std::size_t next_waiting_ = 0;
  std::int64_t last_taken_us_ = 0;
  std::int64_t last_due_us_ = 0;
  ObjectNormal normal_;
};

}  // namespace plumb
