// A fuzz target for the reader of LCM logs. No event may reach beyond the file, and each place of
// the file belongs to one event at most.
#include "platform/log_file.hpp"
#include "tests/fuzz/fuzz_input.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using plumb::fuzz::require;
  static const plumb::fuzz::MemoryFile kFile;
  kFile.write(plumb::fuzz::Bytes{data, size});
  constexpr std::size_t kHeader = 28;
  plumb::LogReader reader(kFile.path());
  plumb::LogEvent event;
  std::size_t num_bytes = 0;
  std::int64_t num_events = 0;
  unsigned sum = 0;
  while (reader.next(&event)) {
    require(!event.channel.empty() && event.channel.size() <= plumb::LogReader::kMaxChannelBytes);
    num_bytes += kHeader + event.channel.size() + event.data.size();
    for (const std::uint8_t byte : event.data) sum += byte;
    ++num_events;
  }
  require(num_bytes <= size && num_events == reader.num_events());
  require(num_bytes == size || reader.num_problems() > 0);
  require(sum <= 255U * size);
  return 0;
}
