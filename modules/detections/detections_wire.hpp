/// detections_t <-> DetectionFrame. No LCM instance.
#pragma once

#include "modules/detections/detection.hpp"
#include "plumb/detections_t.hpp"

namespace plumb {

/// Null, and `frame` filled, when the message keeps its contract; else why not. A contract is broken
/// by one wrong box: a detector that errs once is not believed for the rest of the image.
[[nodiscard]] const char* from_wire(const detections_t& message, DetectionFrame* frame);

/// Allocates while `message` grows to the number of detections.
void to_wire(const DetectionFrame& frame, detections_t* message);

}  // namespace plumb
