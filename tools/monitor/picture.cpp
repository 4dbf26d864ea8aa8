#include "tools/monitor/picture.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace plumb {

const char* PictureEncoder::encode(std::span<const std::uint8_t> bytes, ImageFrame* frame,
                                   std::vector<std::uint8_t>* out) {
  if (const char* why = read_image(bytes, frame)) return why;
  if (frame->compressed) {
    out->insert(out->end(), frame->data.begin(), frame->data.end());
    return nullptr;
  }
  // OpenCV has no view of constant pixels; nothing writes to them.
  cv::Mat grey(frame->height_px, frame->width_px, CV_8U,
               const_cast<std::uint8_t*>(frame->data.data()),
               static_cast<std::size_t>(frame->row_stride_bytes));
  while (grey.cols > kMaxWidthPx) {
    cv::Mat half;
    cv::resize(grey, half, {}, 0.5, 0.5, cv::INTER_AREA);
    grey = half;
  }
  if (!cv::imencode(".jpg", grey, jpeg_, {cv::IMWRITE_JPEG_QUALITY, kQuality}))
    return "the picture cannot be encoded";
  out->insert(out->end(), jpeg_.begin(), jpeg_.end());
  return nullptr;
}

}  // namespace plumb
