/// The truth of a frame: the local road plane and the labelled objects.
///
/// Frames:
///   cam: x right, y down, z forward. The plane's normal points down: n . X = h with h > 0.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/camera_model.hpp"
#include "tools/synth/renderer.hpp"

namespace plumb::synth {

struct PlaneTruth {
  Eigen::Vector3d n_cam = Eigen::Vector3d::UnitY();
  double height_m = 0.0;
  int num_points = 0;      ///< road points used
  int num_candidates = 0;  ///< grid points looked at
  double rms_m = 0.0;
};

/// Least-squares plane of the road 5..20 m ahead of the camera, within 1.8 m of its vertical plane,
/// on a 0.25 m grid.
/// Where less than a third of that is road (sharp bends), the land at road level counts as well.
[[nodiscard]] PlaneTruth road_plane(const Terrain& terrain, const Se3& T_map_cam);

/// One row of KITTI's tracking labels.
struct Label {
  std::int32_t object = 0;
  VehicleKind kind = VehicleKind::kCar;
  int truncated = 0;  ///< 0 inside the image, 1 cut, 2 mostly outside
  int occluded = 0;   ///< 0 visible, 1 partly, 2 largely hidden
  double left_px = 0.0;
  double top_px = 0.0;
  double right_px = 0.0;
  double bottom_px = 0.0;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< length, width, height
  Eigen::Vector3d p_cam = Eigen::Vector3d::Zero();   ///< bottom centre
  double rotation_y_rad = 0.0;
  double alpha_rad = 0.0;
};

/// Labels of every object that shows at least `min_pixels`. `solids` are the frame's visible
/// solids.
[[nodiscard]] std::vector<Label> make_labels(const RenderedFrame& frame,
                                             const std::vector<Primitive>& solids,
                                             const CameraModel& camera, const Se3& T_map_cam,
                                             int min_pixels);

[[nodiscard]] std::string label_row(int frame, const Label& label);

/// Corners (boxes, convex solids) or rim points (wheels) in the map.
[[nodiscard]] std::vector<Eigen::Vector3d> outline(const Primitive& solid);

}  // namespace plumb::synth
