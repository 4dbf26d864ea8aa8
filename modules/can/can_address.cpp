#include "modules/can/can_address.hpp"

#include <algorithm>
#include <string>

#include "core/input_error.hpp"

namespace plumb {
namespace {

std::string key_of(std::size_t message, const char* setting) {
  return std::string("can.") + kMessageRows[message].key + "." + setting;
}

void check_node(const std::string& node) {
  constexpr std::size_t kMaxLength = 14;  // messages' names stay within the 32 characters of a DBC
  const auto is_letter = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
  };
  const bool is_name = !node.empty() && node.size() <= kMaxLength && is_letter(node[0]) &&
                       std::all_of(node.begin(), node.end(),
                                   [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
  if (!is_name) {
    throw InputError("can.node = \"" + node + "\" is not a name of a DBC: up to " +
                     std::to_string(kMaxLength) + " letters, digits and _, no digit first");
  }
}

/// The setting where there is one, else base and offset. Throws when it is above `largest`.
int number_of(std::size_t message, const char* setting, int own, int base, int offset,
              int largest) {
  const int number = own >= 0 ? own : base + offset;
  if (number <= largest) return number;
  throw InputError(key_of(message, setting) + ": " + std::to_string(number) + " is above " +
                   std::to_string(largest) +
                   (largest == CanConfig::kMaxStandardId ? "; see can.extended_ids" : ""));
}

void check_cycle(std::size_t message, int cycle_ms) {
  if (cycle_ms % CanConfig::kTickMs == 0) return;
  throw InputError(key_of(message, "cycle_ms") + " = " + std::to_string(cycle_ms) +
                   " is not a multiple of " + std::to_string(CanConfig::kTickMs));
}

void check_unique(const std::array<CanAddress, kNumMessages>& addresses) {
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (addresses[i].id == addresses[k].id) {
        throw InputError(key_of(k, "id") + " and " + key_of(i, "id") + " are both " +
                         std::to_string(addresses[i].id));
      }
      if (addresses[i].data_id == addresses[k].data_id) {
        throw InputError(key_of(k, "data_id") + " and " + key_of(i, "data_id") + " are both " +
                         std::to_string(addresses[i].data_id));
      }
    }
  }
}

}  // namespace

std::array<CanAddress, kNumMessages> can_addresses(const CanConfig& config) {
  check_node(config.node);
  std::array<CanAddress, kNumMessages> addresses;
  const int largest_id =
      config.extended_ids ? CanConfig::kMaxExtendedId : CanConfig::kMaxStandardId;
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    const MessageRow& row = kMessageRows[i];
    const CanMessageConfig& own = config.messages[i];
    check_cycle(i, own.cycle_ms);
    addresses[i] = {
        static_cast<std::uint32_t>(
            number_of(i, "id", own.id, config.base_id, row.id_offset, largest_id)),
        config.extended_ids,
        static_cast<std::uint16_t>(number_of(i, "data_id", own.data_id, config.base_data_id,
                                             row.data_id_offset, CanConfig::kMaxDataId)),
        own.cycle_ms};
  }
  check_unique(addresses);
  return addresses;
}

}  // namespace plumb
