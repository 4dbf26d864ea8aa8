#include "platform/udpm/udpm_url.hpp"

#include <arpa/inet.h>

#include <charconv>
#include <limits>
#include <string_view>

namespace plumb {
namespace {

constexpr std::string_view kScheme = "udpm://";

/// Parses one URL; its members share the text that errors quote.
class UrlParser {
 public:
  explicit UrlParser(const std::string& url) : url_(url) {}

  UdpmUrl parse() {
    std::string_view rest = url_;
    if (rest.substr(0, kScheme.size()) != kScheme) fail("it does not begin with udpm://");
    rest.remove_prefix(kScheme.size());
    const std::size_t question = rest.find('?');
    parse_network(rest.substr(0, question));
    if (question == std::string_view::npos) return parsed_;
    rest.remove_prefix(question + 1);
    while (!rest.empty()) {
      const std::size_t end = rest.find('&');
      parse_argument(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return parsed_;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw UdpmError("cannot use LCM network " + url_ + ": " + why);
  }

  void parse_network(std::string_view network) {
    const std::size_t colon = network.find(':');
    const std::string_view host = network.substr(0, colon);
    if (!host.empty()) parsed_.group = address(host);
    if (!IN_MULTICAST(parsed_.group)) fail(std::string(host) + " is not a multicast address");
    // Only there does the kernel take packets without a source from the network (LocalAddresses).
    if (parsed_.group >> 8U == INADDR_UNSPEC_GROUP >> 8U)
      fail(std::string(host) + " is reserved for network protocols");
    if (colon == std::string_view::npos) return;
    parsed_.port = static_cast<std::uint16_t>(number(network.substr(colon + 1), 1, 65'535, "port"));
  }

  void parse_argument(std::string_view argument) {
    const std::size_t equals = argument.find('=');
    const std::string key(argument.substr(0, equals));
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view() : argument.substr(equals + 1);
    if (key == "ttl") {
      parsed_.ttl = static_cast<std::uint8_t>(number(value, 0, 255, "ttl"));
    } else if (key == "recv_buf_size") {
      parsed_.receive_buffer_bytes =
          number(value, 1, std::numeric_limits<int>::max(), "recv_buf_size");
    } else if (key == "source") {
      parsed_.sources.push_back(address(value));
    } else {
      fail("\"" + key + "\" is none of ttl, recv_buf_size, source");
    }
  }

  std::uint32_t address(std::string_view text) const {
    in_addr parsed{};
    if (::inet_pton(AF_INET, std::string(text).c_str(), &parsed) != 1)
      fail("\"" + std::string(text) + "\" is not an IPv4 address");
    return ntohl(parsed.s_addr);
  }

  int number(std::string_view text, int low, int high, const char* what) const {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < low || value > high) {
      fail(std::string(what) + " \"" + std::string(text) + "\" is no number from " +
           std::to_string(low) + " to " + std::to_string(high));
    }
    return value;
  }

  const std::string& url_;
  UdpmUrl parsed_;
};

}  // namespace

UdpmUrl parse_udpm_url(const std::string& url) { return UrlParser(url).parse(); }

}  // namespace plumb
