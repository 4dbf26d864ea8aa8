/// Everything that plumb-vo does between the bytes of CAMERA and the message VO_MOTION. The replay
/// runs the same class.
///
/// The first valid calibration creates the estimator. The same calibration is ignored later, and a
/// different one is refused: the process must be restarted to use it. An image that comes before
/// the calibration yields a motion with LOST and NO_CALIBRATION.
///
/// Memory:
///   The decoder and the estimator are allocated with the first calibration; nothing after it.
/// Errors:
///   take_*() return null when the message was taken, else the reason as a string literal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/counters.hpp"
#include "core/stage_probe.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/vo/vo.hpp"
#include "modules/vo/vo_wire.hpp"

namespace plumb {

class VoNode {
 public:
  /// @param probe  marks the stages "decode", those of the estimator, and "to_wire"; must outlive
  ///               the node
  VoNode(const VoConfig& config, std::uint64_t seed, StageProbe* probe);

  /// Names this run of the process in the motions.
  void set_session(std::int64_t session) { session_ = session; }

  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  /// `arrival_us` is the monotonic time at which the image reached this machine; in a replay it is
  /// the image's own time stamp.
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes,
                                       std::int64_t arrival_us);

  /// Returns the motion to publish after take_image(), or null when there is none.
  [[nodiscard]] const vo_motion_t* motion() const { return fresh_ ? &motion_ : nullptr; }
  [[nodiscard]] bool calibrated() const { return estimator_.has_value(); }
  /// Returns the number of images that never came, by the gaps in their numbers.
  [[nodiscard]] std::int64_t num_lost() const { return losses_.num_lost(); }

 private:
  const char* publish_without_calibration(const ImageFrame& frame);

  VoConfig config_;
  std::uint64_t seed_;
  StageProbe* probe_;
  std::int64_t session_ = 0;
  CameraModel camera_;
  std::optional<ImageDecoder> decoder_;
  std::optional<VisualOdometry> estimator_;
  LossCounter losses_;
  vo_motion_t motion_{};
  bool fresh_ = false;
};

}  // namespace plumb
