/// A KITTI odometry folder: image_<n>/<number>.png, times.txt and calib.txt.
///
/// seq      the file's number; numbers may start anywhere, and one that is missing is a lost frame.
/// Time     times.txt in seconds, rounded to 1 us: one row per file, or, when files are missing, one row
///          per number from the first file to the last, or from 0 on.
/// Memory   file names and times are read at construction; frames one by one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

#include "modules/camera/recorded_source.hpp"
#include "modules/camera/rectify.hpp"

namespace plumb {

class KittiSource final : public RecordedSource {
 public:
  /// `camera` 0..3 picks image_<camera> and P<camera>; colour images become grey (2 and 3 only).
  /// Reads everything but the images. Throws UsageError.
  KittiSource(const std::filesystem::path& folder, int camera);

  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;

  [[nodiscard]] std::size_t num_frames() const { return entries_.size(); }

 private:
  struct Entry {
    std::int64_t number;
    std::filesystem::path file;
    std::int64_t capture_us;
  };
  void list_images(const std::filesystem::path& folder);
  void assign_times(const std::filesystem::path& file);
  void load(const std::filesystem::path& file);

  bool allow_colour_;
  std::vector<Entry> entries_;
  PinholePx pinhole_;
  std::size_t next_ = 0;
  cv::Size size_;
  cv::Mat image_;
};

}  // namespace plumb
