#include "modules/objects/object_prior.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/detections/box_screen.hpp"
#include "modules/objects/object_prediction.hpp"

namespace plumb {
namespace {

/// Standard deviation of a hidden edge, in heights of the box per hidden share of the edge.
constexpr double kHiddenEdgeStd = 0.5;

void set_prior(StateEstimate* estimate, StateRow row, double mean, double std) {
  estimate->x(row) = mean;
  estimate->P(row, row) = std * std;
}

}  // namespace

HeightPrior height_prior(const TrackView& view, ObjectClass object_class) {
  const HeightPrior known = view.detections.height_prior(object_class);
  if (known.mean_m > 0.0) return known;
  return {view.objects.unknown_height_m, view.objects.unknown_height_std_m};
}

Contact contact_of(const ObjectsConfig& config, ObjectClass object_class) {
  const bool wheels =
      object_class != ObjectClass::kPedestrian && object_class != ObjectClass::kCyclist;
  return wheels ? Contact{config.contact_inset_m, config.contact_inset_std_m} : Contact{};
}

MeasuredBox measured_box(const DetectionsConfig& config, const CameraModel& camera,
                         const DetectionFrame& frame, std::size_t index) {
  const Box& box = frame.detections[index].box;
  const double var_px2 =
      square(config.edge_std_px) + square(config.edge_std_ratio * box.height_px());
  const HiddenEdges hidden = hidden_edges(frame, index);
  const CutSides cut = cut_sides(camera, box, config.border_px);
  MeasuredBox measured;
  measured.edges_px = {box.left_px, box.top_px, box.right_px, box.bottom_px};
  measured.var_px2.setConstant(var_px2);
  measured.var_px2(1) += square(kHiddenEdgeStd * hidden.upper_ratio * box.height_px());
  measured.var_px2(3) += square(kHiddenEdgeStd * hidden.lower_ratio * box.height_px());
  measured.cut = {cut.left, cut.top, cut.right, cut.bottom};
  return measured;
}

bool is_whole(const MeasuredBox& box) {
  return std::none_of(box.cut.begin(), box.cut.end(), [](bool cut) { return cut; });
}

StateEstimate prior_of(const TrackView& view, const Detection& detection, const MeasuredBox& box,
                       double yaw_rad) {
  const HeightPrior height = height_prior(view, detection.object_class);
  const FootprintPrior& footprint = view.objects.footprint(detection.object_class);
  const double distance_m = height.mean_m * view.camera.fy_px / (box.edges_px(3) - box.edges_px(1));
  const Eigen::Vector2d middle_px(0.5 * (box.edges_px(0) + box.edges_px(2)), box.edges_px(3));
  const double left_m = -distance_m * view.camera.to_normalized(middle_px).x();
  // This prior carries no information on the position except that it is in front of the camera.
  const double position_std_m = 0.5 * distance_m + 5.0;

  StateEstimate estimate;
  set_prior(&estimate, kX, distance_m, position_std_m);
  set_prior(&estimate, kY, left_m, position_std_m);
  set_prior(&estimate, kVelocityX, 0.0, view.objects.start_speed_std_m_s);
  set_prior(&estimate, kVelocityY, 0.0, view.objects.start_speed_std_m_s);
  set_prior(&estimate, kYaw, yaw_rad, kHeadingStd_rad);
  set_prior(&estimate, kLogWidth, std::log(footprint.width_m),
            footprint.width_std_m / footprint.width_m);
  set_prior(&estimate, kLogRatio, std::log(footprint.ratio), footprint.ratio_std / footprint.ratio);
  set_prior(&estimate, kLogHeight, std::log(height.mean_m), height.std_m / height.mean_m);
  set_prior(&estimate, kPlaneError, 0.0, std::sqrt(plane_error_var(view, {distance_m, left_m})));
  return estimate;
}

}  // namespace plumb
