/// Checks whether an image shows anything that can be tracked.
#pragma once

#include "core/image_view.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::vo {

struct ImageLevels {
  double mean_grey = 0.0;
  double std_grey = 0.0;
};

/// Measures mean and standard deviation of the grey values of every fourth row.
[[nodiscard]] ImageLevels measure_levels(const ImageView& image);

/// Returns kNone for a usable image, else kImageDark, kImageFlat or kImageFrozen. Sensor noise
/// makes any two images differ, also at a standstill. An image that is identical to the previous
/// one was therefore not taken by a sensor. `previous` may be empty.
[[nodiscard]] VoReason judge_image(const ImageView& image, const ImageView& previous,
                                   const VoConfig& config);

}  // namespace plumb::vo
