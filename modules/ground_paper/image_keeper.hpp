/// Copies of the last images, found by their sequence numbers.
///
/// Memory:
///   kCapacity images, sized at construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

class ImageKeeper {
 public:
  static constexpr std::size_t kCapacity = 12;
  static constexpr std::size_t kNone = kCapacity;

  ImageKeeper(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {
    for (Kept& kept : images_) {
      kept.pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    }
  }

  [[nodiscard]] bool fits(const ImageView& image) const {
    return !image.empty() && image.width_px == width_px_ && image.height_px == height_px_;
  }

  /// Stores a copy in the place of the oldest image, or of the newest one, and returns that place.
  /// @pre fits(image)
  std::size_t push(std::int64_t seq, const ImageView& image, bool replace_newest) {
    if (!replace_newest) newest_ = (newest_ + 1) % kCapacity;
    Kept& kept = images_[newest_];
    kept.seq = seq;
    const auto row_bytes = static_cast<std::size_t>(width_px_);
    for (int v = 0; v < height_px_; ++v) {
      std::memcpy(kept.pixels.data() + static_cast<std::size_t>(v) * row_bytes, image.row(v),
                  row_bytes);
    }
    return newest_;
  }

  /// kNone when the image of `seq` is not stored.
  [[nodiscard]] std::size_t find(std::int64_t seq) const {
    for (std::size_t i = 0; i < kCapacity; ++i) {
      if (seq >= 0 && images_[i].seq == seq) return i;
    }
    return kNone;
  }

  /// @pre place < kCapacity
  [[nodiscard]] ImageView view(std::size_t place) const {
    return {images_[place].pixels.data(), width_px_, height_px_, width_px_};
  }

 private:
  struct Kept {
    std::int64_t seq = -1;
    std::vector<std::uint8_t> pixels;
  };
  int width_px_;
  int height_px_;
  std::size_t newest_ = 0;
  std::array<Kept, kCapacity> images_;
};

}  // namespace plumb
