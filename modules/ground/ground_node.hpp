/// Everything plumb-ground does between its input messages and its output messages. plumb-replay
/// runs the same class.
///
/// Pairing  A VO motion is processed with the image of its number and time. If that image has not
///          arrived, the motion waits for the image, for the next motion or for expire(), whichever
///          comes first; in the last two cases it is processed without an image (IMAGE_MISSING).
///          Results depend on the messages and never on the clock, as long as no image is lost.
/// Objects  Detections are used `ground.detections_delay_images` images after their own.
/// Start    The first valid calibration makes the estimator. Before it, motions yield INVALID with
///          NO_CALIBRATION.
/// Height   The camera's height over the road is kept in this class alone and handed to everything
///          that needs it, frame by frame: the calibration's or the configured one, until
///          set_camera_height() says otherwise.
/// Memory   PendingImages and what the algorithm needs, at the first calibration.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/counters.hpp"
#include "core/stage_probe.hpp"
#include "modules/camera/calibration_keeper_wire.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/detections/detections_wire.hpp"
#include "modules/ground/cues/objects_queue.hpp"
#include "modules/ground/ground.hpp"
#include "modules/ground/ground_wire.hpp"
#include "modules/ground/pending_images.hpp"
#include "modules/integrity/one_sender.hpp"
#include "modules/integrity/steady_numbers.hpp"
#include "modules/vo/vo_wire.hpp"

namespace plumb {

class GroundNode {
 public:
  /// Takes each result, in the order of the motions.
  using Sink = std::function<void(const ground_plane_t&, const ego_motion_t&)>;

  /// Makes the algorithm, once the camera is known.
  using Factory = std::function<std::unique_ptr<GroundAlgorithm>(const CameraModel&)>;

  /// `probe` must outlive the node; a "decode" stage is marked before the algorithm's own. Without
  /// `make` the algorithm is a GroundEstimator.
  GroundNode(const GroundConfig& config, const DetectionsConfig& detections, StageProbe* probe,
             Sink sink, const GroundModel& model = built_in_ground_model(), Factory make = {});

  /// Names this run of the process in the results.
  void set_session(std::int64_t session) { session_ = session; }

  /// Each returns null when the message was taken, else why it was refused.
  /// States the calibration, instead of the first message.
  void configure_camera(const CameraModel& camera);
  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes);
  /// Leaves an image out. Its motion does not wait for it.
  [[nodiscard]] const char* skip_image(std::span<const std::uint8_t> image_bytes);
  [[nodiscard]] const char* take_motion(const vo_motion_t& message);
  /// Takes detections of any image that was not yet used (objects_queue.hpp).
  [[nodiscard]] const char* take_detections(const detections_t& message);
  /// The image of a waiting motion will not come.
  void expire();

  /// The body has risen or sunk: takes another height of the camera over its road, from the next
  /// motion on. @pre height_m > 0
  void set_camera_height(const CameraHeight& height) {
    camera_height_ = height;
    is_height_correction_ = false;
  }
  /// The height has become better known, and the scale with it. From the next motion on.
  /// @pre height_m > 0
  void correct_camera_height(const CameraHeight& height) {
    camera_height_ = height;
    is_height_correction_ = true;
  }
  /// What the calibration or the configuration states; height_m 0 before a calibration.
  [[nodiscard]] const CameraHeight& stated_height() const { return stated_height_; }

  [[nodiscard]] bool calibrated() const { return algorithm_ != nullptr; }
  /// Number of calibrations that have been taken.
  [[nodiscard]] int num_cameras() const { return num_cameras_; }
  [[nodiscard]] bool waiting() const { return waiting_; }
  /// What went into the newest frame; null before a calibration and when the algorithm does not
  /// tell.
  [[nodiscard]] const CueDiagnostics* diagnostics() const {
    return algorithm_ ? algorithm_->diagnostics() : nullptr;
  }
  /// The newest result, with what the messages leave out (CueReport::features); null before the
  /// first one after a calibration.
  [[nodiscard]] const GroundOutput* output() const { return output_; }
  /// Number of images and motions that never arrived.
  [[nodiscard]] std::int64_t num_lost() const { return losses_.num_lost() + num_motions_lost_; }
  /// Number of images and detections that a full store let go before their turn.
  [[nodiscard]] std::int64_t num_overflowed() const {
    return calibrated() ? images_->num_overflowed() + objects_->num_overflowed() : 0;
  }
  /// Number of motions that were processed without an image.
  [[nodiscard]] std::int64_t num_unpaired() const { return num_unpaired_; }

 private:
  void build();
  [[nodiscard]] const char* follow(const vo_motion_t& message);
  [[nodiscard]] bool falls_behind_again(std::int64_t seq);
  void begin_anew(const vo_motion_t& message);
  void renumber();
  const char* process(const ImageFrame* frame);
  void publish(const GroundOutput& output);

  GroundConfig config_;
  DetectionsConfig detections_;
  GroundModel model_;
  Factory make_;
  StageProbe* probe_;
  Sink sink_;
  std::int64_t session_ = 0;
  CalibrationKeeper calibration_;
  int num_cameras_ = 0;
  CameraHeight stated_height_;
  CameraHeight camera_height_;
  bool is_height_correction_ = false;
  std::optional<ImageDecoder> decoder_;
  std::optional<PendingImages> images_;
  std::unique_ptr<GroundAlgorithm> algorithm_;
  std::unique_ptr<ObjectsQueue> objects_;
  DetectionFrame arrived_;
  const GroundOutput* output_ = nullptr;
  LossCounter losses_;
  VoOutput vo_;  ///< the motion that is processed or waits
  bool waiting_ = false;
  std::int64_t skipped_seq_ = -1;  ///< of the newest image that was left out
  std::int64_t skipped_capture_us_ = 0;
  OneSender sender_;
  SteadyNumbers numbers_;              ///< of the images, as the algorithm sees them
  std::int64_t last_motion_seq_ = -1;  ///< the source's number; -1: none in this time line
  int num_behind_ = 0;                 ///< motions in a row that came after a higher number
  std::int64_t behind_seq_ = 0;        ///< of the newest of them
  std::int32_t epoch_offset_ = 0;      ///< added to VO's scale_epoch
  std::int32_t last_epoch_ = 0;        ///< with the offset
  bool is_new_unit_ = false;        ///< the newest motion is the first of another run of plumb-vo
  bool is_motion_missing_ = false;  ///< the motion before the newest one did not arrive
  std::int64_t num_motions_lost_ = 0;
  std::int32_t reset_offset_ = 0;  ///< resets that earlier algorithms have counted
  std::int64_t num_unpaired_ = 0;
  ground_plane_t plane_{};
  ego_motion_t ego_{};
};

}  // namespace plumb
