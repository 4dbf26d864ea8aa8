#include <algorithm>

#include "tools/synth/random.hpp"
#include "tools/synth/vehicle_parts.hpp"

namespace plumb::synth {
namespace {

/// The body of a bus or of one car of a tram, from `from_m` to `to_m`.
void add_coach(const ObjectPose& pose, double from_m, double to_m, float albedo,
               std::vector<Primitive>& solids) {
  const double h = pose.size_m.z();
  Primitive body = box_at({0.5 * (from_m + to_m), 0.0, 0.5 * (h + 0.3)},
                          {0.5 * (to_m - from_m), 0.5 * pose.size_m.y(), 0.5 * (h - 0.3)}, pose);
  body.material = Material::kCoach;
  body.albedo = albedo;
  body.gloss = 0.25F;
  solids.push_back(body);
}

}  // namespace

void add_articulated(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids) {
  const double a = 0.5 * pose.size_m.x();
  const double w = 0.5 * pose.size_m.y();
  const double h = pose.size_m.z();
  static constexpr float kTones[] = {0.6F, 0.5F, 0.3F, 0.12F, 0.7F, 0.2F};
  Primitive load = box_at({-1.4, 0.0, 0.5 * (h + 1.15)}, {a - 1.4, w, 0.5 * (h - 1.15)}, pose);
  load.material = Material::kTarp;
  load.albedo = kTones[hash_keys(seed, 0x7a29) % 6U];
  solids.push_back(load);
  Primitive cab = box_at({a - 1.1, 0.0, 0.5 * (3.6 + 0.45)}, {1.1, w - 0.03, 1.55}, pose);
  cab.material = Material::kPaint;
  cab.albedo = paint_of(seed + 7U);
  cab.gloss = 0.4F;
  solids.push_back(cab);
  Primitive frame = box_at({-0.5, 0.0, 0.95}, {a - 0.6, 0.45, 0.2}, pose);
  frame.material = Material::kMetal;
  frame.albedo = 0.05F;
  solids.push_back(frame);
  Primitive guard = box_at({-a + 0.12, 0.0, 0.6}, {0.06, w - 0.1, 0.1}, pose);
  guard.material = Material::kPaint;
  guard.albedo = 0.25F;
  solids.push_back(guard);
  Primitive skirt = box_at({-0.2, 0.0, 0.75}, {0.3 * a, w - 0.08, 0.22}, pose);
  skirt.material = Material::kMetal;
  skirt.albedo = 0.2F;
  solids.push_back(skirt);
  for (const double x : {a - 1.4, a - 5.0, -a + 4.6, -a + 3.3, -a + 2.0})
    add_axle(pose, x, 0.5, solids);
}

void add_bus(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids) {
  const double a = 0.5 * pose.size_m.x();
  add_coach(pose, -a, a, hash_keys(seed, 0xb05) % 2U == 0U ? 0.5F : 0.18F, solids);
  for (const double x : {a - 2.6, -a + 3.3}) add_axle(pose, x, 0.48, solids);
}

void add_tram(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids) {
  const double a = 0.5 * pose.size_m.x();
  const float albedo = hash_keys(seed, 0x72a3) % 2U == 0U ? 0.55F : 0.25F;
  const double third = pose.size_m.x() / 3.0;
  for (int car = 0; car < 3; ++car) {
    const double from = -a + car * third;
    add_coach(pose, from + (car > 0 ? 0.35 : 0.0), from + third, albedo, solids);
  }
  for (int joint = 1; joint < 3; ++joint) {  // bellows
    Primitive bellows = box_at({-a + joint * third + 0.15, 0.0, 0.5 * pose.size_m.z() + 0.1},
                               {0.25, 0.5 * pose.size_m.y() - 0.15, 0.45 * pose.size_m.z()}, pose);
    bellows.material = Material::kMetal;
    bellows.albedo = 0.04F;
    solids.push_back(bellows);
  }
}

void add_person(const ObjectPose& pose, std::uint32_t seed, std::vector<Primitive>& solids) {
  const double tall = pose.size_m.z();
  const double half_x = 0.5 * pose.size_m.x();
  const double half_y = 0.5 * pose.size_m.y();
  const auto tone = [&](std::uint64_t purpose) {
    return static_cast<float>(0.03 + 0.5 * uniform_of(hash_keys(seed, purpose)));
  };
  Primitive legs = box_at({0.0, 0.0, 0.25 * tall}, {0.7 * half_x, 0.6 * half_y, 0.25 * tall}, pose);
  legs.material = Material::kBark;
  legs.albedo = 0.5F * tone(1);
  solids.push_back(legs);
  Primitive torso =
      box_at({0.0, 0.0, 0.67 * tall}, {0.75 * half_x, 0.75 * half_y, 0.19 * tall}, pose);
  torso.shape = Shape::kCylinder;
  torso.half.y() = torso.half.x();
  torso.material = Material::kBark;
  torso.albedo = tone(2);
  solids.push_back(torso);
  Primitive head = box_at({0.0, 0.0, 0.93 * tall}, {0.1, 0.1, 0.07 * tall}, pose);
  head.shape = Shape::kCylinder;
  head.material = Material::kBark;
  head.albedo = tone(3);
  solids.push_back(head);
}

}  // namespace plumb::synth
