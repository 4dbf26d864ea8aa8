/// Converts ObjectsOutput to objects_t and back, without an LCM instance.
#pragma once

#include "modules/objects/objects.hpp"
#include "plumb/objects_t.hpp"

namespace plumb {

/// Fills `message`. Reserve kMaxObjects in its list once; then this allocates nothing.
void to_wire(const ObjectsOutput& output, objects_t* message);

/// Fills `output` and returns null when the message keeps its contract, and else returns the reason
/// as a string literal.
[[nodiscard]] const char* from_wire(const objects_t& message, ObjectsOutput* output);

}  // namespace plumb
