/// Whether an image can be used at all.
#pragma once

#include "core/image_view.hpp"
#include "modules/vo/vo.hpp"

namespace plumb::vo {

struct ImageLevels {
  double mean_grey = 0.0;
  double std_grey = 0.0;
};

/// Mean and deviation over every fourth row.
[[nodiscard]] ImageLevels measure_levels(const ImageView& image);

/// kNone, kImageDark, kImageFlat or kImageFrozen. Sensor noise makes two images of a standing car differ, so an
/// identical one was never taken. `previous` may be empty.
[[nodiscard]] VoReason judge_image(const ImageView& image, const ImageView& previous,
                                   const VoConfig& config);

}  // namespace plumb::vo
