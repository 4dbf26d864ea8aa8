/// Converts detections_t to DetectionFrame and back, without an LCM instance.
#pragma once

#include "modules/detections/detection.hpp"
#include "plumb/detections_t.hpp"

namespace plumb {

/// Fills `frame` and returns null when the message keeps its contract, and else returns the reason
/// as a string literal. One wrong box makes the whole message invalid, because a detector that made
/// one error cannot be trusted for the rest of the image.
[[nodiscard]] const char* from_wire(const detections_t& message, DetectionFrame* frame);

/// Fills `message`. Allocates only while its list grows.
void to_wire(const DetectionFrame& frame, detections_t* message);

}  // namespace plumb
