/// A TCP socket that listens.
#pragma once

#include <string>

namespace plumb {

/// Listens on an IPv4 address; port 0 takes a free one. Throws std::runtime_error, which names the
/// address, when that is not possible.
[[nodiscard]] int listen_on(const std::string& host, int port);
/// The port of a socket that listens. Throws std::runtime_error when it does not.
[[nodiscard]] int listening_port(int fd);
/// Whether a browser that names `host` (with or without a port) can only mean this machine: an
/// IPv4 address, "localhost" or the machine's own name.
[[nodiscard]] bool is_own_host(const std::string& host);

}  // namespace plumb
