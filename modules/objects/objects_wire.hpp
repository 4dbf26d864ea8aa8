/// ObjectsOutput <-> objects_t. No LCM instance.
#pragma once

#include "modules/objects/objects.hpp"
#include "plumb/objects_t.hpp"

namespace plumb {

/// Allocates only while `message` holds fewer objects than ever before; reserve kMaxObjects once.
void to_wire(const ObjectsOutput& output, objects_t* message);

/// Null, and `output` filled, when the message keeps its contract; else why not.
[[nodiscard]] const char* from_wire(const objects_t& message, ObjectsOutput* output);

}  // namespace plumb
