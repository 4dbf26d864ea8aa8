/// Pixel formats of cameras -> grey.
///
/// Grey is luma exactly as delivered: limited-range Y (16..235) is not stretched.
/// Memory   none; the caller owns both sides.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image_view.hpp"

namespace plumb {

enum class PixelFormat : std::int8_t { kGrey = 0, kYuyv = 1, kNv12 = 2, kMjpeg = 3 };

/// Bytes a buffer of an uncompressed format must hold; 0 for kMjpeg.
[[nodiscard]] std::size_t required_bytes(PixelFormat format, int height_px,
                                         std::size_t stride_bytes);

/// Shortest row of an uncompressed format; 0 for kMjpeg.
[[nodiscard]] std::size_t required_stride(PixelFormat format, int width_px);

/// The luma plane in place, for formats that have one (kGrey, kNv12); an empty view for the others.
[[nodiscard]] ImageView luma_plane(PixelFormat format, const std::uint8_t* data, int width_px,
                                   int height_px, std::size_t stride_bytes);

/// Packed Y U Y V -> grey rows without gaps. @pre `grey` holds width_px * height_px bytes
void yuyv_to_grey(const std::uint8_t* data, int width_px, int height_px, std::size_t stride_bytes,
                  std::uint8_t* grey);

/// Rows with any stride -> rows without gaps. @pre `grey` holds width_px * height_px bytes
void copy_rows(const ImageView& image, std::uint8_t* grey);

}  // namespace plumb
