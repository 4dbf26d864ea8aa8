/// A folder of images as a recording (image_folder.hpp).
///
/// Time:
///   That of the folder. When it begins before 2001, it counts from the start of the recording, and
///   2001-09-09 01:46:40 UTC is added, as for KITTI.
/// Memory:
///   File names and times are read at construction, images one at a time.
#pragma once

#include <opencv2/core/mat.hpp>

#include "modules/camera/recorded_source.hpp"
#include "modules/datasets/folder/image_folder.hpp"

namespace plumb {

class FolderSource final : public RecordedSource {
 public:
  /// Lists the folder and reads the first image. Throws InputError.
  explicit FolderSource(const ImageFolderOptions& options);

  void complete(CameraConfig* config) const override;
  [[nodiscard]] bool read(GreyFrame* frame) override;

  [[nodiscard]] std::int64_t num_frames() const override {
    return static_cast<std::int64_t>(folder_.images.size());
  }
  [[nodiscard]] std::vector<std::string> notes() const override { return folder_.notes; }

 private:
  ImageFolder folder_;
  std::size_t next_ = 0;
  std::int64_t epoch_us_ = 0;
  cv::Mat image_;
};

}  // namespace plumb
