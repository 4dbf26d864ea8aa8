#include "platform/udpm/local_addresses.hpp"

#include <net/if.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

namespace plumb {

bool LocalAddresses::contains(std::uint32_t address, std::int64_t now_us) {
  if (address >> 24U == IN_LOOPBACKNET || address == INADDR_ANY) return true;
  const std::int64_t trusted_us = is_known(address) ? kMaxAge_us : kMinRefresh_us;
  if (!refreshed_ || now_us - refreshed_us_ >= trusted_us) refresh(now_us);
  return is_known(address);
}

bool LocalAddresses::is_known(std::uint32_t address) const {
  const auto* end = addresses_.begin() + num_addresses_;
  return std::find(addresses_.begin(), end, address) != end;
}

void LocalAddresses::refresh(std::int64_t now_us) {
  refreshed_ = true;
  refreshed_us_ = now_us;
  num_addresses_ = 0;
  std::array<ifreq, kMaxAddresses> interfaces{};
  ifconf list{};
  list.ifc_len = static_cast<int>(sizeof interfaces);
  list.ifc_req = interfaces.data();
  const int fd = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return;
  const int listed = ::ioctl(fd, SIOCGIFCONF, &list);
  ::close(fd);
  if (listed != 0) return;
  const std::size_t count = static_cast<std::size_t>(list.ifc_len) / sizeof(ifreq);
  for (std::size_t i = 0; i < count; ++i) {
    sockaddr_in address{};
    std::memcpy(&address, &interfaces[i].ifr_addr, sizeof address);
    addresses_[num_addresses_++] = ntohl(address.sin_addr.s_addr);
  }
}

}  // namespace plumb
