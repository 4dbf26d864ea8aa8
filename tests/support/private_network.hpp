/// Gives a test its own network, so that multicast cannot leave it and parallel tests do not
/// receive each other's messages.
#pragma once

#include <sched.h>
#include <unistd.h>

#include <cstdlib>

namespace plumb::test {

/// Moves this process and its later children to an empty network namespace with multicast on its
/// loopback. Returns false where that is not permitted.
/// @pre no thread was started yet
inline bool enter_private_network() {
  if (::unshare(CLONE_NEWNET) != 0 && ::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
  return std::system(
             "ip link set lo up multicast on 2>/dev/null && "
             "ip route add 224.0.0.0/4 dev lo 2>/dev/null") == 0;
}

inline constexpr const char* kNoPrivateNetwork =
    "a private network namespace is not permitted here (unshare -n)";

}  // namespace plumb::test
