/// The IPv4 addresses of this machine.
///
/// The kernel drops packets that come from a network and bear one of this machine's addresses, a
/// loopback address or 0.0.0.0 as their source, so a packet with such a source was sent here.
/// Multicast that is routed to the loopback interface has the source 0.0.0.0.
///
/// Memory:
///   Fixed. The look-up is one ioctl into an array and does not allocate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plumb {

class LocalAddresses {
 public:
  static constexpr std::size_t kMaxAddresses = 64;
  /// [us] An unknown address makes us look again, at most this often.
  static constexpr std::int64_t kMinRefresh_us = 1'000'000;
  /// [us] What was looked up is believed for this long: addresses move to other machines.
  static constexpr std::int64_t kMaxAge_us = 60'000'000;

  /// `address` in host byte order. 127.0.0.0/8 and 0.0.0.0 are always local. Addresses beyond
  /// kMaxAddresses are not known.
  [[nodiscard]] bool contains(std::uint32_t address, std::int64_t now_us);

 private:
  [[nodiscard]] bool is_known(std::uint32_t address) const;
  void refresh(std::int64_t now_us);

  std::array<std::uint32_t, kMaxAddresses> addresses_{};
  std::size_t num_addresses_ = 0;
  bool refreshed_ = false;
  std::int64_t refreshed_us_ = 0;
};

}  // namespace plumb
