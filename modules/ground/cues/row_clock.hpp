/// Rolling shutter: the share of the motion between two images that passes from row to row.
///
/// A point that lies dy further down (y = Y/Z) is exposed readout * fy / height * dy later. If it
/// moved by dy between two images, the time between its exposures differs by as much from the time
/// between the images.
#pragma once

#include <cstdint>

#include "core/camera_model.hpp"

namespace plumb {

class RowClock {
 public:
  /// @param camera  model of the whole image, not of the rows that ImageRing keeps
  explicit RowClock(const CameraModel& camera)
      : s_per_y_(camera.readout_s * camera.fy_px / camera.height_px) {}

  /// Takes the number and time of every image, in order.
  void take(std::int64_t seq, std::int64_t capture_us) {
    if (seq > seq_ && seq_ >= 0) {
      constexpr double kSecondsPerMicro = 1e-6;
      image_s_ = kSecondsPerMicro * static_cast<double>(capture_us - capture_us_) /
                 static_cast<double>(seq - seq_);
    }
    seq_ = seq;
    capture_us_ = capture_us;
  }

  /// Share of the motion since the image `num_images` ago that passes per unit of y; 0 until two
  /// images have come.
  [[nodiscard]] double lag_per_y(std::int64_t num_images) const {
    return image_s_ > 0.0 ? s_per_y_ / (image_s_ * static_cast<double>(num_images)) : 0.0;
  }

 private:
  double s_per_y_;
  double image_s_ = 0.0;
  std::int64_t seq_ = -1;
  std::int64_t capture_us_ = 0;
};

}  // namespace plumb
