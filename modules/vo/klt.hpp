/// Pyramidal search for one point from one image to the next.
#pragma once

#include <Eigen/Core>

#include "core/pyramid.hpp"

namespace plumb::vo {

struct KltMatch {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  float ncc = -1.0F;  ///< -1 when the search failed
  [[nodiscard]] bool ok() const { return ncc > -1.0F; }
};

/// Finds the neighbourhood of `from_px` (15 x 15 pixels at each level) in `to`, starting at `guess_px` on level
/// `top_level`. `scale` is how much larger the neighbourhood appears in `to`; it is applied on level 0 only.
[[nodiscard]] KltMatch klt_search(const Pyramid& from, const Eigen::Vector2f& from_px,
                                  const Pyramid& to, const Eigen::Vector2f& guess_px, float scale,
                                  int top_level);

}  // namespace plumb::vo
