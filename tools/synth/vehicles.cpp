#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"
#include "tools/synth/scene.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector3d;

/// A point of a side profile: x forward, z up, of the vehicle.
struct ProfilePoint {
  double x;
  double z;
};

/// Extrudes a convex side profile (counted counter-clockwise seen from the right) across the width;
/// the walls lean in by `lean` per metre of height.
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

void add_wheels(const ObjectPose& pose, double radius, double inset,
                std::vector<Primitive>& solids) {
  for (const double end : {0.5 * pose.size_m.x() - inset, -0.5 * pose.size_m.x() + inset}) {
    for (const double side : {1.0, -1.0}) {
      Primitive wheel = box_at({end, side * (0.5 * pose.size_m.y() - 0.10), radius},
                               {radius, 0.11, radius}, pose);
      wheel.shape = Shape::kWheel;
      wheel.material = Material::kTyre;
      wheel.albedo = 0.03F;
      solids.push_back(wheel);
    }
  }
}

void add_car(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids) {
  const double a = 0.5 * pose.size_m.x();
  const double w = 0.5 * pose.size_m.y();
  const double h = pose.size_m.z();
  const bool estate = seed % 3U == 0U || pose.kind == VehicleKind::kVan;
  const double belt = pose.kind == VehicleKind::kVan ? 0.52 * h : 0.60 * h;
  const double bonnet = pose.kind == VehicleKind::kVan ? 0.55 * a : 0.38 * a;

  Primitive body = extrude({{-a, 0.30},
                            {a - 0.05, 0.24},
                            {a, 0.55 * belt},
                            {a - 0.25, 0.82 * belt},
                            {bonnet, belt},
                            {-a + 0.05, belt}},
                           w, 0.03, pose);
  body.material = Material::kPaint;
  body.albedo = paint_of(seed);
  body.gloss = 0.5F;
  solids.push_back(body);

  const double rear_top = estate ? -a + 0.35 : -0.62 * a;
  const double rear_foot = estate ? -a + 0.10 : -0.86 * a;
  Primitive cabin =
      extrude({{rear_foot, belt - 0.02}, {bonnet, belt - 0.02}, {bonnet - 0.75, h}, {rear_top, h}},
              w - 0.04, 0.28, pose);
  cabin.material = Material::kCabin;
  cabin.albedo = body.albedo;
  cabin.gloss = 0.8F;
  solids.push_back(cabin);
  add_wheels(pose, 0.31, 0.19 * pose.size_m.x(), solids);
}

void add_truck(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids) {
  const double a = 0.5 * pose.size_m.x();
  const double w = 0.5 * pose.size_m.y();
  const double h = pose.size_m.z();
  Primitive load = box_at({-0.55, 0.0, 0.5 * (h + 1.05)}, {a - 0.95, w, 0.5 * (h - 1.05)}, pose);
  load.material = Material::kTarp;
  load.albedo = seed % 2U == 0U ? 0.55F : 0.22F;
  solids.push_back(load);
  Primitive cab = box_at({a - 0.9, 0.0, 0.5 * (2.9 + 0.5)}, {0.9, w - 0.05, 1.2}, pose);
  cab.material = Material::kPaint;
  cab.albedo = paint_of(seed + 7U);
  cab.gloss = 0.4F;
  solids.push_back(cab);
  Primitive frame = box_at({-0.4, 0.0, 0.85}, {a - 0.8, 0.45, 0.2}, pose);
  frame.material = Material::kMetal;
  frame.albedo = 0.05F;
  solids.push_back(frame);
  Primitive guard = box_at({-a + 0.18, 0.0, 0.55}, {0.06, w - 0.1, 0.09}, pose);
  guard.material = Material::kPaint;
  guard.albedo = 0.25F;
  solids.push_back(guard);
  add_wheels(pose, 0.48, 0.15 * pose.size_m.x(), solids);
}

}  // namespace

Vector3d vehicle_size(VehicleKind kind, std::uint32_t seed) {
  Random random(hash_keys(seed, 0x512e));
  switch (kind) {
    case VehicleKind::kVan:
      return {random.uniform(4.6, 5.3), random.uniform(1.85, 2.0), random.uniform(1.9, 2.3)};
    case VehicleKind::kTruck:
      return {random.uniform(8.5, 12.0), 2.5, random.uniform(3.5, 3.9)};
    case VehicleKind::kCar:
      break;
  }
  return {random.uniform(3.7, 4.7), random.uniform(1.66, 1.85), random.uniform(1.38, 1.58)};
}

void add_vehicle(const ObjectPose& pose, std::uint32_t seed, std::int32_t object,
                 std::vector<Primitive>& solids) {
  const std::size_t first = solids.size();
  if (pose.kind == VehicleKind::kTruck) {
    add_truck(pose, seed, solids);
  } else {
    add_car(pose, seed, solids);
  }
  for (std::size_t i = first; i < solids.size(); ++i) {
    solids[i].object = object;
    solids[i].seed = seed;
    solids[i].velocity = pose.velocity;
  }
}

Se3 stand_on(const Terrain& terrain, const Eigen::Vector2d& p_map, double yaw_rad) {
  const Vector3d up = terrain.normal(p_map.x(), p_map.y());
  const Vector3d forward(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  Se3 T;
  const Vector3d left = up.cross(forward).normalized();
  T.R.col(0) = left.cross(up);
  T.R.col(1) = left;
  T.R.col(2) = up;
  T.t = {p_map.x(), p_map.y(), terrain.height(p_map.x(), p_map.y())};
  return T;
}

}  // namespace plumb::synth
