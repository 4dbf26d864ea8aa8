/// Many raw boxes of a detector -> one detection per object, each with the raw boxes behind it.
///
/// Source  greedy non-maximum suppression; what it suppresses is kept as the candidates of eq. (10), Song and Chandraker,
///         CVPR 2014.
#pragma once

#include <vector>

#include "modules/detections/detection.hpp"

namespace plumb {

struct RawBox {
  Box box;
  double score = 0.0;
  ObjectClass object_class = ObjectClass::kUnknown;
};

/// Best first; boxes of one class that overlap a better one by `overlap` or more become its candidates (as many as fit,
/// the better ones, the box itself among them). Sorts `raw`. Detections beyond the message's capacity are left out.
void suppress(std::vector<RawBox>* raw, double overlap, DetectionFrame* frame);

}  // namespace plumb
