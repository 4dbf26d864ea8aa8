/// Greedy non-maximum suppression: reduces the raw boxes of a detector to one detection per object.
///
/// Source:
///   The suppressed boxes are kept as the candidates of eq. (10) of Song and Chandraker, CVPR 2014.
#pragma once

#include <vector>

#include "modules/detections/detection.hpp"

namespace plumb {

struct RawBox {
  Box box;
  double score = 0.0;
  ObjectClass object_class = ObjectClass::kUnknown;
};

/// Sorts `raw` by score and fills `frame`, best detection first. A box whose intersection over
/// union with a better box of its class is at least `overlap` becomes a candidate of that box. The
/// candidates of a detection include its own box and are limited to the best kMaxCandidates.
/// Detections beyond the capacity of the message are dropped.
void suppress(std::vector<RawBox>* raw, double overlap, DetectionFrame* frame);

}  // namespace plumb
