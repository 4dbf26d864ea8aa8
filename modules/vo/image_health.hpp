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

/// Returns kNone for a usable image, else kImageDark or kImageFlat.
[[nodiscard]] VoReason judge_image(const ImageView& image, const VoConfig& config);

}  // namespace plumb::vo
