#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"
#include "tools/synth/scene.hpp"

namespace plumb::synth {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Places things beside the route; nothing may stand on any road.
class Gardener {
 public:
  Gardener(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still,
           std::vector<ObjectPose>& parked)
      : terrain_(terrain),
        setting_(terrain.route().setting),
        random_(hash_keys(seed, 0x6a2d)),
        still_(still),
        parked_(parked) {}

  void plant() {
    for (const double side : {1.0, -1.0}) {
      plant_houses(side);
      plant_borders(side);
      plant_trees(side);
      plant_posts(side);
      if (setting_.parked_ratio > 0.0) park(side);
      if (setting_.guard_rail) plant_rail(side);
    }
  }

 private:
  struct Disc {
    Vector2d centre;
    double radius_m;
  };
  struct Place {
    Vector2d p;
    double yaw_rad;
  };

  /// Place `beyond_m` outside the road edge beside distance `s_m`.
  [[nodiscard]] Place beside(double s_m, double side, double beyond_m) const {
    const RoutePoint at = terrain_.route().at(s_m);
    const double d = side > 0.0 ? setting_.left_m + beyond_m : -(setting_.right_m + beyond_m);
    return {at.p_map + d * Vector2d(-std::sin(at.yaw_rad), std::cos(at.yaw_rad)), at.yaw_rad};
  }

