/// Ring of the last images as pyramids, found by their sequence numbers.
///
/// It keeps only rows that can show road: from a little above the horizon of a level camera to the
/// bottom. `camera()` is the model of these rows, and every pixel coordinate of the dense cue
/// refers to it.
///
/// Memory:
///   kCapacity pyramids, sized at construction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/camera_model.hpp"
#include "core/image_view.hpp"
#include "core/pyramid.hpp"

namespace plumb {

class ImageRing {
 public:
  static constexpr std::size_t kCapacity = 16;

  explicit ImageRing(const CameraModel& camera);

  /// Model of the kept rows: the camera with its principal point moved up.
  [[nodiscard]] const CameraModel& camera() const { return camera_; }
  [[nodiscard]] int num_levels() const { return num_levels_; }
  [[nodiscard]] bool fits(const ImageView& image) const;

  /// Stores a copy in place of the oldest image. @pre fits(image)
  const Pyramid& push(std::int64_t seq, const ImageView& image);
  /// Stores a copy in place of the newest image, so that older views stay. @pre fits(image)
  const Pyramid& replace_newest(std::int64_t seq, const ImageView& image);

  /// Null when the ring does not have the image of `seq`.
  [[nodiscard]] const Pyramid* find(std::int64_t seq) const;

 private:
  static constexpr std::int64_t kNone = -1;

  CameraModel camera_;
  int first_row_ = 0;
  int full_height_px_ = 0;
  int num_levels_ = 0;
  std::size_t next_ = 0;
  std::array<std::int64_t, kCapacity> seqs_{};
  std::vector<Pyramid> pyramids_;
};

}  // namespace plumb
