/// Reads PNG files of a KITTI camera as 8-bit grey images.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

namespace plumb {

struct PngHeader {
  int width_px = 0;
  int height_px = 0;
  int bits_per_channel = 0;
  bool colour = false;  ///< true for anything but plain grey: RGB, palette or alpha
};

/// True when `bytes` begin as those of a PNG.
[[nodiscard]] bool is_png(std::span<const std::uint8_t> bytes);

/// Fills `header` and returns null when `bytes` are a PNG with all its chunks, and else returns the
/// reason. libpng alone would fill a truncated image with black and only warn.
[[nodiscard]] const char* read_png_header(std::span<const std::uint8_t> bytes, PngHeader* header);

/// Reads the grey pixels of `path`. Colour is converted to luma (BT.601) when `colour_allowed`.
/// Throws InputError for a file that cannot be read, is truncated or corrupt, does not have 8 bits
/// per channel, or is in colour although that is not allowed.
[[nodiscard]] cv::Mat load_grey_png(const std::filesystem::path& path, bool colour_allowed);

/// The same for the `bytes` of the file `path`, which were read before.
[[nodiscard]] cv::Mat decode_grey_png(const std::vector<std::uint8_t>& bytes,
                                      const std::filesystem::path& path, bool colour_allowed);

}  // namespace plumb
