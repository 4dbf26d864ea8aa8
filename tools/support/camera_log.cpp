#include "tools/support/camera_log.hpp"

#include <opencv2/imgcodecs.hpp>

#include "modules/camera/image_wire.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kCalibrationPeriod_us = 1'000'000;
constexpr int kJpegQuality = 95;

}  // namespace

void CameraLog::begin_image(std::int64_t capture_us) {
  const bool is_first = num_images_++ == 0;
  if (is_first) first_us_ = capture_us;
  capture_us_ = capture_us;
  if (!is_first && capture_us - calibration_us_ < kCalibrationPeriod_us) return;
  calibration_us_ = capture_us;
  write(kCameraCalibration, to_wire(camera_, capture_us));
}

void CameraLog::write_image(std::int64_t seq, const ImageView& image) {
  if (jpeg_) {
    const cv::Mat pixels(image.height_px, image.width_px, CV_8U,
                         const_cast<std::uint8_t*>(image.data),
                         static_cast<std::size_t>(image.stride_bytes));
    cv::imencode(".jpg", pixels, jpeg_bytes_, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
    to_wire_jpeg(capture_us_, seq, image.width_px, image.height_px, jpeg_bytes_, &message_);
  } else {
    to_wire(capture_us_, seq, image, &message_);
  }
  write(kCamera, message_);
}

std::int64_t CameraLog::close() {
  log_.close();
  return static_cast<std::int64_t>(std::filesystem::file_size(path_));
}

double CameraLog::duration_s() const { return 1e-6 * static_cast<double>(capture_us_ - first_us_); }

}  // namespace plumb
