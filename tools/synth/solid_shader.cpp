#include "tools/synth/solid_shader.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector3d;

double dice(std::uint32_t seed, std::uint64_t purpose) {
  return uniform_of(hash_keys(seed, purpose));
}

double dice_at(std::uint32_t seed, double column, double row, std::uint64_t purpose) {
  return uniform_of(hash_keys(seed + purpose, static_cast<std::uint64_t>(column + 512.0),
                              static_cast<std::uint64_t>(row + 512.0)));
}

void scale(Reflectance& out, double factor) { out.albedo *= static_cast<float>(factor); }

void blend(Reflectance& out, double share, double albedo) {
  out.albedo += static_cast<float>(share) * (static_cast<float>(albedo) - out.albedo);
}

}  // namespace

SolidShader::Face SolidShader::face_of(const Primitive& solid, const Hit& hit,
                                       const Patch& patch) const {
  const int axis = std::abs(hit.n_local.x()) > std::abs(hit.n_local.y()) ? 1 : 0;
  const Vector3d eu = solid.R_map_local.col(axis);
  const Vector3d ev = solid.R_map_local.col(2);
  const Footprint pixel = footprint(patch, eu, ev);
  return {hit.p_local[axis] + solid.half[axis], hit.p_local.z() + solid.half.z(), reach_x(pixel),
          reach_y(pixel), pixel};
}

Reflectance SolidShader::shade(const Primitive& solid, const Hit& hit, const Patch& patch) const {
  Reflectance out;
  out.albedo = solid.albedo;
  out.gloss = 0.0F;
  out.n_map = patch.n_map;
  switch (solid.material) {
    case Material::kFacade:
      facade(solid, hit, face_of(solid, hit, patch), out);
      break;
    case Material::kBrick:
      brick(face_of(solid, hit, patch), out);
      break;
    case Material::kRoof:
      roof(solid, hit, patch, out);
      break;
    case Material::kLeaves:
      leaves(solid, hit, patch, out);
      break;
    case Material::kHedge:
      hedge(hit, patch, solid, out);
      break;
    case Material::kPaint:
      bodywork(solid, hit, patch, out);
      break;
    case Material::kCabin:
      cabin(solid, hit, patch, out);
      break;
    case Material::kCoach:
      coach(solid, hit, patch, out);
      break;
    case Material::kLamp:
      out.glow = 3.0F;
      out.always_glows = true;
      break;
    case Material::kTyre:
      tyre(solid, hit, out);
      break;
    case Material::kSign:
      sign(solid, hit, patch, out);
      break;
    case Material::kTarp:
      tarp(solid, hit, patch, out);
      break;
    case Material::kBark:
    case Material::kWood:
    case Material::kConcrete:
    case Material::kMetal:
    case Material::kFence: {
      const Face face = face_of(solid, hit, patch);
      const double rough = solid.material == Material::kBark ? 0.35 : 0.08;
      scale(out, 1.0 + rough * static_cast<double>(textures_.grain.sample(
                                   0.6 * face.u_m + 0.01 * (solid.seed % 997U), 0.25 * face.v_m,
                                   face.pixel)));
      break;
    }
  }
  return out;
}