  [[nodiscard]] bool clear_of_road(const Place& place, double half_x, double half_y,
                                   double distance_m) const {
    const Vector2d ex(std::cos(place.yaw_rad), std::sin(place.yaw_rad));
    const Vector2d ey(-ex.y(), ex.x());
    for (double x = -half_x; x <= half_x + 1e-9;
         x += std::max(0.1, half_x / std::ceil(half_x / 2.0))) {
      for (double y = -half_y; y <= half_y + 1e-9;
           y += std::max(0.1, half_y / std::ceil(half_y / 2.0))) {
        const Vector2d p = place.p + x * ex + y * ey;
        if (terrain_.edge_distance(p.x(), p.y()) < distance_m) return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool free_of_houses(const Vector2d& p, double radius_m) const {
    return std::none_of(houses_.begin(), houses_.end(), [&](const Disc& house) {
      const double reach = house.radius_m + radius_m;
      return (house.centre - p).squaredNorm() < reach * reach;
    });
  }

  Primitive solid(Shape shape, Material material, const Vector2d& p, double yaw_rad,
                  const Vector3d& half, double bottom_m) {
    Primitive s;
    s.shape = shape;
    s.material = material;
    s.seed = static_cast<std::uint32_t>(random_.next());
    s.half = half;
    s.R_map_local = exp_so3({0.0, 0.0, yaw_rad});
    s.centre = {p.x(), p.y(), terrain_.base_height(p.x(), p.y()) + bottom_m + half.z()};
    return s;
  }

  void add_house(const Place& place, double half_x, double half_y) {
    const double height = 2.9 * (1.0 + random_.below(3)) + random_.uniform(0.3, 1.2);
    Primitive walls = solid(Shape::kBox, Material::kFacade, place.p, place.yaw_rad,
                            {half_x, half_y, 0.5 * height + 0.7}, -1.4);
    walls.albedo = static_cast<float>(random_.chance(0.7) ? random_.uniform(0.5, 0.85)
                                                          : random_.uniform(0.16, 0.45));
    still_.push_back(walls);
    const double rise = random_.chance(0.8) ? random_.uniform(0.55, 1.0) * half_y : 0.5;
    Primitive roof = solid(Shape::kConvex, Material::kRoof, place.p, place.yaw_rad,
                           {half_x + 0.35, half_y + 0.45, 0.5 * rise}, height - 0.1);
    const double run = roof.half.y();
    const double slope = 1.0 / std::hypot(rise, run);
    roof.num_planes = 5;
    roof.planes[0] = {Vector3d(0.0, rise, run) * slope, 0.5 * rise * run * slope};
    roof.planes[1] = {Vector3d(0.0, -rise, run) * slope, 0.5 * rise * run * slope};
    roof.planes[2] = {Vector3d::UnitX(), roof.half.x()};
    roof.planes[3] = {-Vector3d::UnitX(), roof.half.x()};
    roof.planes[4] = {-Vector3d::UnitZ(), roof.half.z()};
    roof.albedo = static_cast<float>(random_.uniform(0.06, 0.2));
    still_.push_back(roof);
    houses_.push_back({place.p, std::hypot(half_x, half_y)});
  }

  void plant_houses(double side) {
    const double length = terrain_.route().length_m();
    for (double s = random_.uniform(0.0, 10.0); s < length;) {
      const double half_x = random_.uniform(4.5, 11.0);
      const double half_y = random_.uniform(4.0, 6.5);
      const double beyond =
          setting_.setback_m + half_y + (random_.chance(0.5) ? 0.0 : random_.uniform(0.0, 6.0));
      const Place place = beside(s + half_x, side, beyond);
      const bool wanted = random_.chance(setting_.house_ratio);
      if (wanted && clear_of_road(place, half_x + 0.5, half_y + 0.5, 2.0) &&
          free_of_houses(place.p, std::max(half_x, half_y))) {
        add_house(place, half_x, half_y);
      }
      s += 2.0 * half_x + random_.uniform(0.5, 7.0);
    }
  }

  /// Hedges, walls and fences along the plots.
  void plant_borders(double side) {
    if (setting_.guard_rail) return;
    const double length = terrain_.route().length_m();
    for (double s = 0.0; s < length;) {
      const double half = random_.uniform(2.0, 6.0);
      const Place place = beside(s + half, side, setting_.sidewalk_m + random_.uniform(0.4, 0.7));
      const double pick = random_.uniform();
      s += 2.0 * half + (random_.chance(0.3) ? random_.uniform(2.0, 6.0) : 0.05);
      if (!clear_of_road(place, half, 0.4, setting_.sidewalk_m - 0.4) ||
          !free_of_houses(place.p, 0.5))
        continue;
      if (pick > 0.75) {
        plant_bushes(place, half);
        continue;
      }
      const Material material = pick < 0.35  ? Material::kHedge
                                : pick < 0.6 ? Material::kBrick
                                             : Material::kFence;
      const double height =
          material == Material::kHedge ? random_.uniform(0.8, 1.9) : random_.uniform(0.5, 1.3);
      const double thickness = material == Material::kHedge   ? 0.45
                               : material == Material::kBrick ? 0.15
                                                              : 0.03;
      Primitive border = solid(Shape::kBox, material, place.p, place.yaw_rad,
                               {half, thickness, 0.5 * height + 0.2}, -0.4 + setting_.kerb_m);
      border.albedo = static_cast<float>(material == Material::kHedge ? random_.uniform(0.08, 0.13)
                                                                      : random_.uniform(0.12, 0.5));
      border.R_map_local = stand_on(terrain_, place.p, place.yaw_rad).R;
      still_.push_back(border);
    }
  }

  void plant_bushes(const Place& place, double half_m) {
    const Vector2d along(std::cos(place.yaw_rad), std::sin(place.yaw_rad));
    for (double x = -half_m; x < half_m; x += random_.uniform(0.7, 2.2)) {
      const double wide = random_.uniform(0.35, 1.0);
      const Vector2d p = place.p + x * along;
      if (terrain_.edge_distance(p.x(), p.y()) < wide + 0.3) continue;
      Primitive bush = solid(Shape::kLeaves, Material::kLeaves, p, random_.uniform(0.0, 6.28),
                             {wide, wide * 0.9, wide * random_.uniform(0.7, 1.3)}, -0.25);
      bush.albedo = static_cast<float>(random_.uniform(0.07, 0.16));
      still_.push_back(bush);
    }
  }

  void add_tree(const Vector2d& p, double height_m) {
    const double trunk = height_m * random_.uniform(0.25, 0.4);
    Primitive stem =
        solid(Shape::kCylinder, Material::kBark, p, 0.0,
              {0.02 * height_m + 0.05, 0.02 * height_m + 0.05, 0.5 * trunk + 1.0}, -0.5);
    stem.half.y() = stem.half.x();
    stem.albedo = 0.09F;
    still_.push_back(stem);
    const bool conifer = random_.chance(0.2);
    const double crown = 0.5 * (height_m - trunk);
    const int clumps = conifer ? 3 : 5 + random_.below(4);
    for (int i = 0; i < clumps; ++i) {
      const double up = conifer ? trunk + crown * (0.3 + 0.6 * i)
                                : trunk + crown * (i == 0 ? 0.9 : random_.uniform(0.45, 1.4));
      const double wide = conifer ? crown * (0.62 - 0.17 * i)
                                  : crown * (i == 0 ? 0.75 : random_.uniform(0.4, 0.65));
      const double tall = conifer ? crown * 0.6 : wide * random_.uniform(0.7, 1.0);
      const double turn = random_.uniform(0.0, 6.28);
      const double out = conifer || i == 0 ? 0.0 : crown * random_.uniform(0.15, 0.6);
      Primitive leaves = solid(Shape::kLeaves, Material::kLeaves,
                               p + out * Vector2d(std::cos(turn), std::sin(turn)), turn,
                               {wide, wide * 0.95, tall}, up - tall);
      leaves.albedo = static_cast<float>(random_.uniform(0.07, 0.15));
      still_.push_back(leaves);
    }
  }

  void plant_trees(double side) {
    const double length = terrain_.route().length_m();
    for (double s = random_.uniform(0.0, 8.0); s < length; s += random_.uniform(5.0, 12.0)) {
      if (!random_.chance(setting_.tree_ratio)) continue;
      const bool street = !setting_.guard_rail && random_.chance(0.4);
      const double beyond =
          street ? random_.uniform(0.9, 1.6)
                 : setting_.sidewalk_m + random_.uniform(2.0, setting_.guard_rail ? 22.0 : 9.0);
      const Place place = beside(s, side, beyond);
      if (terrain_.edge_distance(place.p.x(), place.p.y()) < 0.7 || !free_of_houses(place.p, -1.0))
        continue;
      add_tree(place.p, random_.uniform(4.0, 12.0));
    }
    for (double s = 0.0; s < length; s += 16.0) {  // far rows close the view
      const Place place = beside(s + random_.uniform(0.0, 16.0), side, random_.uniform(24.0, 36.0));
      if (terrain_.edge_distance(place.p.x(), place.p.y()) > 8.0 && free_of_houses(place.p, 1.0))
        add_tree(place.p, random_.uniform(7.0, 15.0));
    }
  }

  void plant_posts(double side) {
    const double length = terrain_.route().length_m();
    for (double s = random_.uniform(0.0, 20.0); s < length; s += random_.uniform(10.0, 28.0)) {
      const Place place = beside(s, side, random_.uniform(0.5, 0.8));
      if (terrain_.edge_distance(place.p.x(), place.p.y()) < 0.4) continue;
      const bool lamp = random_.chance(0.5);
      const double height = lamp ? random_.uniform(5.5, 8.0) : random_.uniform(2.2, 2.8);
      Primitive post =
          solid(Shape::kCylinder, Material::kMetal, place.p, 0.0, {0.06, 0.06, 0.5 * height}, -0.1);
      post.albedo = static_cast<float>(random_.uniform(0.15, 0.45));
      still_.push_back(post);
      const double turn = place.yaw_rad + (side > 0.0 ? 3.14159265 : 0.0);
      Primitive head =
          lamp
              ? solid(Shape::kBox, Material::kMetal, place.p, turn, {0.12, 0.5, 0.07}, height - 0.1)
              : solid(Shape::kBox, Material::kSign, place.p, turn, {0.02, 0.3, 0.3}, height - 0.6);
      head.albedo = lamp ? 0.3F : 0.6F;
      still_.push_back(head);
    }
  }

  void plant_rail(double side) {
    const double length = terrain_.route().length_m();
    for (double s = 0.0; s + 4.0 < length; s += 4.0) {
      const Place place = beside(s + 2.0, side, 0.8);
      if (terrain_.edge_distance(place.p.x(), place.p.y()) < 0.5) continue;
      Primitive rail =
          solid(Shape::kBox, Material::kMetal, place.p, place.yaw_rad, {2.02, 0.04, 0.15}, 0.45);
      rail.albedo = 0.3F;
      rail.R_map_local = stand_on(terrain_, place.p, place.yaw_rad).R;
      still_.push_back(rail);
      Primitive post =
          solid(Shape::kBox, Material::kMetal, place.p, place.yaw_rad, {0.05, 0.06, 0.35}, -0.1);
      post.albedo = 0.3F;
      still_.push_back(post);
    }
  }

  void park(double side) {
    const double length = terrain_.route().length_m();
    for (double s = random_.uniform(0.0, 6.0); s < length; s += random_.uniform(5.6, 7.5)) {
      if (!random_.chance(setting_.parked_ratio)) continue;
      const double beyond = side > 0.0 ? random_.uniform(-0.9, 0.3) : random_.uniform(-0.1, 0.4);
      Place place = beside(s, side, beyond);
      const double edge = terrain_.edge_distance(place.p.x(), place.p.y());
      if (edge < beyond - 0.3 || !clear_of_road(place, 2.6, 0.0, beyond - 0.5)) continue;
      place.yaw_rad += (side > 0.0 ? 3.14159265 : 0.0) + 0.02 * random_.normal();
      ObjectPose pose;
      const auto seed = static_cast<std::uint32_t>(random_.next());
      pose.kind = random_.chance(0.12) ? VehicleKind::kVan : VehicleKind::kCar;
      pose.size_m = vehicle_size(pose.kind, seed);
      pose.T_map_object = stand_on(terrain_, place.p, place.yaw_rad);
      if (edge > 0.0) pose.T_map_object.t.z() += setting_.kerb_m;
      add_vehicle(pose, seed, static_cast<std::int32_t>(parked_.size()), still_);
      parked_.push_back(pose);
    }
  }

  const Terrain& terrain_;
  const Setting& setting_;
  Random random_;
  std::vector<Primitive>& still_;
  std::vector<ObjectPose>& parked_;
  std::vector<Disc> houses_;
};

}  // namespace

void add_scenery(const Terrain& terrain, std::uint64_t seed, std::vector<Primitive>& still,
                 std::vector<ObjectPose>& parked) {
  Gardener(terrain, seed, still, parked).plant();
}

}  // namespace plumb::synth
