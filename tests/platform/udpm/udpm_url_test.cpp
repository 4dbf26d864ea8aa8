#include "platform/udpm/udpm_url.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

std::string error_of(const std::string& url) {
  try {
    (void)parse_udpm_url(url);
  } catch (const UdpmError& error) {
    return error.what();
  }
  return "";
}

TEST(UdpmUrl, HasLcmsDefaults) {
  const UdpmUrl url = parse_udpm_url("udpm://");
  EXPECT_EQ(0xEFFF4C43U, url.group) << "239.255.76.67";
  EXPECT_EQ(7667, url.port);
  EXPECT_EQ(0, url.ttl);
  EXPECT_EQ(0, url.receive_buffer_bytes);
  EXPECT_TRUE(url.sources.empty());
}

TEST(UdpmUrl, ReadsEveryPart) {
  const UdpmUrl url = parse_udpm_url(
      "udpm://224.1.2.3:9000?ttl=1&recv_buf_size=4194304&source=10.0.0.2&source=10.0.0.3");
  EXPECT_EQ(0xE0010203U, url.group);
  EXPECT_EQ(9000, url.port);
  EXPECT_EQ(1, url.ttl);
  EXPECT_EQ(4'194'304, url.receive_buffer_bytes);
  EXPECT_EQ((std::vector<std::uint32_t>{0x0A000002, 0x0A000003}), url.sources);
}

TEST(UdpmUrl, TakesPartsAlone) {
  EXPECT_EQ(9001, parse_udpm_url("udpm://:9001").port);
  EXPECT_EQ(0xEF000001U, parse_udpm_url("udpm://239.0.0.1?").group);
  EXPECT_EQ(255, parse_udpm_url("udpm://?ttl=255&").ttl);
}

TEST(UdpmUrl, RefusesWhatItCannotUseAndSaysWhy) {
  const auto expect = [](const std::string& url, const std::string& why) {
    EXPECT_NE(std::string::npos, error_of(url).find(why)) << url << ": " << error_of(url);
    EXPECT_NE(std::string::npos, error_of(url).find(url));
  };
  expect("tcpq://10.0.0.1", "does not begin with udpm://");
  expect("file://log", "does not begin with udpm://");
  expect("", "does not begin with udpm://");
  expect("udpm://10.0.0.1", "10.0.0.1 is not a multicast address");
  expect("udpm://240.0.0.1", "240.0.0.1 is not a multicast address");
  expect("udpm://224.0.0.251", "224.0.0.251 is reserved for network protocols");
  expect("udpm://host:7667", "\"host\" is not an IPv4 address");
  expect("udpm://239.0.0.1:", "port \"\"");
  expect("udpm://239.0.0.1:0", "port \"0\"");
  expect("udpm://239.0.0.1:65536", "port \"65536\" is no number from 1 to 65535");
  expect("udpm://239.0.0.1:76x", "port \"76x\"");
  expect("udpm://?ttl=256", "ttl \"256\" is no number from 0 to 255");
  expect("udpm://?ttl=-1", "ttl \"-1\"");
  expect("udpm://?ttl", "ttl \"\"");
  expect("udpm://?recv_buf_size=0", "recv_buf_size \"0\"");
  expect("udpm://?recv_buf_size=2147483648", "recv_buf_size \"2147483648\"");
  expect("udpm://?source=lan", "\"lan\" is not an IPv4 address");
  expect("udpm://?transmit_only=1", "\"transmit_only\" is none of ttl, recv_buf_size, source");
}

}  // namespace
}  // namespace plumb
