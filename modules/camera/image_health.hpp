/// Detects faulty images: black, flat (lens covered or fogged, sensor saturated) or frozen.
///
/// Units:
///   Grey levels.
/// Memory:
///   One image, allocated at construction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

enum class ImageFault : std::int8_t { kNone = 0, kBlack = 1, kFlat = 2, kFrozen = 3 };

/// A sentence for the health of the process; empty for kNone.
[[nodiscard]] const char* describe(ImageFault fault);

struct ImageHealthLimits {
  double black_mean = 24.0;  ///< above limited-range black (16) and the noise of a covered sensor
  double flat_std = 3.0;     ///< below that of a road at night under headlamps
  int fault_frames = 3;      ///< consecutive images that raise or clear a fault
};

class ImageHealth {
 public:
  /// @pre width_px, height_px > 0
  ImageHealth(int width_px, int height_px, const ImageHealthLimits& limits);

  /// Checks the next image and returns the current fault. `fault_frames` consecutive faulty images
  /// raise a fault, and as many healthy ones clear it. An image is frozen when every byte equals
  /// that of the previous one, because the noise of a live sensor makes that impossible.
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
