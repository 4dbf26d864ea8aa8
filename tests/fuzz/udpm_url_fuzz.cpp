// A fuzz target for the URL of the network, which comes from an option or the environment.
#include "platform/udpm/udpm_url.hpp"
#include "tests/fuzz/fuzz_input.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using plumb::fuzz::require;
  try {
    const plumb::UdpmUrl url =
        plumb::parse_udpm_url(std::string(plumb::fuzz::as_text({data, size})));
    require(url.group >> 28U == 0xEU && url.port > 0 && url.receive_buffer_bytes >= 0);
  } catch (const plumb::UdpmError&) {
  }
  return 0;
}
