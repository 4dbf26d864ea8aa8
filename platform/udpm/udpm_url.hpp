/// The LCM URL of a UDP multicast network: udpm://ADDRESS:PORT?ttl=N&recv_buf_size=N&source=ADDRESS
///
/// Address and port default to 239.255.76.67:7667. `ttl` says how far messages that are sent go: 0
/// (the default) keeps them on this machine, 1 on the local network. `recv_buf_size` is the size of
/// the kernel's receive buffer in bytes. These are as in liblcm. `source`, which liblcm does not
/// know and which may be repeated, names another machine whose messages are received, whatever the
/// ttl.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumb {

/// The network cannot be used. The text says why in one sentence.
class UdpmError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct UdpmUrl {
  static constexpr std::uint32_t kDefaultGroup = 0xEFFF4C43;  ///< 239.255.76.67
  static constexpr std::uint16_t kDefaultPort = 7667;

  std::uint32_t group = kDefaultGroup;  ///< host byte order, a multicast address
  std::uint16_t port = kDefaultPort;
  std::uint8_t ttl = 0;
  int receive_buffer_bytes = 0;        ///< 0: not named
  std::vector<std::uint32_t> sources;  ///< host byte order
};

/// Throws UdpmError for what is not such a URL, unknown keys included.
[[nodiscard]] UdpmUrl parse_udpm_url(const std::string& url);

}  // namespace plumb
