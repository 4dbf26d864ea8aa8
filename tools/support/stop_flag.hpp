/// SIGINT and SIGTERM as a flag that a long job looks at between frames.
#pragma once

namespace plumb {

/// From now on the two signals set the flag; a second one of them kills as usual.
void catch_stop_signals();
[[nodiscard]] bool stop_requested();

}  // namespace plumb
