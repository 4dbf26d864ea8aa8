/// Copies of the newest image and the one before it, by sequence number.
///
/// Memory  two images, sized at construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "modules/imaging/image_view.hpp"

namespace plumb {

class ImageKeeper {
 public:
  ImageKeeper(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
    for (Kept& kept : images_) {
      kept.pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    }
  }

  [[nodiscard]] bool fits(const ImageView& image) const {
    return !image.empty() && image.width_px == width_px_ && image.height_px == height_px_;
  }

  /// @pre fits(image)
  void push(std::int64_t seq, const ImageView& image) {
    newest_ = 1 - newest_;
    Kept& kept = images_[newest_];
    kept.seq = seq;
    const auto row_bytes = static_cast<std::size_t>(width_px_);
    for (int v = 0; v < height_px_; ++v) {
      std::memcpy(kept.pixels.data() + static_cast<std::size_t>(v) * row_bytes, image.row(v),
                  row_bytes);
    }
  }

  /// Empty when the image of `seq` is not held.
  [[nodiscard]] ImageView find(std::int64_t seq) const {
    for (const Kept& kept : images_) {
      if (seq >= 0 && kept.seq == seq)
        return {kept.pixels.data(), width_px_, height_px_, width_px_};
    }
    return {};
  }

 private:
  struct Kept {
    std::int64_t seq = -1;
    std::vector<std::uint8_t> pixels;
  };
  int width_px_;
  int height_px_;
  std::size_t newest_ = 0;
  std::array<Kept, 2> images_;
};

}  // namespace plumb
