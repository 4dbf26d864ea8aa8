/// Converts the pixel formats of cameras to grey.
///
/// Units:
///   Grey is the luma as the camera delivers it. Limited-range luma (16 to 235) is not stretched.
/// Memory:
///   Nothing is allocated; the caller owns input and output.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image_view.hpp"

namespace plumb {

enum class PixelFormat : std::int8_t { kGrey = 0, kYuyv = 1, kNv12 = 2, kMjpeg = 3 };

/// Number of bytes that an image of an uncompressed format has at least; 0 for kMjpeg.
[[nodiscard]] std::size_t required_bytes(PixelFormat format, int height_px,
                                         std::size_t stride_bytes);

/// Number of bytes that a row of an uncompressed format has at least; 0 for kMjpeg.
[[nodiscard]] std::size_t required_stride(PixelFormat format, int width_px);

/// A view of the luma plane in formats that have one (kGrey, kNv12); an empty view for the others.
[[nodiscard]] ImageView luma_plane(PixelFormat format, const std::uint8_t* data, int width_px,
                                   int height_px, std::size_t stride_bytes);

/// Copies the luma of packed Y U Y V pixels to rows without gaps.
/// @pre `grey` has width_px * height_px bytes
void yuyv_to_grey(const std::uint8_t* data, int width_px, int height_px, std::size_t stride_bytes,
                  std::uint8_t* grey);

/// Copies rows with any stride to rows without gaps.
/// @pre `grey` has width_px * height_px bytes
void copy_rows(const ImageView& image, std::uint8_t* grey);

}  // namespace plumb
