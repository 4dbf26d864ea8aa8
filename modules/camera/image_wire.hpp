/// Converts image_t and camera_calibration_t to the types of the modules and back,
/// without an LCM instance.
///
/// Errors:
///   A bounded reader parses images, not the generated decoder, so that a corrupt length can
///   neither make it allocate nor throw. Functions return null, or the reason as a string literal.
/// Memory:
///   Grey images are used in place: an ImageFrame refers to the bytes that were read.
///   Compressed ones are decoded into storage that ImageDecoder takes with the first of them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "modules/camera/jpeg_source.hpp"
#include "platform/bus.hpp"
#include "plumb/camera_calibration_t.hpp"
#include "plumb/image_t.hpp"

namespace plumb {

/// A parsed image_t that refers to the message's bytes. Its values are consistent with each other.
struct ImageFrame {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  std::int64_t session = 0;  ///< start of the source; 0 when it does not state one
  int width_px = 0;
  int height_px = 0;
  int row_stride_bytes = 0;  ///< 0 when compressed
  bool compressed = false;
  std::span<const std::uint8_t> data;
};

/// Fills `frame` and returns null when `bytes` are exactly one valid image_t with a sequence number
/// and a supported pixel format.
[[nodiscard]] const char* read_image(std::span<const std::uint8_t> bytes, ImageFrame* frame);

/// Fills `message` with a grey image whose rows have no gaps. Allocates only while `message` grows.
/// A `session` of 0 is not written.
void to_wire(std::int64_t capture_us, std::int64_t seq, const ImageView& image, image_t* message,
             std::int64_t session = 0);

/// Fills `message` with a JPEG of the given size.
void to_wire_jpeg(std::int64_t capture_us, std::int64_t seq, int width_px, int height_px,
                  std::span<const std::uint8_t> jpeg, image_t* message);

/// [bytes] The largest encoding of an image with `data_bytes` of data.
[[nodiscard]] constexpr std::size_t max_image_bytes(std::size_t data_bytes) {
  return data_bytes + 128;
}

/// The memory of a reader of CAMERA whose images have at most `max_pixels`.
[[nodiscard]] inline MessageMemory image_memory(int max_pixels) {
  return {max_image_bytes(static_cast<std::size_t>(max_pixels)), RawSubscriber::kQueueImages};
}

[[nodiscard]] camera_calibration_t to_wire(const CameraModel& camera, std::int64_t utime);

/// Fills `camera` and returns null when the message describes a camera.
[[nodiscard]] const char* from_wire(const camera_calibration_t& message, CameraModel* camera);

/// True when every parameter of the two cameras is equal.
[[nodiscard]] bool same_camera(const CameraModel& a, const CameraModel& b);

/// Decodes the frames of one camera to grey images.
class ImageDecoder {
 public:
  ImageDecoder(int width_px, int height_px);

  /// Returns null when the frame has the camera's size. Reads no pixel.
  [[nodiscard]] const char* check(const ImageFrame& frame) const;
  /// Fills `view` and returns null, or returns the reason. The view is valid until the next call,
  /// and no longer than the bytes of the frame.
  [[nodiscard]] const char* decode(const ImageFrame& frame, ImageView* view);

 private:
  int width_px_;
  int height_px_;
  std::optional<JpegDecoder> jpeg_;
};

}  // namespace plumb
