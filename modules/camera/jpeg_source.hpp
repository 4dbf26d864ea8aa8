/// Decodes JPEG images of one size to grey, by libjpeg.
///
/// Memory:
///   The decoder and its working memory are taken at construction. Baseline images, which is what
///   cameras send, allocate nothing; progressive ones use libjpeg's own heap until they are
///   decoded.
/// Errors:
///   decode() returns null, or the reason as a string literal. What libjpeg only warns of, such as
///   data that end before the last row, is an error here: the rows would be made up.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/image_view.hpp"

namespace plumb {

class JpegDecoder {
 public:
  JpegDecoder(int width_px, int height_px);
  ~JpegDecoder();
  JpegDecoder(JpegDecoder&&) noexcept;

  /// Fills `view`, which is valid until the next call, with the luma of the image. Colour images
  /// are not converted: their luma is what is stored.
  [[nodiscard]] const char* decode(std::span<const std::uint8_t> jpeg, ImageView* view);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
