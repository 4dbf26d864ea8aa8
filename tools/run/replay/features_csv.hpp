/// Rows of the table of features: one per feature and image.
#pragma once

#include <string>

#include "plumb/vo_motion_t.hpp"

namespace plumb {

[[nodiscard]] std::string features_csv_header();
/// Row of the feature with this index. @pre 0 <= index < vo.num_features
[[nodiscard]] std::string features_csv_row(const vo_motion_t& vo, int index);

}  // namespace plumb
