#include "modules/vo/road_points.hpp"

#include <cmath>

#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr int kMinImages = 3;
constexpr double kMaxRelStd = 0.5;  // standard deviation of the inverse depth, as a share of it

}  // namespace

void collect_road_points(const TrackTable& tracks, const Window& window, const Se3& T_cam_world,
                         FixedVector<RoadPoint, kMaxRoadPoints>* points) {
  points->clear();
  const auto T_cam_slot = window.slots_to_cam(T_cam_world);
  for (const int index : tracks.active()) {
    const Track& track = tracks[index];
    if (track.num_images < kMinImages) continue;
    const Se3& T_cam_host = T_cam_slot[static_cast<std::size_t>(track.host)];
    double rho = 0.0;
    double rho_std = 0.0;
    if (!inverse_depth_in(track, T_cam_host, &rho, &rho_std)) continue;
    const Eigen::Vector3d p_cam = transfer_point(T_cam_host, track.host_xy, track.rho) / track.rho;
    if (!(p_cam.y() > 0.0) || rho_std > kMaxRelStd * rho) continue;
    RoadPoint point;
    point.p_cam = p_cam.cast<float>();
    point.px = track.px.cast<float>();
    point.rel_std = static_cast<float>(rho_std / rho);
    point.num_obs = static_cast<std::int16_t>(track.num_images);
    if (!points->push_back(point)) return;
  }
}

}  // namespace plumb::vo
