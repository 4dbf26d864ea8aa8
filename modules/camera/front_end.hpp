/// One captured grey image -> the image that is published: judged, rectified, masked.
///
/// Pure algorithm: no clock, no I/O, no heap after construction. `main.cpp` is the process around
/// it.
///
/// Frames   img: u right, v down, (0,0) is the centre of the upper left pixel.
/// Memory   the rectifier's tables, the mask's weights and one previous image.
#pragma once

#include <cstdint>
#include <string>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/stage_probe.hpp"
#include "modules/camera/camera_config.hpp"
#include "modules/camera/ego_mask.hpp"
#include "modules/camera/image_health.hpp"
#include "modules/camera/rectify.hpp"

namespace plumb {

/// The lens and the two pinholes a configuration states. @pre its focal lengths are set
[[nodiscard]] Lens lens_of(const CameraConfig& config);
[[nodiscard]] PinholePx captured_pinhole(const CameraConfig& config);
[[nodiscard]] PinholePx published_pinhole(const CameraConfig& config);

/// What is published on CAMERA_CALIBRATION for images of this size.
[[nodiscard]] CameraModel published_model(const CameraConfig& config, int width_px, int height_px);

/// Why no image could be published with this configuration; empty when one can. `mask_bytes` as
/// below.
[[nodiscard]] std::string why_unusable(const CameraConfig& config, int width_px, int height_px,
                                       const std::uint8_t* mask_bytes);

class FrontEnd {
 public:
  /// `mask_bytes`: the mask file's pixels, non-zero is covered, or null.
  /// @pre why_unusable() is empty; `mask_bytes` has width_px * height_px bytes
  FrontEnd(const CameraConfig& config, int width_px, int height_px, const std::uint8_t* mask_bytes);

  /// Fills `published` (rows without gaps) from `captured`; returns the fault that stands after it.
  /// A sick image is published all the same: who uses it decides, by the same pixels.
  /// @pre `captured` has the constructed size
  ImageFault process(const ImageView& captured, std::uint8_t* published, StageProbe* probe);

 private:
  Rectifier rectifier_;
  EgoMask mask_;
  ImageHealth health_;
};

}  // namespace plumb
