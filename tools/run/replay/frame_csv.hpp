/// One line of text for each image: everything the chain said about it.
///
/// Cells whose values are not valid are empty; the status says why. Numbers have as many digits as
/// it takes to read back the same bits, so that two runs can be compared as text. Columns with
/// stage times come only on request: they alone differ from run to run. Columns keep their names
/// and places; new ones are appended at the end.
#pragma once

#include <string>

#include "modules/chain/chain.hpp"

namespace plumb {

[[nodiscard]] std::string frame_csv_header(bool with_times);
[[nodiscard]] std::string frame_csv_row(const FrameRecord& record, bool with_times);

}  // namespace plumb
