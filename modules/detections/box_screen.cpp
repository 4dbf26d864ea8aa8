#include "modules/detections/box_screen.hpp"

#include <algorithm>
#include <cmath>

#include "modules/detections/foot_point.hpp"

namespace plumb {
namespace {

constexpr double kHorizonSigmas = 3.0;

/// The distance follows from the object's size, because an error of the pitch does not affect that.
/// The horizon test allows for the standard deviation of the pitch.
bool off_road(const DetectionsConfig& config, const CameraModel& camera, const RoadPlane& plane,
              const Detection& detection) {
  const Box& box = detection.box;
  RoadPlane near = plane;
  near.pitch_rad += kHorizonSigmas * std::sqrt(plane.cov(0, 0));
  const Eigen::Vector2d foot_px(box.centre_u_px(), box.bottom_px);
  if (!back_project_foot(camera, near, foot_px)) return true;
  const double distance_m =
      config.height_prior(detection.object_class).mean_m * camera.fy_px / box.height_px();
  const double lateral_m = distance_m * camera.to_normalized(foot_px).x();
  return distance_m > config.max_distance_m || std::abs(lateral_m) > config.max_lateral_m;
}

BoxVerdict screen(const DetectionsConfig& config, const CameraModel& camera, const RoadPlane& plane,
                  const DetectionFrame& frame, std::size_t index) {
  const Detection& d = frame.detections[index];
  if (!(config.height_prior(d.object_class).mean_m > 0.0)) return BoxVerdict::kClassUnknown;
  if (d.score < config.min_score) return BoxVerdict::kLowScore;
  if (d.box.height_px() < config.min_box_height_px) return BoxVerdict::kTooSmall;
  // An unknown ratio is NaN, which compares false, so that the border of the image decides.
  if (d.truncated_ratio > config.max_truncated_ratio ||
      cut_sides(camera, d.box, config.border_px).any()) {
    return BoxVerdict::kTruncated;
  }
  const HiddenEdges hidden = hidden_edges(frame, index);
  if (d.occluded == Occlusion::kLargely || hidden.lower_ratio > config.max_hidden_ratio ||
      hidden.upper_ratio > config.max_hidden_ratio) {
    return BoxVerdict::kOccluded;
  }
  if (off_road(config, camera, plane, d)) return BoxVerdict::kOffRoad;
  return BoxVerdict::kUsed;
}

}  // namespace

HiddenEdges hidden_edges(const DetectionFrame& frame, std::size_t box) {
  const Box& behind = frame.detections[box].box;
  HiddenEdges hidden;
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    const Box& front = frame.detections[i].box;
    if (i == box || front.bottom_px <= behind.bottom_px) continue;
    const double overlap_px = std::max(
        0.0, std::min(front.right_px, behind.right_px) - std::max(front.left_px, behind.left_px));
    const double share = overlap_px / behind.width_px();
    if (front.top_px < behind.bottom_px) hidden.lower_ratio += share;
    if (front.top_px < behind.top_px) hidden.upper_ratio += share;
  }
  hidden.lower_ratio = std::min(1.0, hidden.lower_ratio);
  hidden.upper_ratio = std::min(1.0, hidden.upper_ratio);
  return hidden;
}

CutSides cut_sides(const CameraModel& camera, const Box& box, double border_px) {
  CutSides sides;
  sides.left = box.left_px < border_px;
  sides.top = box.top_px < border_px;
  sides.right = box.right_px > camera.width_px - 1.0 - border_px;
  sides.bottom = box.bottom_px > camera.height_px - 1.0 - border_px;
  return sides;
}

void screen_boxes(const DetectionsConfig& config, const CameraModel& camera, const RoadPlane& plane,
                  const DetectionFrame& frame, Verdicts* verdicts) {
  for (std::size_t i = 0; i < frame.detections.size(); ++i) {
    (*verdicts)[i] = screen(config, camera, plane, frame, i);
  }
}

}  // namespace plumb