void SolidShader::facade(const Primitive& solid, const Hit& hit, const Face& face,
                         Reflectance& out) const {
  const double shift = 0.013 * (solid.seed % 4001U);
  const double plaster =
      0.05 * static_cast<double>(textures_.grain.sample(face.u_m + shift, face.v_m, face.pixel)) +
      0.06 * static_cast<double>(
                 textures_.stains.sample(face.u_m + shift, 0.5 * face.v_m, face.pixel));
  scale(out, 1.0 + plaster);
  if (hit.face >= 4) return;
  const double up = face.v_m - 1.4;  // the wall starts below the ground
  blend(out, coverage(up, -3.0, 0.45, face.reach_v), 0.12 + 0.15 * dice(solid.seed, 1));  // plinth
  const double storey = 2.75 + 0.3 * dice(solid.seed, 2);
  const double bay = 2.1 + 1.6 * dice(solid.seed, 3);
  const double row = std::floor((up - 0.5) / storey);
  const double column = std::floor(face.u_m / bay);
  const double length = 2.0 * solid.half[std::abs(hit.n_local.x()) > 0.5 ? 1 : 0];
  if (row < 0.0 || (column + 1.0) * bay > length || up > 2.0 * solid.half.z() - 1.9) return;
  if (dice_at(solid.seed, column + 31.0 * hit.face, row, 5) < 0.2) return;
  const double v = up - 0.5 - row * storey;
  const double u = face.u_m - column * bay;
  const double wide = 0.9 + 0.5 * dice(solid.seed, 6);
  const double u0 = 0.5 * (bay - wide);
  const double tall = 1.15 + 0.4 * dice(solid.seed, 7);
  const bool door = row < 0.5 && dice_at(solid.seed, column, row, 8) < 0.15;
  const double v0 = door ? -0.4 : 0.55;
  const auto pane = [&](double grow) {
    return coverage(u, u0 - grow, u0 + wide + grow, face.reach_u) *
           coverage(v, v0 - grow, v0 + tall + grow, face.reach_v);
  };
  if (dice(solid.seed, 9) < 0.35) {  // shutters
    const double wings = coverage(u, u0 - 0.5, u0 + wide + 0.5, face.reach_u) *
                         coverage(v, v0, v0 + tall, face.reach_v);
    blend(out, wings,
          (0.06 + 0.4 * dice(solid.seed, 10)) *
              (1.0 - 0.3 * stripe(v, 0.09, 0.0, 0.035, face.reach_v)));
  }
  blend(out, pane(0.09), dice(solid.seed, 11) < 0.6 ? 0.75 : 0.12);  // frame
  const double glass_tone =
      dice_at(solid.seed, column, row, 12) < 0.3 ? 0.45 : 0.03;  // blind or dark room
  const double glass = pane(0.0);
  blend(out, glass, glass_tone);
  if (dice_at(solid.seed, column, row, 13) < 0.3) out.glow = static_cast<float>(0.15 * glass);
  const double bar = coverage(u, 0.5 * bay - 0.03, 0.5 * bay + 0.03, face.reach_u) * glass;
  blend(out, bar, 0.6);
  blend(out,
        coverage(u, u0 - 0.15, u0 + wide + 0.15, face.reach_u) *
            coverage(v, v0 - 0.16, v0 - 0.09, face.reach_v),
        0.4);
  if (glass_tone < 0.1) out.gloss = 0.35F * static_cast<float>(glass * (1.0 - bar));
}

void SolidShader::brick(const Face& face, Reflectance& out) const {
  const double course = std::floor(face.v_m / 0.083);
  const double u = face.u_m + 0.125 * course;
  const double seen = std::clamp(1.5 - 6.0 * face.reach_u, 0.0, 1.0);
  const double tone =
      seen * (uniform_of(hash_keys(static_cast<std::uint64_t>(std::floor(u / 0.25) + 4096.0),
                                   static_cast<std::uint64_t>(course + 64.0))) -
              0.5);
  const double mortar = std::max(stripe(face.v_m, 0.083, 0.0, 0.012, face.reach_v),
                                 stripe(u, 0.25, 0.0, 0.012, face.reach_u));
  scale(out, 1.0 + 0.5 * tone +
                 0.1 * static_cast<double>(textures_.grain.sample(face.u_m, face.v_m, face.pixel)));
  blend(out, mortar, 0.35);
}

