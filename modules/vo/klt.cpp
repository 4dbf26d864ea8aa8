#include "modules/vo/klt.hpp"

#include <algorithm>
#include <cmath>

#include "modules/vo/patch.hpp"

namespace plumb::vo {
namespace {

// When the scale differs less from 1, the template is not warped, because that costs more time than
// it improves the match.
constexpr float kScaleWorthWarping = 0.04F;
constexpr AlignLimits kCoarse{8, 8.0F, 0.15F};
constexpr AlignLimits kFine{12, 5.0F, 0.25F};

// The same conversions as Pyramid::to_level() and from_level(), in single precision.
Eigen::Vector2f to_level(const Eigen::Vector2f& px, int level) {
  const float s = 1.0F / static_cast<float>(1 << level);
  return (px.array() + 0.5F) * s - 0.5F;
}

Eigen::Vector2f from_level(const Eigen::Vector2f& px, int level) {
  const auto s = static_cast<float>(1 << level);
  return (px.array() + 0.5F) * s - 0.5F;
}

}  // namespace

KltMatch klt_search(const Pyramid& from, const Eigen::Vector2f& from_px, const Pyramid& to,
                    const Eigen::Vector2f& guess_px, float scale, int top_level) {
  const bool warp = std::abs(scale - 1.0F) > kScaleWorthWarping;
  const Eigen::Matrix2f A = Eigen::Matrix2f::Identity() / scale;
  Eigen::Vector2f px = guess_px;
  KltMatch match;
  Patch<7> patch;
  for (int l = std::min(top_level, from.num_levels() - 1); l >= 0; --l) {
    const Eigen::Vector2f centre = to_level(from_px, l);
    const bool usable =
        warp && l == 0 ? patch.cut(from.level(l), centre, A) : patch.cut(from.level(l), centre);
    if (!usable) {
      if (l == 0) return match;
      continue;  // the patch leaves the image on this level
    }
    const Alignment found = patch.align(to.level(l), to_level(px, l), l == 0 ? kFine : kCoarse);
    if (found.ok()) {
      px = from_level(found.px, l);
    } else if (l == 0) {
      return match;
    }
    match.ncc = found.ncc;
  }
  match.px = px;
  return match;
}

}  // namespace plumb::vo
