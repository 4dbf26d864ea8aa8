/// Turns SIGINT and SIGTERM into a flag that a long job checks between frames.
#pragma once

namespace plumb {

/// From now on the first of the two signals sets the flag; a second one ends the program.
void catch_stop_signals();
[[nodiscard]] bool stop_requested();

}  // namespace plumb
