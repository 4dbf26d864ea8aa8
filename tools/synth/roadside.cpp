#include <cmath>

#include "tools/synth/random.hpp"
#include "tools/synth/scene.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTubeLamp = 6.0;
constexpr double kStreetLamp = 22.0;

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

  void build_tube(const Tube& tube, std::vector<Lamp>& lamps) {
    const Setting& setting = terrain_.route().setting;
    const double left = setting.left_m + kTubeWall;
    const double right = -setting.right_m - kTubeWall;
    constexpr double kPiece = 6.0;  // [m]
    for (double s = tube.from_m; s < tube.to_m; s += kPiece) {
      const double middle = s + 0.5 * kPiece;
      for (const double d : {left, right}) {
        box(middle, d, {0.5 * kPiece + 0.05, 0.2, 0.5 * kTubeHeight + 0.5}, -0.5,
            Material::kConcrete, random_.uniform(0.28, 0.36));
        // Hydrants, doors and signs, as every tunnel has.
        if (random_.chance(0.3))
          box(middle + random_.uniform(-2.0, 2.0), d > 0.0 ? d - 0.22 : d + 0.22,
              {random_.uniform(0.3, 0.6), 0.05, random_.uniform(0.3, 1.0)},
              random_.uniform(0.4, 1.2), Material::kSign, random_.uniform(0.1, 0.7));
      }
      box(middle, 0.5 * (left + right), {0.5 * kPiece + 0.05, 0.5 * (left - right) + 0.2, 0.2},
          kTubeHeight, Material::kConcrete, 0.2);
      for (const double share : {0.3, 0.7}) {
        const Primitive& head = box(middle, left + share * (right - left), {0.6, 0.12, 0.05},
                                    kTubeHeight - 0.15, Material::kLamp, 0.6);
        lamps.push_back({head.centre, kTubeLamp});
      }
    }
  }

  void build_street_lamps(double spacing_m, std::vector<Lamp>& lamps) {
    const Setting& setting = terrain_.route().setting;
    const double length = terrain_.route().length_m();
    const double d = -setting.right_m - 0.9;
    for (double s = random_.uniform(5.0, spacing_m); s + 5.0 < length; s += spacing_m) {
      box(s, d, {0.08, 0.08, 4.2}, -0.2, Material::kMetal, 0.3);
      box(s, d + 0.9, {0.05, 0.95, 0.05}, 8.1, Material::kMetal, 0.3);
      const Primitive& head = box(s, d + 1.8, {0.15, 0.4, 0.06}, 8.0, Material::kLamp, 0.6);
      lamps.push_back({head.centre, kStreetLamp});
    }
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

void add_tube(const Terrain& terrain, const Tube& tube, std::uint64_t seed,
              std::vector<Primitive>& still, std::vector<Lamp>& lamps) {
  const double start = terrain.route().start_m;
  Builder(terrain, seed + 1, still).build_tube({start + tube.from_m, start + tube.to_m}, lamps);
}

void add_street_lamps(const Terrain& terrain, double spacing_m, std::uint64_t seed,
                      std::vector<Primitive>& still, std::vector<Lamp>& lamps) {
  Builder(terrain, seed + 2, still).build_street_lamps(spacing_m, lamps);
}

}  // namespace plumb::synth
