/// Tells a sick image from a healthy one: black, flat (covered, fogged, saturated) or frozen.
///
/// Units    grey levels.
/// Memory   one image, allocated at construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

enum class ImageFault : std::int8_t { kNone = 0, kBlack = 1, kFlat = 2, kFrozen = 3 };

/// One sentence for process health; empty for kNone.
[[nodiscard]] const char* describe(ImageFault fault);

struct ImageHealthLimits {
  double black_mean = 24.0;  ///< above limited-range black (16) and a capped sensor's noise
  double flat_std = 3.0;     ///< a road at night under head lamps has more
  int fault_frames = 3;      ///< in a row, to raise and to clear
};

class ImageHealth {
 public:
  /// @pre width_px, height_px > 0
  ImageHealth(int width_px, int height_px, const ImageHealthLimits& limits);

  /// Judges the next image; returns the fault that stands after it. A fault is raised by
  /// `fault_frames` sick images in a row and cleared by as many healthy ones.
  /// Frozen is equality of every byte: a live sensor has noise.
  /// @pre `image` has the constructed size
  ImageFault update(const ImageView& image);

  [[nodiscard]] ImageFault fault() const { return fault_; }
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] double std_dev() const { return std_dev_; }

 private:
  void measure(const ImageView& image);
  [[nodiscard]] bool equals_previous(const ImageView& image) const;
  [[nodiscard]] ImageFault judge(bool frozen) const;

  ImageHealthLimits limits_;
  std::vector<std::uint8_t> previous_;
  bool has_previous_ = false;
  double mean_ = 0.0;
  double std_dev_ = 0.0;
  ImageFault fault_ = ImageFault::kNone;
  ImageFault pending_ = ImageFault::kNone;
  int num_pending_ = 0;
};

}  // namespace plumb
