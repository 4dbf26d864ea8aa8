/// Exit codes that every plumb-* program shares.
#pragma once

namespace plumb {

inline constexpr int kExitOk = 0;
inline constexpr int kExitMachine = 1;  ///< the machine failed: no network, no descriptors
inline constexpr int kExitRefused = 2;  ///< an option, key, value or file was refused

}  // namespace plumb
