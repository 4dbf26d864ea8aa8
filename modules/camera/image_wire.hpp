/// image_t and camera_calibration_t <-> what the modules use. No LCM instance.
///
/// Reading  the bytes are walked by a bounded reader, never by the generated decoder: a corrupt length cannot make
///          it allocate or throw. What it returns borrows the bytes.
/// Memory   grey images are used where they lie. Compressed ones are decoded by OpenCV (libjpeg) into storage that
///          ImageDecoder keeps; that decoder allocates inside, which is one reason to send grey on an ECU.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "plumb/camera_calibration_t.hpp"
#include "plumb/image_t.hpp"

namespace plumb {

/// A borrowed image_t. Values are as sent, checked against each other.
struct ImageFrame {
  std::int64_t capture_us = 0;
  std::int64_t seq = 0;
  int width_px = 0;
  int height_px = 0;
  int row_stride_bytes = 0;  ///< 0 when compressed
  bool compressed = false;
  std::span<const std::uint8_t> data;
};

/// Null, and `frame` filled, when `bytes` are exactly one sound image_t with a sequence number that Plumbline can
/// read; else why not, as a literal.
[[nodiscard]] const char* read_image(std::span<const std::uint8_t> bytes, ImageFrame* frame);

/// Fills `message` with a grey image, rows packed. Allocates only while `message` grows.
void to_wire(std::int64_t capture_us, std::int64_t seq, const ImageView& image, image_t* message);

/// Fills `message` with a JPEG of the given size.
void to_wire_jpeg(std::int64_t capture_us, std::int64_t seq, int width_px, int height_px,
                  std::span<const std::uint8_t> jpeg, image_t* message);

/// [bytes] that the encoding of an image with `data_bytes` of data takes at most.
[[nodiscard]] constexpr std::size_t max_image_bytes(std::size_t data_bytes) {
  return data_bytes + 128;
}

[[nodiscard]] camera_calibration_t to_wire(const CameraModel& camera, std::int64_t utime);

/// Null, and `camera` filled, when the message describes a camera; else why not.
[[nodiscard]] const char* from_wire(const camera_calibration_t& message, CameraModel* camera);

[[nodiscard]] bool same_camera(const CameraModel& a, const CameraModel& b);

/// Turns frames of one camera into grey views.
class ImageDecoder {
 public:
  ImageDecoder(int width_px, int height_px);
  ~ImageDecoder();

  /// Null when the frame has the camera's size; cheap, touches no pixel.
  [[nodiscard]] const char* check(const ImageFrame& frame) const;
  /// Null, and `view` filled, or why not. The view lasts as long as the frame's bytes and until the next call.
  [[nodiscard]] const char* decode(const ImageFrame& frame, ImageView* view);

 private:
  struct Storage;
  int width_px_;
  int height_px_;
  std::unique_ptr<Storage> storage_;
};

}  // namespace plumb
