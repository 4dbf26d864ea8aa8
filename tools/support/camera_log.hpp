/// Writes a camera's images to a log as a camera process publishes them: CAMERA_CALIBRATION with
/// the first image and then once a second of the camera's time, and CAMERA per image.
///
/// Errors:
///   Functions throw LogError.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/camera_model.hpp"
#include "core/channels.hpp"
#include "core/image_view.hpp"
#include "platform/log_file.hpp"
#include "plumb/image_t.hpp"

namespace plumb {

class CameraLog {
 public:
  /// Creates or replaces the file.
  /// @param jpeg  true: JPEG of quality 95; false: plain pixels
  CameraLog(const std::filesystem::path& path, const CameraModel& camera, bool jpeg)
      : path_(path), camera_(camera), jpeg_(jpeg), log_(path.string()) {}

  /// Begins an image: writes the calibration if it is due.
  void begin_image(std::int64_t capture_us);
  /// Writes the pixels of the image that was begun.
  void write_image(std::int64_t seq, const ImageView& image);
  /// Writes a message that belongs to the image that was begun.
  template <typename Message>
  void write(const Channel& channel, const Message& message) {
    const int size = message.getEncodedSize();
    buffer_.resize(static_cast<std::size_t>(size));
    message.encode(buffer_.data(), 0, size);
    log_.write(capture_us_, channel.name, buffer_);
  }

  /// Closes the file and returns its size [bytes].
  std::int64_t close();

  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  [[nodiscard]] std::int64_t num_images() const { return num_images_; }
  /// From the first image to the last.
  [[nodiscard]] double duration_s() const;

 private:
  std::filesystem::path path_;
  CameraModel camera_;
  bool jpeg_;
  LogWriter log_;
  std::int64_t num_images_ = 0;
  std::int64_t first_us_ = 0;
  std::int64_t capture_us_ = 0;       ///< of the newest image
  std::int64_t calibration_us_ = 0;   ///< of the newest calibration
  std::vector<std::uint8_t> buffer_;  ///< the newest message, encoded
  std::vector<std::uint8_t> jpeg_bytes_;
  image_t message_{};
};

}  // namespace plumb
