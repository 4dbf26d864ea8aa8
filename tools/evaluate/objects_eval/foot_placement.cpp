#include "tools/evaluate/objects_eval/foot_placement.hpp"

#include <algorithm>

namespace plumb {

Eigen::Vector2d place_by_foot(const CameraModel& camera, const RoadPlane& road, const Box& box,
                              const FootprintPrior& size, double truth_m) {
  constexpr double kFarthestRatio = 3.0;
  const Eigen::Vector2d foot_px(box.centre_u_px(), box.bottom_px);
  const auto point = back_project_foot(camera, road, foot_px);
  const double farthest_m = kFarthestRatio * truth_m;
  const double z_m = point ? point->z() + 0.5 * size.width_m * size.ratio : farthest_m;
  const double held_m = std::min(z_m, farthest_m);
  return {held_m, held_m * camera.to_normalized(foot_px).x()};
}

}  // namespace plumb
