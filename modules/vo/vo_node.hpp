/// Everything plumb-vo does between the bytes of CAMERA and the message VO_MOTION; the replay runs the same class.
///
/// The first sound calibration makes the estimator; a different one later is refused (restart the process), the same
/// one again is ignored. An image that comes before it yields a motion that says LOST, NO_CALIBRATION.
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
  /// `probe` outlives the node; a "decode" stage is marked before the estimator's own.
  VoNode(const VoConfig& config, std::uint64_t seed, StageProbe* probe);

  /// Null when taken, else why it was refused.
  [[nodiscard]] const char* take_calibration(const camera_calibration_t& message);
  [[nodiscard]] const char* take_image(std::span<const std::uint8_t> image_bytes);

  /// What the newest take_image() is to publish; null when it yielded nothing.
  [[nodiscard]] const vo_motion_t* motion() const { return fresh_ ? &motion_ : nullptr; }
  [[nodiscard]] bool calibrated() const { return estimator_.has_value(); }
  [[nodiscard]] std::int64_t num_lost() const { return losses_.num_lost(); }

 private:
  const char* publish_without_calibration(const ImageFrame& frame);

  VoConfig config_;
  std::uint64_t seed_;
  StageProbe* probe_;
  CameraModel camera_;
  std::optional<ImageDecoder> decoder_;
  std::optional<VisualOdometry> estimator_;
  LossCounter losses_;
  vo_motion_t motion_{};
  bool fresh_ = false;
};

}  // namespace plumb
