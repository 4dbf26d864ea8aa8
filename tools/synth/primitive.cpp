#include "tools/synth/primitive.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumb::synth {
namespace {

using Eigen::Vector3d;

struct Interval {
  double enter = -1e30;
  double leave = 1e30;
  int face = -1;

  /// Clips by n.(o + t d) <= offset given n.o and n.d.
  bool clip(double n_o, double n_d, double offset, int face_in) {
    const double gap = offset - n_o;
    if (n_d < 0.0) {
      const double t = gap / n_d;
      if (t > enter) {
        enter = t;
        face = face_in;
      }
    } else if (n_d > 0.0) {
      const double t = gap / n_d;
      if (t < leave) leave = t;
    } else if (gap < 0.0) {
      return false;
    }
    return enter <= leave;
  }
};

bool clip_box(const Primitive& s, const Vector3d& o, const Vector3d& d, Interval& span) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!span.clip(o[axis], d[axis], s.half[axis], 2 * axis)) return false;
    if (!span.clip(-o[axis], -d[axis], s.half[axis], 2 * axis + 1)) return false;
  }
  return true;
}

bool clip_convex(const Primitive& s, const Vector3d& o, const Vector3d& d, Interval& span) {
  for (std::size_t k = 0; k < s.num_planes; ++k) {
    const Plane& plane = s.planes[k];
    if (!span.clip(plane.n_local.dot(o), plane.n_local.dot(d), plane.offset_m, static_cast<int>(k)))
      return false;
  }
  return true;
}

/// Round solid along `axis` with radius half[0].
bool clip_round(const Primitive& s, const Vector3d& o, const Vector3d& d, int axis,
                Interval& span) {
  const int u = 0;
  const int v = axis == 2 ? 1 : 2;
  const double a = d[u] * d[u] + d[v] * d[v];
  const double b = o[u] * d[u] + o[v] * d[v];
  const double c = o[u] * o[u] + o[v] * o[v] - s.half[0] * s.half[0];
  const double disc = b * b - a * c;
  if (disc < 0.0 || (a < 1e-12 && c > 0.0)) return false;
  if (a >= 1e-12) {
    const double root = std::sqrt(disc);
    span.enter = (-b - root) / a;
    span.leave = (-b + root) / a;
    span.face = 0;
  }
  return span.clip(o[axis], d[axis], s.half[axis], 2 * axis) &&
         span.clip(-o[axis], -d[axis], s.half[axis], 2 * axis + 1);
}

Vector3d normal_of(const Primitive& s, int face, const Vector3d& p) {
  if (s.shape == Shape::kConvex) return s.planes[static_cast<std::size_t>(face)].n_local;
  if (s.shape == Shape::kCylinder && face == 0) return Vector3d(p.x(), p.y(), 0.0) / s.half.x();
  if (s.shape == Shape::kWheel && face == 0) return Vector3d(p.x(), 0.0, p.z()) / s.half.x();
  Vector3d n = Vector3d::Zero();
  n[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
  return n;
}

/// A fence of pickets with a rail has one gap every 14 cm. It closes when a pixel covers more than
/// a gap.
bool fence_is_open(const Vector3d& p, double footprint_m) {
  if (footprint_m > 0.07) return false;
  const bool rail = std::abs(std::abs(p.z()) - 0.25) < 0.04;
  const double phase = p.x() / 0.14 - std::floor(p.x() / 0.14);
  return !rail && phase > 0.55;
}

/// Nested shells that are fixed in the solid, sparse outside and dense inside. They look ragged
/// from every side, and are the same from all.
struct Shell {
  double radius;
  float bias;
};
constexpr std::array<Shell, 3> kShells{{{1.0, -0.24F}, {0.8, -0.03F}, {0.58, 0.28F}}};

bool intersect_leaves(const Primitive& s, const Vector3d& o, const Vector3d& d, double pixel_rad,
                      const VolumeNoise& noise, Hit& hit) {
  const Vector3d os = o.cwiseQuotient(s.half);
  const Vector3d ds = d.cwiseQuotient(s.half);
  const double a = ds.squaredNorm();
  const double b = os.dot(ds);
  const double c = os.squaredNorm();
  const auto try_shell = [&](std::size_t k, double sign) {
    const double disc = b * b - a * (c - kShells[k].radius * kShells[k].radius);
    if (disc <= 0.0) return false;
    const double t = (-b + sign * std::sqrt(disc)) / a;
    if (t <= 0.05 || t >= hit.t) return false;
    const Vector3d p = o + t * d;
    if (leaf_density(s, p, t * pixel_rad, noise) + kShells[k].bias < 0.0F) return false;
    hit.t = t;
    hit.face = static_cast<int>(k);
    hit.p_local = p;
    hit.n_local = p.cwiseQuotient(s.half.cwiseProduct(s.half)).normalized();
    return true;
  };
  if (b * b - a * (c - 1.0) <= 0.0) return false;
  for (std::size_t k = 0; k < kShells.size(); ++k) {
    if (try_shell(k, -1.0)) return true;
  }
  for (std::size_t k = kShells.size();
       k-- > 1;) {  // the far outer shell is hidden by its own sparseness
    if (try_shell(k, 1.0)) return true;
  }
  return false;
}

}  // namespace

float leaf_density(const Primitive& s, const Vector3d& p, double footprint_m,
                   const VolumeNoise& noise) {
  const double offset = 0.37 * static_cast<double>(s.seed % 1009U);
  const float coarse = noise.sample(p.x() * 2.3 + offset, p.y() * 2.3, p.z() * 2.6);
  float density = 1.0F * (coarse - 0.5F) + 0.10F;
  if (footprint_m < 0.16) {
    const float fine = noise.sample(p.x() * 8.9, p.y() * 8.9 + offset, p.z() * 9.7);
    const float fade = static_cast<float>(std::clamp(2.0 - footprint_m * 12.5, 0.0, 1.0));
    density += fade * 1.5F * (fine - 0.5F);
  }
  return density;
}

bool intersect(const Primitive& solid, const Ray& ray, double pixel_rad, const VolumeNoise& noise,
               Hit& hit) {
  const Vector3d to_centre = solid.centre - ray.origin;
  const double along = to_centre.dot(ray.direction);
  const double radius = solid.radius();
  if (to_centre.squaredNorm() - along * along > radius * radius || along < -radius ||
      along - radius > hit.t)
    return false;
  const Vector3d o = -(solid.R_map_local.transpose() * to_centre);
  const Vector3d d = solid.R_map_local.transpose() * ray.direction;
  if (solid.shape == Shape::kLeaves) return intersect_leaves(solid, o, d, pixel_rad, noise, hit);
  Interval span;
  bool inside = false;
  switch (solid.shape) {
    case Shape::kBox:
      inside = clip_box(solid, o, d, span);
      break;
    case Shape::kConvex:
      inside = clip_convex(solid, o, d, span);
      break;
    case Shape::kCylinder:
      inside = clip_round(solid, o, d, 2, span);
      break;
    case Shape::kWheel:
      inside = clip_round(solid, o, d, 1, span);
      break;
    case Shape::kLeaves:
      break;
  }
  if (!inside || span.face < 0 || span.enter <= 1e-3 || span.enter >= hit.t) return false;
  const Vector3d p = o + span.enter * d;
  if (solid.material == Material::kFence && fence_is_open(p, span.enter * pixel_rad)) return false;
  hit.t = span.enter;
  hit.face = span.face;
  hit.p_local = p;
  hit.n_local = normal_of(solid, span.face, p);
  return true;
}

}  // namespace plumb::synth
