// A fuzz target for the configuration of all processes. What is accepted must be written and read
// back without a change, and must make CAN messages or be refused.
#include "core/input_error.hpp"
#include "modules/can/signals/signal_tables.hpp"
#include "modules/chain/plumb_config.hpp"
#include "platform/config.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace plumb {
namespace {

void load_and_write_back(fuzz::Bytes bytes) {
  static const fuzz::MemoryFile kFile;
  kFile.write(bytes);
  PlumbConfig config;
  try {
    load_config(kFile.path(), &config);
  } catch (const ConfigError&) {
    return;
  }
  const std::string text = render_config(config);
  kFile.write(text);
  PlumbConfig again;
  load_config(kFile.path(), &again);
  fuzz::require(render_config(again) == text);
  try {
    (void)can_messages(config.can);
  } catch (const InputError&) {
  }
}

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumb::load_and_write_back({data, size});
  return 0;
}
