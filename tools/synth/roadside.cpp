#include <cmath>

#include "tools/synth/random.hpp"
#include "tools/synth/scene.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Places built things beside and above the route.
class Builder {
 public:
  Builder(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still)
      : terrain_(terrain), random_(hash_keys(seed, 0xb417)), still_(still) {}

  /// A box whose middle is `d_m` to the left of the lane, standing `bottom_m` above the ground.
  Primitive& box(double s_m, double d_m, const Vector3d& half, double bottom_m, Material material,
                 double albedo) {
    const RoutePoint at = terrain_.route().at(s_m);
    const Vector2d p = at.p_map + d_m * Vector2d(-std::sin(at.yaw_rad), std::cos(at.yaw_rad));
    Primitive s;
    s.material = material;
    s.seed = static_cast<std::uint32_t>(random_.next());
    s.half = half;
    s.albedo = static_cast<float>(albedo);
    s.R_map_local = exp_so3({0.0, 0.0, at.yaw_rad});
    s.centre = {p.x(), p.y(), terrain_.base_height(p.x(), p.y()) + bottom_m + half.z()};
    still_.push_back(s);
    return still_.back();
  }

  void build_barrier() {
    const Setting& setting = terrain_.route().setting;
    const double length = terrain_.route().length_m();
    for (double s = 3.0; s + 3.0 < length; s += 6.0) {
      box(s, setting.left_m + 0.3, {3.02, 0.2, 0.55}, -0.2, Material::kConcrete,
          random_.uniform(0.2, 0.3));
      // Stretches of a high wall beyond the right shoulder.
      if (std::fmod(s, 420.0) < 230.0)
        box(s, -setting.right_m - 3.5, {3.02, 0.15, 2.2}, -0.3, Material::kBrick,
            random_.uniform(0.16, 0.22));
    }
    for (double s = random_.uniform(90.0, 200.0); s + 10.0 < length;
         s += random_.uniform(220.0, 420.0))
      build_gantry(s);
  }

 private:
  /// Signs on a beam across the road.
  void build_gantry(double s_m) {
    const Setting& setting = terrain_.route().setting;
    const double left = setting.left_m + 0.6;
    const double right = -setting.right_m - 0.6;
    for (const double d : {left, right}) box(s_m, d, {0.2, 0.2, 3.4}, -0.2, Material::kMetal, 0.25);
    box(s_m, 0.5 * (left + right), {0.2, 0.5 * (left - right), 0.25}, 6.2, Material::kMetal, 0.25);
    for (double d = right + 4.0; d < left - 3.0; d += random_.uniform(4.5, 7.0)) {
      box(s_m - 0.3, d, {0.06, random_.uniform(1.4, 2.2), random_.uniform(0.9, 1.4)}, 5.4,
          Material::kSign, random_.uniform(0.3, 0.6));
    }
  }

  const Terrain& terrain_;
  Random random_;
  std::vector<Primitive>& still_;
};

}  // namespace

void add_roadside(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still) {
  if (terrain.route().setting.barrier) Builder(terrain, seed, still).build_barrier();
}

}  // namespace plumb::synth
