#include "modules/detector/suppress.hpp"

#include <algorithm>

#include "core/numbers.hpp"

namespace plumb {

void suppress(std::vector<RawBox>* raw, double overlap, DetectionFrame* frame) {
  // A stable sort keeps the network's order of equal scores, so that results are deterministic.
  std::stable_sort(raw->begin(), raw->end(),
                   [](const RawBox& a, const RawBox& b) { return a.score > b.score; });
  frame->detections.clear();
  for (const RawBox& one : *raw) {
    Detection* owner = nullptr;
    for (Detection& kept : frame->detections) {
      if (kept.object_class == one.object_class &&
          intersection_over_union(kept.box, one.box) >= overlap) {
        owner = &kept;
        break;
      }
    }
    if (owner == nullptr) {
      Detection detection;
      detection.object_class = one.object_class;
      detection.score = one.score;
      detection.box = one.box;
      detection.truncated_ratio = kNan;
      if (!frame->detections.push_back(detection)) continue;
      owner = &frame->detections[frame->detections.size() - 1];
    }
    (void)owner->candidates.push_back({one.box, one.score});
  }
}

}  // namespace plumb
