/// Pyramidal KLT search (Lucas & Kanade 1981; Bouguet 2000) for one point from one image to
/// another, with the inverse compositional alignment of patch.hpp.
///
/// Frames:
///   img: level 0 of the pyramids.
#pragma once

#include <Eigen/Core>

#include "core/pyramid.hpp"

namespace plumb::vo {

struct KltMatch {
  Eigen::Vector2f px = Eigen::Vector2f::Zero();
  float ncc = -1.0F;  ///< normalised cross-correlation, in (-1, 1]; -1 when the search failed
  [[nodiscard]] bool ok() const { return ncc > -1.0F; }
};

/// Searches the patch around `from_px`, 15 x 15 pixels on every level, in `to`. The search starts
/// at `guess_px` on level `top_level`. The patch appears `scale` times as large in `to`; this is
/// taken into account on level 0 only.
[[nodiscard]] KltMatch klt_search(const Pyramid& from, const Eigen::Vector2f& from_px,
                                  const Pyramid& to, const Eigen::Vector2f& guess_px, float scale,
                                  int top_level);

}  // namespace plumb::vo
