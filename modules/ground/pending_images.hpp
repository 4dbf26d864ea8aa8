/// Copies of the newest images that wait for the VO motion of the same frame.
///
/// Memory:
///   `num_slots` images at construction (30 MB for 64 of KITTI). When all are taken, the oldest is
///   dropped and counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/camera/image_wire.hpp"

namespace plumb {

class PendingImages {
 public:
  PendingImages(int width_px, int height_px, std::size_t num_slots);

  /// False when the image does not fit a slot.
  [[nodiscard]] bool put(const ImageFrame& frame);
  /// The image of that number and time; null when it is not stored. Valid until the next put().
  [[nodiscard]] const ImageFrame* find(std::int64_t seq, std::int64_t capture_us) const;
  /// Drops `frame`, which find() returned, and all images before it.
  void drop_through(const ImageFrame* frame);
  /// Images that were dropped because all slots were taken.
  [[nodiscard]] std::int64_t num_overflowed() const { return num_overflowed_; }

 private:
  std::size_t slot_bytes_;
  std::vector<std::uint8_t> storage_;
  std::vector<ImageFrame> frames_;  ///< one per slot, oldest first, beginning at first_
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::int64_t num_overflowed_ = 0;
};

}  // namespace plumb