void SolidShader::roof(const Primitive& solid, const Hit& hit, const Patch& patch,
                       Reflectance& out) const {
  if (hit.face >= 2) {
    const Face face = face_of(solid, hit, patch);
    out.albedo = 0.45F;
    scale(out, 1.0 + 0.05 * static_cast<double>(
                                textures_.stains.sample(face.u_m, face.v_m, face.pixel)));
    return;
  }
  const Vector3d eu = solid.R_map_local.col(0);
  const Vector3d up_slope = patch.n_map.cross(eu).normalized();
  const Footprint pixel = footprint(patch, eu, up_slope);
  const double v = up_slope.dot(patch.p_map - solid.centre);
  const double u = hit.p_local.x() + 200.0;
  const double tiles = 0.3 * stripe(v, 0.33, 0.0, 0.07, reach_y(pixel)) +
                       0.15 * stripe(u, 0.24, 0.0, 0.05, reach_x(pixel));
  scale(out,
        (1.0 - tiles) * (1.0 + 0.14 * static_cast<double>(textures_.stains.sample(u, v, pixel))));
}

void SolidShader::leaves(const Primitive& solid, const Hit& hit, const Patch& patch,
                         Reflectance& out) const {
  const Vector3d& p = hit.p_local;
  const double offset = 0.91 * (solid.seed % 613U);
  const auto fade = [&](double wavelength) {
    return std::clamp(1.6 - 1.6 * patch.width_m / wavelength, 0.0, 1.0);
  };
  const auto octave = [&](double frequency) {
    return static_cast<double>(textures_.volume.sample(p.x() * frequency + offset,
                                                       p.y() * frequency, p.z() * frequency)) -
           0.5;
  };
  double tone = 0.7 * octave(2.3) * fade(0.6);
  if (patch.width_m < 0.2) tone += 1.1 * octave(7.9) * fade(0.2);
  if (patch.width_m < 0.09) tone += 1.0 * octave(19.0) * fade(0.09);
  const double depth = hit.face == 0 ? 1.0 : hit.face == 1 ? 0.72 : 0.45;
  scale(out, depth * std::max(0.15, 1.0 + 1.9 * tone));
  out.openness = static_cast<float>(depth);
  // Leaves face in all directions. Without noise in the normal, crowns look like balls.
  const Vector3d wobble(octave(3.7), octave(4.1), octave(4.9));
  out.n_map = (patch.n_map + 1.7 * wobble).normalized();
}

void SolidShader::hedge(const Hit& hit, const Patch& patch, const Primitive& solid,
                        Reflectance& out) const {
  const Vector3d p = hit.p_local * 2.0;
  const double offset = 0.77 * (solid.seed % 811U);
  const auto octave = [&](double frequency) {
    return static_cast<double>(textures_.volume.sample(p.x() * frequency + offset,
                                                       p.y() * frequency, p.z() * frequency)) -
           0.5;
  };
  const auto fade = [&](double wavelength) {
    return std::clamp(1.6 - 1.6 * patch.width_m / wavelength, 0.0, 1.0);
  };
  double tone = 0.8 * octave(2.1) * fade(0.3);
  if (patch.width_m < 0.1) tone += 1.2 * octave(7.0) * fade(0.1);
  if (patch.width_m < 0.045) tone += 1.1 * octave(15.0) * fade(0.045);
  scale(out, std::max(0.15, 1.0 + 1.8 * tone));
  out.n_map = (patch.n_map + 1.5 * Vector3d(octave(3.3), octave(4.3), octave(5.1))).normalized();
}

