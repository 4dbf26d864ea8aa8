// A fuzz target for the vehicle's speed: the text of a CAN database up to the first NUL, and behind
// it the frames, of which each has a size, a byte that says whether its identifier is the signal's,
// and data.
#include <cmath>

#include "core/input_error.hpp"
#include "modules/vehicle/dbc_signal_source.hpp"
#include "modules/vehicle/vehicle_node.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace plumb {
namespace {

using fuzz::require;

CanFrame next_frame(fuzz::Orders* orders, const DbcSignal& signal) {
  CanFrame frame;
  frame.size = orders->byte() % 65;
  const std::uint8_t address = orders->byte();
  frame.id = signal.id ^ (address & 1U);
  frame.extended = signal.extended != ((address & 2U) != 0);
  const fuzz::Bytes data = orders->bytes(frame.size);
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

void read_speeds(std::string_view text, fuzz::Orders orders) {
  static const fuzz::MemoryFile kFile;
  kFile.write(text);
  VehicleSpeedConfig config;
  config.dbc_file = kFile.path();
  config.signal = "Wheels.Speed";
  const DbcSignal signal = load_speed_signal(config);
  VehicleNode node(config, signal, 1);
  ego_motion_t ego{};
  ego.utime = 1'000'000;
  ego.capture_mono_us = 2'000'000;
  require(node.take_ego(ego) == nullptr);
  for (std::int64_t now_us = 2'000'000; !orders.is_empty(); now_us += 10'000) {
    const CanFrame frame = next_frame(&orders, signal);
    const vehicle_speed_t* message = node.take_frame(frame, now_us);
    if (message == nullptr) continue;
    require(frame.id == signal.id && frame.extended == signal.extended);
    require(std::isfinite(message->speed_m_s));
  }
}

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view all = plumb::fuzz::as_text({data, size});
  const std::size_t end = std::min(all.find('\0'), size);
  try {
    plumb::read_speeds(all.substr(0, end), plumb::fuzz::Orders({data + end, size - end}));
  } catch (const plumb::InputError&) {
  }
  return 0;
}
