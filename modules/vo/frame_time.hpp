/// Number and time of an image relative to the previous one.
#pragma once

#include <cstdint>

namespace plumb::vo {

struct FrameTime {
  std::int64_t seq = 0;        ///< number of the image
  std::int64_t prev_seq = -1;  ///< number of the previous image; -1 for the first image
  double dt_s = 0.0;           ///< time since the previous image; 0 for the first image
  double unplaced_s = 0.0;     ///< time from the last image with a pose to the previous image
};

}  // namespace plumb::vo
