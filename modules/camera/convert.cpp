#include "modules/camera/convert.hpp"

#include <cstring>

namespace plumb {

std::size_t required_stride(PixelFormat format, int width_px) {
  const auto width = static_cast<std::size_t>(width_px);
  switch (format) {
    case PixelFormat::kGrey:
    case PixelFormat::kNv12:
      return width;
    case PixelFormat::kYuyv:
      return (width + 1) / 2 * 4;
    case PixelFormat::kMjpeg:
      break;
  }
  return 0;
}

std::size_t required_bytes(PixelFormat format, int height_px, std::size_t stride_bytes) {
  const auto height = static_cast<std::size_t>(height_px);
  switch (format) {
    case PixelFormat::kGrey:
    case PixelFormat::kYuyv:
      return stride_bytes * height;
    case PixelFormat::kNv12:
      return stride_bytes * (height + (height + 1) / 2);
    case PixelFormat::kMjpeg:
      break;
  }
  return 0;
}

ImageView luma_plane(PixelFormat format, const std::uint8_t* data, int width_px, int height_px,
                     std::size_t stride_bytes) {
  if (format != PixelFormat::kGrey && format != PixelFormat::kNv12) return {};
  return {data, width_px, height_px, static_cast<std::ptrdiff_t>(stride_bytes)};
}

void yuyv_to_grey(const std::uint8_t* data, int width_px, int height_px, std::size_t stride_bytes,
                  std::uint8_t* grey) {
  const auto width = static_cast<std::size_t>(width_px);
  for (int v = 0; v < height_px; ++v) {
    const std::uint8_t* row = data + static_cast<std::size_t>(v) * stride_bytes;
    std::uint8_t* out = grey + static_cast<std::size_t>(v) * width;
    for (std::size_t u = 0; u < width; ++u) out[u] = row[2 * u];
  }
}

void copy_rows(const ImageView& image, std::uint8_t* grey) {
  const auto width = static_cast<std::size_t>(image.width_px);
  if (image.stride_bytes == image.width_px) {
    std::memcpy(grey, image.data, width * static_cast<std::size_t>(image.height_px));
    return;
  }
  for (int v = 0; v < image.height_px; ++v) {
    std::memcpy(grey + static_cast<std::size_t>(v) * width, image.row(v), width);
  }
}

}  // namespace plumb
