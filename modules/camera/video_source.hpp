/// A video file as a recording, in any container that OpenCV reads.
///
/// Sequence:
///   The number of a frame is its index, from 0.
/// Time:
///   The presentation times of the file are used where they increase,
///   else its nominal frame period.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>

#include "modules/camera/recorded_source.hpp"

namespace plumb {

class VideoSource final : public RecordedSource {
 public:
  /// Opens the file and reads the first frame. Throws UsageError.
  explicit VideoSource(const std::string& file);

  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;
  [[nodiscard]] std::int64_t num_frames() const override;

 private:
  bool load();

  std::string file_;
  cv::VideoCapture capture_;
  double period_us_ = 0.0;
  std::int64_t seq_ = -1;  ///< number of the frame in image_
  std::int64_t capture_us_ = 0;
  bool first_is_loaded_ = false;
  cv::Mat colour_;
  cv::Mat image_;
};

}  // namespace plumb
