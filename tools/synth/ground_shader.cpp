#include "tools/synth/ground_shader.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector3d;

constexpr double kAsphalt = 0.155;
constexpr double kPaint = 0.42;
constexpr double kRepairCell = 13.0;   ///< [m] of road with at most one patch
constexpr double kManholeCell = 27.0;  ///< [m] with at most one manhole
constexpr double kDashBlock = 70.0;    ///< [m] over which a street has a centre line or not

std::size_t index_of(double s_m, double cell_m, std::size_t count) {
  return std::min(static_cast<std::size_t>(std::max(0.0, s_m / cell_m)), count - 1);
}

double roll_dice(std::uint64_t seed, std::int64_t cell, std::uint64_t purpose) {
  return uniform_of(hash_keys(seed, static_cast<std::uint64_t>(cell + 100'000), purpose));
}

/// Darkening of a joint `gap_m` wide every `period_m`.
double joints(double x, double period_m, double gap_m, double reach_m) {
  return stripe(x, period_m, 0.0, gap_m, reach_m);
}

}  // namespace

GroundShader::GroundShader(const Terrain& terrain, const Textures& textures, const GroundLook& look)
    : terrain_(terrain), textures_(textures), look_(look) {
  plan_details();
}

Reflectance GroundShader::shade(const Patch& patch, const GroundHit& hit) const {
  const double x = patch.p_map.x();
  const double y = patch.p_map.y();
  const Footprint f = footprint(patch, Vector3d::UnitX(), Vector3d::UnitY());
  Here here{terrain_.road_coordinate(x, y), 0.1, 0.1, hit.edge_m};
  const double c = here.road.along.x();
  const double s = here.road.along.y();
  here.along_m = std::abs(c * f.axis_x_m + s * f.axis_y_m) + f.minor_m;
  here.across_m = std::abs(c * f.axis_y_m - s * f.axis_x_m) + f.minor_m;

  Reflectance out;
  out.n_map = patch.n_map;
  if (hit.part == GroundPart::kKerbFace) {
    out.albedo =
        static_cast<float>(0.2 * (1.0 + 0.15 * static_cast<double>(textures_.grain.sample(
                                                   x + y, patch.p_map.z(), patch.width_m))));
    return out;
  }
  if (hit.part == GroundPart::kBeside) {
    out.albedo = beside(patch, f, here);
    return out;
  }
  double albedo = asphalt(patch, f, here);
  const double paint = markings(here);
  if (paint > 0.0) {
    const double worn =
        static_cast<double>(textures_.stains.sample(3.1 * x, 3.1 * y, 3.1 * patch.width_m)) +
        0.6 * static_cast<double>(textures_.grain.sample(x + 1.7, y, f));
    const double kept = std::clamp(1.15 - look_.marking_wear * (0.8 + 0.9 * worn), 0.0, 1.0);
    albedo += paint * kept * (kPaint - albedo);
  }
  out.albedo = static_cast<float>(albedo);
  return look_.wetness > 0.0 ? wet(patch, out) : out;
}

double GroundShader::asphalt(const Patch& patch, const Footprint& f, const Here& here) const {
  const double x = patch.p_map.x();
  const double y = patch.p_map.y();
  const double area = f.minor_m * (reach_x(f) + reach_y(f));
  const double grain = area < 0.16 ? static_cast<double>(textures_.grain.sample(x, y, f)) : 0.0;
  const double fine = static_cast<double>(textures_.stains.sample(x, y, f));
  // An enlarged and turned copy of the tile hides that the texture repeats.
  const double coarse = static_cast<double>(textures_.stains.sample(
      0.117 * (0.8 * x - 0.6 * y), 0.117 * (0.6 * x + 0.8 * y), 0.117 * f.minor_m));
  double tracks = 0.0;  // tyres polish and darken two lanes' worth of stripes
  if (here.road.valid) {
    const double lane = here.road.d_m - 3.6 * std::round(here.road.d_m / 3.6);
    const double off = std::abs(std::abs(lane) - 0.78) / 0.28;
    tracks = -0.05 * std::exp(-off * off);
  }
  const double k = look_.road_contrast;
  double albedo = kAsphalt * (1.0 + k * (0.28 * grain + 0.07 * fine + 0.07 * coarse + tracks));
  albedo *= 1.0 + std::min(1.0, 2.0 * k) * (repairs(here) + manholes(here));
  albedo *= 1.0 - std::min(1.0, k) * cracks(patch, here);
  albedo *= 1.0 - joints_and_rails(here);
  // Dirt gathers in the gutter.
  if (here.edge_m > -0.6) albedo *= 1.0 - 0.25 * (1.0 + here.edge_m / 0.6) * (1.0 + 0.4 * fine);
  return std::max(0.02, albedo);
}

void GroundShader::plan_details() {
  const double length = terrain_.route().length_m();
  for (std::int64_t k = 0; static_cast<double>(k) * kRepairCell < length; ++k) {
    const auto dice = [&](std::uint64_t purpose) { return roll_dice(look_.seed, k, purpose); };
    Repair repair;
    if (dice(1) < 0.4) {
      repair.s_m = (static_cast<double>(k) + dice(2)) * kRepairCell;
      repair.length_m = 0.8 + 8.0 * dice(3);
      repair.d_m = -2.4 + 5.5 * dice(4);
      repair.width_m = 0.5 + 2.0 * dice(5);
      repair.tone = (dice(6) < 0.65 ? -0.22 : 0.16) * dice(7);
    }
    repair.seam = roll_dice(look_.seed, k / 5, 8) < 0.5;
    repairs_.push_back(repair);
  }
  for (std::int64_t k = 0; static_cast<double>(k) * kManholeCell < length; ++k) {
    const bool here = roll_dice(look_.seed, k, 11) < 0.6;
    const double s =
        static_cast<double>(k) * kManholeCell + 2.0 + 23.0 * roll_dice(look_.seed, k, 12);
    manholes_.emplace_back(here ? s : -1e6, -1.2 + 3.6 * roll_dice(look_.seed, k, 13));
  }
  for (std::int64_t k = 0; static_cast<double>(k) * kDashBlock < length; ++k) {
    dashed_.push_back(terrain_.route().setting.edge_lines || roll_dice(look_.seed, k, 21) < 0.35);
  }
}

double GroundShader::repairs(const Here& here) const {
  if (!here.road.valid) return 0.0;
  const std::size_t cell = index_of(here.road.s_m, kRepairCell, repairs_.size());
  double change = 0.0;
  for (std::size_t k = cell > 0 ? cell - 1 : 0; k <= cell; ++k) {
    const Repair& r = repairs_[k];
    if (r.length_m <= 0.0 || here.road.s_m > r.s_m + r.length_m + 1.0 ||
        here.road.s_m < r.s_m - 1.0)
      continue;
    const auto inside = [&](double grow) {
      return coverage(here.road.s_m, r.s_m - grow, r.s_m + r.length_m + grow, here.along_m) *
             coverage(here.road.d_m, r.d_m - grow, r.d_m + r.width_m + grow, here.across_m);
    };
    const double core = inside(0.0);
    change += r.tone * core - 0.28 * (inside(0.035) - core);  // bitumen seam
  }
  // Here and there is a seam between the courses of two lanes.
  const double seam_d = terrain_.route().setting.dash_offset_m + 0.15;
  if (repairs_[cell].seam)
    change -= 0.3 * coverage(here.road.d_m, seam_d, seam_d + 0.03, here.across_m);
  return change;
}

double GroundShader::cracks(const Patch& patch, const Here& here) const {
  const double reach = std::max(here.along_m, here.across_m);
  if (reach > 0.5) return 0.0;
  const double x = patch.p_map.x();
  const double y = patch.p_map.y();
  const double where =
      static_cast<double>(textures_.stains.sample(0.043 * x + 3.0, 0.043 * y, 0.043 * reach));
  if (where < 0.45) return 0.0;
  const double level = static_cast<double>(
      textures_.stains.sample(0.33 * y + 7.7, 0.33 * x, std::max(0.33 * patch.width_m, 0.12)));
  const double width = 0.012;  // [m]; the noise climbs about 0.9 per metre here
  const double distance = std::abs(level) / 0.9;
  const double line = coverage(distance, -width, width, patch.width_m + 0.5 * reach);
  return 0.65 * line * std::clamp((where - 0.45) / 0.3, 0.0, 1.0);
}

double GroundShader::joints_and_rails(const Here& here) const {
  const Setting& setting = terrain_.route().setting;
  if (!here.road.valid) return 0.0;
  double dark = 0.0;
  if (setting.slab_m > 0.0) {
    dark += 0.35 * joints(here.road.s_m, setting.slab_m, 0.02, here.along_m);
    dark +=
        0.25 * joints(here.road.d_m + 0.5 * setting.lane_m, setting.lane_m, 0.02, here.across_m);
  }
  if (setting.tram_m > 0.0) {
    for (const double side : {-0.72, 0.72}) {  // a groove beside a polished rail
      const double at = setting.tram_m + side;
      dark += 0.6 * coverage(here.road.d_m, at - 0.04, at, here.across_m) -
              0.5 * coverage(here.road.d_m, at, at + 0.06, here.across_m);
    }
  }
  return dark;
}

double GroundShader::manholes(const Here& here) const {
  if (!here.road.valid) return 0.0;
  const auto& [s0, d0] = manholes_[index_of(here.road.s_m, kManholeCell, manholes_.size())];
  const double ds = here.road.s_m - s0;
  const double dd = here.road.d_m - d0;
  if (std::abs(ds) > 2.0 || std::abs(dd) > 2.0) return 0.0;
  const double r = std::hypot(ds, dd);
  const double reach = std::min(here.along_m, 0.5) * std::abs(ds) / (r + 1e-6) + here.across_m;
  const double collar = coverage(r, 0.0, 0.55, reach);
  const double ring = coverage(r, 0.30, 0.36, reach);
  const double lid = coverage(r, 0.0, 0.30, reach);
  return 0.25 * collar - 0.55 * ring - 0.15 * lid;
}

double GroundShader::markings(const Here& here) const {
  const Setting& setting = terrain_.route().setting;
  if (!here.road.valid) return 0.0;
  const double s = here.road.s_m;
  const double d = here.road.d_m;
  // Inside a junction the nearest edge is not that of the own road, and there are no lines.
  const double own_edge = std::max(d - setting.left_m, -setting.right_m - d);
  if (here.edge_m < own_edge - 0.25) return 0.0;
  const auto line = [&](double at, double width) {
    return coverage(d, at - 0.5 * width, at + 0.5 * width, here.across_m);
  };
  double paint = 0.0;
  const bool dashed = dashed_[index_of(s, kDashBlock, dashed_.size())];
  if (dashed && setting.dash_offset_m > 0.0) {
    const double dash = stripe(s, setting.dash_period_m, 0.0, setting.dash_m, here.along_m);
    paint += line(setting.dash_offset_m, 0.13) * dash;
    for (int lane = 1; lane < setting.lanes_left; ++lane)
      paint += line(setting.dash_offset_m + lane * setting.lane_m, 0.13) * dash;
    for (int lane = 0; lane < setting.lanes_right; ++lane)
      paint += line(-setting.dash_offset_m - lane * setting.lane_m, 0.13) * dash;
  }
  if (setting.edge_lines) {
    paint +=
        line(setting.right_line_m > 0.0 ? -setting.right_line_m : -setting.right_m + 0.35, 0.15);
    paint += line(setting.left_m - setting.left_line_m, 0.15);
  }
  return std::min(1.0, paint);
}

float GroundShader::beside(const Patch& patch, const Footprint& f, const Here& here) const {
  const Setting& setting = terrain_.route().setting;
  const double x = patch.p_map.x();
  const double y = patch.p_map.y();
  const double grain = static_cast<double>(textures_.grain.sample(x, y, f));
  const double fine = static_cast<double>(textures_.stains.sample(x, y, f));
  const double edge = here.edge_m;
  if (setting.kerb_m > 0.0 && edge < 0.15) {
    return static_cast<float>(0.24 * (1.0 + 0.12 * grain + 0.08 * fine) *
                              (1.0 - 0.5 * joints(here.road.s_m, 1.0, 0.015, here.along_m)));
  }
  if (edge < setting.sidewalk_m) {
    constexpr double kSlab = 0.42;
    const double row = std::floor(edge / kSlab);
    const double shifted = here.road.s_m + 0.5 * kSlab * row;
    const double slab =
        uniform_of(hash_keys(static_cast<std::uint64_t>(std::floor(shifted / kSlab) + 1e6),
                             static_cast<std::uint64_t>(row + 64.0)));
    const double gaps = std::max(joints(edge, kSlab, 0.02, here.across_m),
                                 joints(shifted, kSlab, 0.02, here.along_m));
    const double seen = std::clamp(1.5 - 2.0 * std::max(here.along_m, here.across_m), 0.0, 1.0);
    return static_cast<float>(0.22 *
                              (1.0 + 0.1 * grain + 0.07 * fine + 0.16 * seen * (slab - 0.5)) *
                              (1.0 - 0.45 * gaps));
  }
  const double lawn =
      static_cast<double>(textures_.stains.sample(0.05 * x, 0.05 * y + 2.0, 0.05 * patch.width_m));
  const double tuft = static_cast<double>(textures_.grain.sample(
      0.23 * x, 0.23 * y, Footprint{0.23 * f.axis_x_m, 0.23 * f.axis_y_m, 0.23 * f.minor_m}));
  if (lawn < 0.1 || setting.guard_rail) {
    return static_cast<float>(
        std::max(0.02, 0.105 * (1.0 + 0.5 * tuft + 0.3 * grain + 0.2 * fine)));
  }
  return static_cast<float>(std::max(0.03, 0.2 * (1.0 + 0.16 * grain + 0.12 * fine + 0.08 * tuft)));
}

Reflectance GroundShader::wet(const Patch& patch, Reflectance dry) const {
  const double x = patch.p_map.x();
  const double y = patch.p_map.y();
  const double puddle =
      static_cast<double>(textures_.stains.sample(0.06 * x + 5.0, 0.06 * y, 0.06 * patch.width_m));
  const double film = look_.wetness * std::clamp(0.55 + 0.5 * puddle, 0.0, 1.0);
  dry.albedo *= static_cast<float>(1.0 - 0.45 * film);
  dry.gloss = static_cast<float>(film);
  return dry;
}

}  // namespace plumb::synth