void SolidShader::bodywork(const Primitive& solid, const Hit& hit, const Patch& patch,
                           Reflectance& out) const {
  const Vector3d& p = hit.p_local;
  const Vector3d& h = solid.half;
  out.gloss = solid.gloss;
  const double reach = patch.width_m * 1.5;
  const bool back = hit.n_local.x() < -0.7;
  const bool front = hit.n_local.x() > 0.7;
  if (std::abs(hit.n_local.y()) > 0.8) {  // doors
    const double seams =
        stripe(p.x() + 10.0, 1.05, 0.0, 0.015, reach) * coverage(p.z(), -0.7 * h.z(), h.z(), reach);
    scale(out, 1.0 - 0.6 * seams);
    blend(out, coverage(p.z(), -h.z(), -0.72 * h.z(), reach), 0.03);
    return;
  }
  if (!back && !front) return;
  const double side = std::abs(p.y());
  const double lamps = coverage(side, 0.68 * h.y(), 0.98 * h.y(), reach) *
                       coverage(p.z(), 0.15 * h.z(), 0.65 * h.z(), reach);
  blend(out, lamps, back ? 0.2 : 0.7);
  const bool cab = h.z() > 0.9;  // of a truck, whose lamps are small and low
  const double lit = cab ? coverage(side, 0.7 * h.y(), 0.9 * h.y(), reach) *
                               coverage(p.z(), -0.75 * h.z(), -0.62 * h.z(), reach)
                         : lamps;
  out.glow = static_cast<float>(lit * (back ? 0.35 : 6.0));
  blend(out, coverage(p.z(), -h.z(), -0.45 * h.z(), reach), 0.04);  // bumper's lower part
  if (front)
    blend(
        out,
        coverage(side, 0.0, 0.5 * h.y(), reach) * coverage(p.z(), -0.1 * h.z(), 0.4 * h.z(), reach),
        0.03);
  const double plate = coverage(side, 0.0, 0.26, reach) *
                       coverage(p.z(), -0.25 * h.z() - 0.05, -0.25 * h.z() + 0.06, reach);
  blend(out, plate, 0.65);
  const double glyphs = plate * stripe(p.y() + 3.0, 0.075, 0.0, 0.035, reach) *
                        coverage(p.z(), -0.25 * h.z() - 0.03, -0.25 * h.z() + 0.04, reach);
  blend(out, glyphs, 0.05);
}

void SolidShader::cabin(const Primitive& solid, const Hit& hit, const Patch& patch,
                        Reflectance& out) const {
  const Vector3d& p = hit.p_local;
  const Vector3d& h = solid.half;
  const double reach = patch.width_m * 1.5;
  out.gloss = 0.5F;
  if (hit.n_local.z() > 0.9) return;  // roof
  const bool side = std::abs(hit.n_local.y()) > 0.5;
  const double up = coverage(p.z(), -0.9 * h.z(), 0.72 * h.z(), reach);
  double across =
      coverage(std::abs(p.y()), 0.0, 0.8 * h.y() * (1.0 - 0.12 * (p.z() / h.z() + 1.0)), reach);
  if (side) {
    const double inset = 0.35 * (p.z() / h.z() + 1.0) * h.z();
    across = coverage(p.x(), -h.x() + 0.2 + 0.4 * inset, h.x() - 0.15 - inset, reach) *
             (1.0 - stripe(p.x() + 10.1, 0.95, 0.0, 0.07, reach));
  }
  const double glass = up * across;
  blend(out, glass, 0.02);
  out.gloss = static_cast<float>(0.35 + 0.65 * glass);
}

