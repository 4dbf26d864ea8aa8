#include "tools/synth/vehicle_parts.hpp"

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {

using Eigen::Vector3d;

Primitive extrude(const std::vector<ProfilePoint>& profile, double half_width, double lean,
                  const ObjectPose& pose) {
  Primitive s;
  s.shape = Shape::kConvex;
  double low_x = 1e9;
  double high_x = -1e9;
  double low_z = 1e9;
  double high_z = -1e9;
  for (const ProfilePoint& p : profile) {
    low_x = std::min(low_x, p.x);
    high_x = std::max(high_x, p.x);
    low_z = std::min(low_z, p.z);
    high_z = std::max(high_z, p.z);
  }
  const Vector3d middle(0.5 * (low_x + high_x), 0.0, 0.5 * (low_z + high_z));
  s.half = {0.5 * (high_x - low_x), half_width, 0.5 * (high_z - low_z)};
  const double cos_lean = 1.0 / std::sqrt(1.0 + lean * lean);
  for (const double side : {1.0, -1.0}) {
    Plane& plane = s.planes[s.num_planes++];
    plane.n_local = Vector3d(0.0, side * cos_lean, lean * cos_lean);
    plane.offset_m = cos_lean * (half_width - lean * s.half.z());
  }
  for (std::size_t i = 0; i < profile.size() && s.num_planes < kMaxPlanes; ++i) {
    const ProfilePoint& a = profile[i];
    const ProfilePoint& b = profile[(i + 1) % profile.size()];
    Plane& plane = s.planes[s.num_planes++];
    plane.n_local = Vector3d(b.z - a.z, 0.0, a.x - b.x).normalized();
    plane.offset_m = plane.n_local.dot(Vector3d(a.x, 0.0, a.z) - middle);
  }
  s.R_map_local = pose.T_map_object.R;
  s.centre = pose.T_map_object * middle;
  return s;
}

Primitive box_at(const Vector3d& centre, const Vector3d& half, const ObjectPose& pose) {
  Primitive s;
  s.half = half;
  s.R_map_local = pose.T_map_object.R;
  s.centre = pose.T_map_object * centre;
  return s;
}

float paint_of(std::uint32_t seed) {
  static constexpr float kPaints[] = {0.02F, 0.03F, 0.04F, 0.30F, 0.45F, 0.62F, 0.12F, 0.16F};
  return kPaints[hash_keys(seed, 0xca1) % 8U];
}

void add_axle(const ObjectPose& pose, double x_m, double radius_m, std::vector<Primitive>& solids) {
  for (const double side : {1.0, -1.0}) {
    Primitive wheel = box_at({x_m, side * (0.5 * pose.size_m.y() - 0.10), radius_m},
                             {radius_m, 0.11, radius_m}, pose);
    wheel.shape = Shape::kWheel;
    wheel.material = Material::kTyre;
    wheel.albedo = 0.03F;
    solids.push_back(wheel);
  }
}

}  // namespace plumb::synth
