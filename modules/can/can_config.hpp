/// Every setting of plumb-can; visit() is the one list of keys, ranges and meanings.
///
/// Identifiers, E2E data identifiers and cycles belong to the bus that the camera sits on. For a
/// second camera on one bus it is enough to set can.node, can.base_id and can.base_data_id.
#pragma once

#include <string>

#include "modules/can/can_messages.hpp"

namespace plumb {

/// The settings of one message.
struct CanMessageConfig {
  int id = -1;       ///< -1: can.base_id and the message's offset
  int data_id = -1;  ///< -1: can.base_data_id and the message's offset
  int cycle_ms = 0;  ///< unused where the message has no cycle
};

struct CanConfig {
  double stale_s = 0.25;
  double pair_wait_s = 0.1;
  std::string node = "PLB";
  bool extended_ids = false;
  int base_id = 0x3A0;
  int base_data_id = 0x3A00;
  std::array<CanMessageConfig, kNumMessages> messages = default_messages();

  static constexpr std::array<CanMessageConfig, kNumMessages> default_messages() {
    std::array<CanMessageConfig, kNumMessages> all{};
    for (std::size_t i = 0; i < kNumMessages; ++i) all[i].cycle_ms = kMessageRows[i].cycle_ms;
    return all;
  }

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("can.stale_s", c.stale_s, 0.05, 5.0,
          "age of an image, since its capture, from which on its values are sent as not available");
    field("can.pair_wait_s", c.pair_wait_s, 0.01, 1.0,
          "wait for the other one of GROUND_PLANE and EGO_MOTION of the same frame");
    field("can.node", c.node, "name of the sender in the DBC, in front of the messages' names");
    field("can.extended_ids", c.extended_ids, "identifiers have 29 bits, not 11");
    field("can.base_id", c.base_id, 0, kMaxExtendedId, "first identifier (928 is 0x3A0)");
    field("can.base_data_id", c.base_data_id, 0, kMaxDataId,
          "E2E data identifiers are counted from here (14848 is 0x3A00)");
    for (std::size_t i = 0; i < kNumMessages; ++i) {
      visit_message(kMessageRows[i], c.messages[i], field);
    }
  }

  static constexpr int kMaxStandardId = 0x7FF;
  static constexpr int kMaxExtendedId = 0x1FFFFFFF;
  static constexpr int kMaxDataId = 0xFFFF;
  static constexpr int kTickMs = 10;
  static constexpr int kMaxCycleMs = 60'000;

 private:
  template <typename MessageConfig, typename Visit>
  static void visit_message(const MessageRow& row, MessageConfig& c, Visit&& field) {
    const std::string section = std::string("can.") + row.key;
    const auto default_of = [](const char* base, int offset) {
      return std::string("-1: can.") + base + " + " + std::to_string(offset);
    };
    field((section + ".id").c_str(), c.id, -1, kMaxExtendedId,
          default_of("base_id", row.id_offset).c_str());
    field((section + ".data_id").c_str(), c.data_id, -1, kMaxDataId,
          default_of("base_data_id", row.data_id_offset).c_str());
    if (row.cycle_ms == 0) return;
    field((section + ".cycle_ms").c_str(), c.cycle_ms, kTickMs, kMaxCycleMs,
          "sent at least this often; a multiple of 10");
  }
};

}  // namespace plumb