void SolidShader::coach(const Primitive& solid, const Hit& hit, const Patch& patch,
                        Reflectance& out) const {
  const Vector3d& p = hit.p_local;
  const Vector3d& h = solid.half;
  const double reach = patch.width_m * 1.5;
  out.gloss = solid.gloss;
  if (std::abs(hit.n_local.z()) > 0.9) return;
  const bool side = std::abs(hit.n_local.y()) > 0.5;
  const double tall = coverage(p.z(), 0.05 * h.z(), 0.72 * h.z(), reach);
  double glass = 0.0;
  if (side) {
    glass = tall * coverage(p.x(), -h.x() + 0.4, h.x() - 0.3, reach) *
            (1.0 - stripe(p.x() + 40.0, 1.45, 0.0, 0.09, reach));
    // An advertisement below the windows, and doors.
    const double letters = static_cast<double>(
        textures_.volume.sample(1.7 * p.x() + (solid.seed % 61U), 1.7 * p.z(), 3.5));
    const double band = coverage(p.z(), -0.55 * h.z(), -0.1 * h.z(), reach);
    if (letters > 0.52) blend(out, 0.7 * band, dice(solid.seed, 4) < 0.5 ? 0.6 : 0.06);
    blend(out, stripe(p.x() + 41.0, 5.8, 0.0, 0.04, reach), 0.03);
  } else {
    glass = coverage(p.z(), -0.1 * h.z(), 0.78 * h.z(), reach) *
            coverage(std::abs(p.y()), 0.0, 0.88 * h.y(), reach);
    const double lamps = coverage(std::abs(p.y()), 0.7 * h.y(), 0.92 * h.y(), reach) *
                         coverage(p.z(), -0.62 * h.z(), -0.45 * h.z(), reach);
    blend(out, lamps, hit.n_local.x() < 0.0 ? 0.2 : 0.7);
    out.glow = static_cast<float>(lamps * (hit.n_local.x() < 0.0 ? 0.35 : 6.0));
  }
  blend(out, coverage(p.z(), -h.z(), -0.8 * h.z(), reach), 0.04);
  blend(out, glass, 0.03);
  out.glow += static_cast<float>(0.12 * glass);  // lit inside
  out.gloss = static_cast<float>(0.25 + 0.6 * glass);
}

void SolidShader::tyre(const Primitive& solid, const Hit& hit, Reflectance& out) const {
  if (hit.face == 0) return;
  const double r = std::hypot(hit.p_local.x(), hit.p_local.z()) / solid.half.x();
  if (r > 0.68) return;
  const double angle = std::atan2(hit.p_local.z(), hit.p_local.x());
  const bool spoke = std::cos(5.0 * angle + dice(solid.seed, 3)) > -0.2 || r < 0.2 || r > 0.58;
  out.albedo = spoke ? 0.4F : 0.05F;
}

void SolidShader::sign(const Primitive& solid, const Hit& hit, const Patch& patch,
                       Reflectance& out) const {
  if (hit.face >= 2) return;
  const double y = hit.p_local.y() / solid.half.y();
  const double z = hit.p_local.z() / solid.half.z();
  const double reach = patch.width_m / solid.half.y();
  const double r =
      dice(solid.seed, 2) < 0.5 ? std::hypot(y, z) : std::max(std::abs(y), std::abs(z));
  blend(out, coverage(r, 0.78, 2.0, reach), 0.12);
  const double glyph =
      static_cast<double>(textures_.volume.sample(3.0 * y + (solid.seed % 97U), 3.0 * z, 0.5));
  if (r < 0.6 && glyph > 0.55) blend(out, std::clamp(1.0 - 2.0 * reach, 0.0, 1.0), 0.06);
}

void SolidShader::tarp(const Primitive& solid, const Hit& hit, const Patch& patch,
                       Reflectance& out) const {
  const Face face = face_of(solid, hit, patch);
  const double stain = static_cast<double>(
      textures_.stains.sample(face.u_m + 0.1 * (solid.seed % 31U), face.v_m, face.pixel));
  scale(out, 1.0 + 0.06 * stain);
  if (std::abs(hit.n_local.x()) > 0.5) {
    scale(out, 1.0 - 0.5 * coverage(face.u_m, solid.half.y() - 0.015, solid.half.y() + 0.015,
                                    face.reach_u));  // door gap
    blend(out, coverage(face.v_m, 0.0, 0.12, face.reach_v), 0.06);
    const double letters = static_cast<double>(
        textures_.volume.sample(2.2 * face.u_m + (solid.seed % 53U), 2.2 * face.v_m, 7.5));
    const double band =
        coverage(face.v_m, 1.2, 1.9, face.reach_v) * coverage(face.u_m, 0.4, 2.1, face.reach_u);
    if (letters > 0.5) blend(out, 0.8 * band, 0.1);
  } else {
    scale(out, 1.0 - 0.12 * stripe(face.u_m, 0.62, 0.0, 0.05, face.reach_u));
  }
}

}  // namespace plumb::synth
