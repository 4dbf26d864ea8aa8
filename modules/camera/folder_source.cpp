#include "modules/camera/folder_source.hpp"

#include <utility>

#include "modules/datasets/folder/grey_image.hpp"
#include "modules/datasets/kitti/sequence.hpp"
#include "modules/datasets/text.hpp"
#include "platform/process.hpp"

namespace plumb {

FolderSource::FolderSource(const ImageFolderOptions& options)
    : folder_(list_image_folder(options)),
      epoch_us_(folder_.images.front().capture_us < kOdometryEpoch_us ? kOdometryEpoch_us : 0),
      image_(load_grey_image(folder_.images.front().path)) {}

void FolderSource::complete(CameraConfig* config) const {
  complete_size(folder_.images.front().path.string(), image_.cols, image_.rows, config);
}

bool FolderSource::read(GreyFrame* frame) {
  if (next_ == folder_.images.size()) return false;
  const FolderImage& entry = folder_.images[next_];
  if (next_ > 0) {  // the constructor read the first one
    cv::Mat image = load_grey_image(entry.path);
    if (image.size() != image_.size()) {
      throw UsageError(format("%s is %dx%d, the images before it are %dx%d", entry.path.c_str(),
                              image.cols, image.rows, image_.cols, image_.rows));
    }
    image_ = std::move(image);
  }
  ++next_;
  *frame = {epoch_us_ + entry.capture_us,
            entry.seq,
            {image_.data, image_.cols, image_.rows, static_cast<std::ptrdiff_t>(image_.step[0])}};
  return true;
}

}  // namespace plumb
