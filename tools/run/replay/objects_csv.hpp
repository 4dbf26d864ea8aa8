/// One line of text per object and image that was searched. Cells that do not hold are empty.
#pragma once

#include <string>

#include "plumb/objects_t.hpp"

namespace plumb {

[[nodiscard]] std::string objects_csv_header();
[[nodiscard]] std::string objects_csv_row(const objects_t& objects, const object_t& object);

}  // namespace plumb
