/// One line of text per image: everything the chain said about it.
///
/// Cells that do not hold (the status says why) are empty. Numbers have as many digits as it takes
/// to read back the same bits, so two runs can be compared as text. Columns with stage times come
/// last and only on request: they are the only ones that differ from run to run.
#pragma once

#include <string>

#include "modules/chain/chain.hpp"

namespace plumb {

[[nodiscard]] std::string frame_csv_header(bool with_times);
[[nodiscard]] std::string frame_csv_row(const FrameRecord& record, bool with_times);

}  // namespace plumb
