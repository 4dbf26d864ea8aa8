/// Everything that plumb-vo does between the bytes of CAMERA and the message VO_MOTION. The replay
/// runs the same class.
///
/// CalibrationKeeper decides which calibration holds, and ImageJudge which images are used. An
/// image that comes before a calibration yields a motion with LOST and NO_CALIBRATION, and one that
/// comes while calibrations contradict each other, LOST and CALIBRATION_DOUBTED.
///
/// What is attached to the camera is kept over restarts in the file `vo.state_file`.
///
/// Memory:
///   Decoder, judge, estimator and the text of the file are allocated when a calibration begins to
///   hold; nothing after it.
/// Errors:
///   take_*() return null when the message was taken, else the reason as a string literal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/stage_probe.hpp"
#include "modules/camera/calibration_keeper_wire.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/vo/attached_source.hpp"
#include "modules/vo/image_judge_wire.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/vo_wire.hpp"

namespace plumb {

class VoNode {
 public:
  /// @param probe  marks the stages "decode", those of the estimator, and "to_wire"; must outlive
  ///               the node
  VoNode(const VoConfig& config, std::uint64_t seed, StageProbe* probe,
         const IntegrityConfig& integrity = {});
  /// Keeps what is attached to the camera in the file `vo.state_file`, if there is one.
  ~VoNode();
  VoNode(const VoNode&) = delete;
  VoNode& operator=(const VoNode&) = delete;

  /// Names this run of the process in the motions.
  void set_session(std::int64_t session) { session_ = session; }

  /// States the calibration, instead of the first message.
  void configure_camera(const CameraModel& camera);
  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  /// `arrival_us` is the monotonic time at which the image reached this machine; in a replay it is
  /// the image's own time stamp.
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes,
                                       std::int64_t arrival_us);

  /// Returns the motion to publish after take_image(), or null when there is none.
  [[nodiscard]] const vo_motion_t* motion() const { return fresh_ ? &motion_ : nullptr; }
  [[nodiscard]] bool calibrated() const { return estimator_.has_value(); }
  /// Whether calibrations contradict each other.
  [[nodiscard]] bool is_calibration_doubted() const { return calibration_.is_doubted(); }
  /// Returns what is wrong with the camera, in plain words, or null.
  [[nodiscard]] const char* concern() const;
  /// Returns the number of images that never came, by the gaps in their numbers.
  [[nodiscard]] std::int64_t num_lost() const { return judge_ ? judge_->num_lost() : 0; }

 private:
  void build();
  void restore_attached();
  void keep_attached();
  const char* publish_without_calibration(const ImageFrame& frame);

  VoConfig config_;
  IntegrityConfig integrity_;
  std::uint64_t seed_;
  StageProbe* probe_;
  std::int64_t session_ = 0;
  CalibrationKeeper calibration_;
  std::optional<ImageDecoder> decoder_;
  std::optional<ImageJudge> judge_;
  std::optional<VisualOdometry> estimator_;
  std::optional<AttachedFile> attached_file_;
  std::int64_t kept_us_ = 0;  // capture time at which the file was compared last
  vo_motion_t motion_{};
  bool fresh_ = false;
};

}  // namespace plumb
