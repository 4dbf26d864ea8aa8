#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"
#include "tools/synth/scene.hpp"
#include "tools/synth/vehicle.hpp"
#include "tools/synth/vehicle_parts.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector3d;

void add_wheels(const ObjectPose& pose, double radius, double inset,
                std::vector<Primitive>& solids) {
  for (const double end : {0.5 * pose.size_m.x() - inset, -0.5 * pose.size_m.x() + inset})
    add_axle(pose, end, radius, solids);
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
    case VehicleKind::kArticulated:
      return {random.uniform(15.5, 16.5), 2.55, random.uniform(3.8, 4.0)};
    case VehicleKind::kBus:
      return {random.uniform(11.0, 12.5), 2.5, random.uniform(3.0, 3.2)};
    case VehicleKind::kTram:
      return {random.uniform(26.0, 32.0), 2.35, random.uniform(3.3, 3.6)};
    case VehicleKind::kPerson:
      return {random.uniform(0.35, 0.5), random.uniform(0.42, 0.6), random.uniform(1.55, 1.9)};
    case VehicleKind::kCar:
      break;
  }
  return {random.uniform(3.7, 4.7), random.uniform(1.66, 1.85), random.uniform(1.38, 1.58)};
}

void add_vehicle(const ObjectPose& pose, std::uint32_t seed, std::int32_t object,
                 std::vector<Primitive>& solids) {
  const std::size_t first = solids.size();
  switch (pose.kind) {
    case VehicleKind::kTruck:
      add_truck(pose, seed, solids);
      break;
    case VehicleKind::kArticulated:
      add_articulated(pose, seed, solids);
      break;
    case VehicleKind::kBus:
      add_bus(pose, seed, solids);
      break;
    case VehicleKind::kTram:
      add_tram(pose, seed, solids);
      break;
    case VehicleKind::kPerson:
      add_person(pose, seed, solids);
      break;
    case VehicleKind::kCar:
    case VehicleKind::kVan:
      add_car(pose, seed, solids);
      break;
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
