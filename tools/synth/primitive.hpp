/// Convex solids and leafy ellipsoids, of which everything beside the road is made, and their
/// intersections with rays.
///
/// Frames:
///   local: the solid's own axes, z up.
///   map: as in route.hpp; the centre is in map.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "tools/synth/noise_texture.hpp"

namespace plumb::synth {

enum class Shape : std::uint8_t {
  kBox,       ///< faces +x -x +y -y +z -z are 0..5
  kConvex,    ///< up to kMaxPlanes half-spaces; face = plane number
  kCylinder,  ///< along z; half = (radius, radius, half length); face 0 mantle, 4 top, 5 bottom
  kWheel,     ///< along y; half = (radius, half width, radius); face 0 mantle, 2 and 3 the discs
  kLeaves     ///< ellipsoid shell with holes; half = radii
};

enum class Material : std::uint8_t {
  kFacade,
  kRoof,
  kHedge,
  kBrick,
  kFence,
  kWood,
  kMetal,
  kLeaves,
  kBark,
  kPaint,
  kCabin,
  kTyre,
  kSign,
  kTarp,
  kConcrete,
  kCoach,
  kLamp
};

struct Plane {
  Eigen::Vector3d n_local = Eigen::Vector3d::UnitZ();  ///< outward
  double offset_m = 0.0;                               ///< n . x <= offset
};

inline constexpr std::size_t kMaxPlanes = 8;

struct Primitive {
  Shape shape = Shape::kBox;
  Material material = Material::kFacade;
  std::int32_t object = -1;  ///< index of the labelled object it belongs to
  std::uint32_t seed = 0;
  float albedo = 0.5F;
  float gloss = 0.0F;
  Eigen::Matrix3d R_map_local = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Ones();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s] during the exposure
  std::array<Plane, kMaxPlanes> planes{};
  std::uint8_t num_planes = 0;

  [[nodiscard]] double radius() const { return half.norm(); }
};

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  ///< unit length
};

struct Hit {
  double t = 1e30;
  std::int32_t primitive = -1;
  int face = -1;
  Eigen::Vector3d p_local = Eigen::Vector3d::Zero();
  Eigen::Vector3d n_local = Eigen::Vector3d::Zero();
};

/// Finds the nearest hit in (0, hit.t). Without one, returns false and leaves `hit` as it was.
/// `pixel_rad` is the angle of one pixel; smaller holes close. `noise` shapes the holes.
bool intersect(const Primitive& solid, const Ray& ray, double pixel_rad, const VolumeNoise& noise,
               Hit& hit);

/// Smooth leaf density at a point of a kLeaves shell: solid where positive.
[[nodiscard]] float leaf_density(const Primitive& solid, const Eigen::Vector3d& p_local,
                                 double footprint_m, const VolumeNoise& noise);

}  // namespace plumb::synth
