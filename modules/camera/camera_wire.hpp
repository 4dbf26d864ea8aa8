/// Grey images and calibrations <-> image_t and camera_calibration_t.
///
/// Memory   an ImageMessage holds its pixels and metadata from construction on.
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/geometry/camera_model.hpp"
#include "plumb/camera_calibration_t.hpp"
#include "plumb/image_t.hpp"

namespace plumb {

/// An image_t of fixed size: 8-bit grey, rows without gaps, "seq" in its metadata.
class ImageMessage {
 public:
  ImageMessage(int width_px, int height_px);

  /// Where the pixels go: width_px * height_px bytes.
  [[nodiscard]] std::uint8_t* pixels() { return message_.data.data(); }
  /// The message around the pixels.
  [[nodiscard]] const image_t& stamped(std::int64_t capture_us, std::int64_t seq);
  /// Bytes of its encoding.
  [[nodiscard]] std::size_t encoded_bytes() const;

 private:
  image_t message_;
};

/// The sequence number of an image; false when its metadata has none.
[[nodiscard]] bool read_seq(const image_t& message, std::int64_t* seq);

[[nodiscard]] camera_calibration_t to_wire(const CameraModel& model, std::int64_t capture_us);

}  // namespace plumb
