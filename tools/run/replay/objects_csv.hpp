/// Rows of the table of objects: one per object and image that was searched. Cells without a valid
/// value are empty.
#pragma once

#include <string>

#include "plumb/objects_t.hpp"

namespace plumb {

[[nodiscard]] std::string objects_csv_header();
[[nodiscard]] std::string objects_csv_row(const objects_t& objects, const object_t& object);

}  // namespace plumb
