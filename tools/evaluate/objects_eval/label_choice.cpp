#include "tools/evaluate/objects_eval/label_choice.hpp"

#include <algorithm>

namespace plumb {
namespace {

constexpr double kLeastOverlap = 0.5;

}  // namespace

bool is_evaluated(const TrackingRow& row, const std::vector<ObjectClass>& classes) {
  const Detection& d = row.detection;
  const bool wanted = std::find(classes.begin(), classes.end(), d.object_class) != classes.end();
  const bool visible = d.occluded == Occlusion::kVisible || d.occluded == Occlusion::kPartly;
  return row.has_box3d && wanted && visible && d.truncated_ratio == 0.0;
}

const Detection* box_of(const TrackingRow& label, const DetectionFrame& frame,
                        bool labels_are_boxes) {
  const Detection* found = nullptr;
  double best = kLeastOverlap;
  for (const Detection& detection : frame.detections) {
    if (labels_are_boxes && detection.track_id != label.detection.track_id) continue;
    const double share = intersection_over_union(detection.box, label.detection.box);
    if (share <= best) continue;
    best = share;
    found = &detection;
  }
  return found;
}

}  // namespace plumb
