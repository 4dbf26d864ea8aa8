/// Everything plumb-ground does between its inputs' messages and its outputs'; the replay runs the same class.
///
/// Pairing  a VO motion is processed with the image of its number and time. If that image is not here yet, the motion
///          waits: for the image, for the next motion, or for expire(), whichever comes first; in the last two cases
///          it is processed without an image (IMAGE_MISSING). Results depend on the messages, never on the clock, as
///          long as no image is lost.
/// Objects  detections enter `ground.detections_delay_images` images after their own.
/// Start    the first sound calibration makes the estimator; before it, motions yield INVALID, NO_CALIBRATION.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/counters.hpp"
#include "core/stage_probe.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/ground/cues/object_pitch.hpp"
#include "modules/ground/ground.hpp"
#include "modules/ground/ground_wire.hpp"
#include "modules/ground/pending_images.hpp"
#include "modules/vo/vo_wire.hpp"

namespace plumb {

class GroundNode {
 public:
  /// Takes each result, in the order of the motions.
  using Sink = std::function<void(const ground_plane_t&, const ego_motion_t&)>;

  /// Makes the estimator, once the camera is known.
  using Factory = std::function<std::unique_ptr<GroundAlgorithm>(
      const GroundConfig&, const CameraModel&, const GroundModel&)>;

  /// `probe` outlives the node; a "decode" stage is marked before the estimator's own.
  GroundNode(const GroundConfig& config, const DetectionsConfig& detections, StageProbe* probe,
             Sink sink, const GroundModel& model = built_in_ground_model(),
             Factory make = make_ground_estimator);

  /// Null when taken, else why it was refused.
  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes);
  [[nodiscard]] const char* take_motion(const vo_motion_t& message);
  /// Detections of any image that is not yet used (object_pitch.hpp).
  [[nodiscard]] const char* take_detections(const detections_t& message);
  /// The image of a waiting motion will not come any more.
  void expire();

  [[nodiscard]] bool calibrated() const { return algorithm_ != nullptr; }
  [[nodiscard]] bool waiting() const { return waiting_; }
  /// What the newest frame's cues saw; null before a calibration and when the algorithm does not tell.
  [[nodiscard]] const GroundSight* sight() const {
    return algorithm_ ? algorithm_->sight() : nullptr;
  }
  /// The newest frame's result with what does not travel (CueObservation::features); null before
  /// the first one after a calibration.
  [[nodiscard]] const GroundOutput* output() const { return output_; }
  /// Images and motions that never arrived.
  [[nodiscard]] std::int64_t num_lost() const { return losses_.num_lost() + num_motions_lost_; }
  /// Motions that were processed without an image.
  [[nodiscard]] std::int64_t num_unpaired() const { return num_unpaired_; }

 private:
  void count_lost_motion(const vo_motion_t& message);
  const char* process(const ImageFrame* frame);
  void publish(const GroundOutput& output);

  GroundConfig config_;
  DetectionsConfig detections_;
  GroundModel model_;
  Factory make_;
  StageProbe* probe_;
  Sink sink_;
  CameraModel camera_;
  std::optional<ImageDecoder> decoder_;
  std::optional<PendingImages> images_;
  std::unique_ptr<GroundAlgorithm> algorithm_;
  std::unique_ptr<ObjectPitch> object_pitch_;
  DetectionFrame arrived_;
  const GroundOutput* output_ = nullptr;
  LossCounter losses_;
  VoOutput vo_;  ///< the motion in hand, or waiting
  bool waiting_ = false;
  bool any_motion_ = false;
  std::int64_t last_motion_seq_ = 0;
  std::int64_t num_motions_lost_ = 0;
  std::int64_t num_unpaired_ = 0;
  ground_plane_t plane_{};
  ego_motion_t ego_{};
};

}  // namespace plumb
