// A fuzz target for the MCAP files of other tools, as plumb-convert reads them.
#include "core/input_error.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tools/run/convert/mcap_reader.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const plumb::fuzz::MemoryFile kFile;
  kFile.write(plumb::fuzz::Bytes{data, size});
  try {
    plumb::McapReader reader(kFile.path());
    plumb::McapMessage message;
    static volatile unsigned sum = 0;  // every byte has to be readable
    while (reader.next(&message)) {
      for (const std::uint8_t byte : message.data) sum = sum + byte;
      plumb::fuzz::require(reader.num_messages(message.channel) >= 0);
    }
  } catch (const plumb::InputError&) {
  }
  return 0;
}
