#pragma once

#include <cstdint>

namespace plumb::vo {

/// Number and time of the image in hand, against the image before it.
struct FrameTime {
  std::int64_t seq = 0;
  std::int64_t prev_seq = -1;  ///< -1 for the first image
  double dt_s = 0.0;           ///< since the image before; 0 for the first image
};

}  // namespace plumb::vo
