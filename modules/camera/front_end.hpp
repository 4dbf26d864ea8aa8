/// Checks, rectifies and masks a captured grey image before it is published. This is an algorithm
/// without a clock and without input or output.
///
/// Frames:
///   img: u right, v down; (0,0) is the centre of the upper left pixel.
/// Memory:
///   The tables of the rectifier, the weights of the mask and one previous image. Nothing is
///   allocated after construction.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/stage_probe.hpp"
#include "modules/camera/camera_config.hpp"
#include "modules/camera/ego_mask.hpp"
#include "modules/camera/image_health.hpp"
#include "modules/camera/rectify.hpp"

namespace plumb {

/// The lens and the two pinhole cameras that a configuration describes.
/// @pre the focal lengths are set
[[nodiscard]] Lens lens_of(const CameraConfig& config);
[[nodiscard]] PinholePx captured_pinhole(const CameraConfig& config);
[[nodiscard]] PinholePx published_pinhole(const CameraConfig& config);

/// The camera model that is published on CAMERA_CALIBRATION for images of this size.
[[nodiscard]] CameraModel published_model(const CameraConfig& config, int width_px, int height_px);
/// The same when the configuration states size and focal lengths, else nothing.
[[nodiscard]] std::optional<CameraModel> stated_model(const CameraConfig& config);

/// The reason why images cannot be published with this configuration; empty when they can.
/// `mask_bytes` has the same meaning as for FrontEnd.
[[nodiscard]] std::string why_unusable(const CameraConfig& config, int width_px, int height_px,
                                       const std::uint8_t* mask_bytes);

class FrontEnd {
 public:
  /// `mask_bytes` are the pixels of the mask file, in which non-zero means covered, or null.
  /// @pre why_unusable() is empty; `mask_bytes` has width_px * height_px bytes
  FrontEnd(const CameraConfig& config, int width_px, int height_px, const std::uint8_t* mask_bytes);

  /// Fills `published` (rows without gaps) from `captured` and returns the current fault. A faulty
  /// image is published as well; each reader decides whether to use it.
  /// @pre `captured` has the constructed size
  ImageFault process(const ImageView& captured, std::uint8_t* published, StageProbe* probe);

 private:
  Rectifier rectifier_;
  EgoMask mask_;
  ImageHealth health_;
};

}  // namespace plumb
