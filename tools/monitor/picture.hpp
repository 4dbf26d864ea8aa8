/// Turns an image_t into a JPEG for the page.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "modules/camera/image_wire.hpp"

namespace plumb {

class PictureEncoder {
 public:
  static constexpr int kMaxWidthPx = 1280;  ///< wider images are halved until they fit
  static constexpr int kQuality = 78;

  /// Appends the JPEG of the image_t in `bytes` to `out`; an image that is compressed already is
  /// taken as it is. Returns null, or why there is none. `frame` says what image it is.
  const char* encode(std::span<const std::uint8_t> bytes, ImageFrame* frame,
                     std::vector<std::uint8_t>* out);

 private:
  std::vector<std::uint8_t> jpeg_;
};

}  // namespace plumb
