// Tests which identifiers, data identifiers and cycles a configuration gives, and what is refused.
#include "modules/can/can_address.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/input_error.hpp"
#include "modules/can/can_load.hpp"
#include "tests/can/reading.hpp"

namespace plumb {
namespace {

constexpr std::size_t kMount = message_index("Mount");
constexpr std::size_t kStatus = message_index("Status");

std::string refusal(const CanConfig& config) {
  try {
    (void)can_addresses(config);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CanAddress, DefaultsAreThoseThatReceiversWereBuiltFor) {
  const auto addresses = can_addresses(CanConfig{});
  EXPECT_EQ(addresses[0].id, 0x3A0U);
  EXPECT_EQ(addresses[0].data_id, 0x3A01);
  EXPECT_EQ(addresses[0].cycle_ms, 10);
  EXPECT_FALSE(addresses[0].extended);
  EXPECT_EQ(addresses[kMount].id, 0x3A9U);
  EXPECT_EQ(addresses[kMount].data_id, 0x3A0E);
  EXPECT_EQ(addresses[message_index("ObjectState")].id, 0x3B3U);
  EXPECT_EQ(addresses[message_index("ObjectState")].data_id, 0x3A0D);
}

TEST(CanAddress, TwoCamerasOnOneBusShareNothing) {
  CanConfig second;
  second.base_id = 0x3C0;
  second.base_data_id = 0x3C00;
  std::set<std::uint32_t> ids;
  std::set<std::uint16_t> data_ids;
  for (const CanConfig& config : {CanConfig{}, second}) {
    for (const CanAddress& address : can_addresses(config)) {
      ids.insert(address.id);
      data_ids.insert(address.data_id);
    }
  }
  EXPECT_EQ(ids.size(), 2 * kNumMessages);
  EXPECT_EQ(data_ids.size(), 2 * kNumMessages);
}

TEST(CanAddress, AFrameOfTheOtherCameraIsNotTakenForOnesOwn) {
  CanConfig second;
  second.base_data_id = 0x3C00;  // somebody forgot to set base_id
  const Messages theirs = can_messages(second);
  for (std::size_t i = 0; i < kNumMessages; ++i) {
    const CanFrame frame = encode(theirs[i], MessageValues{}, {});
    MessageValues values;
    EXPECT_TRUE(decode(theirs[i], frame, &values));
    EXPECT_FALSE(decode(test::default_messages()[i], frame, &values)) << theirs[i].row->name;
  }
}

TEST(CanAddress, AMessagesOwnSettingsWin) {
  CanConfig config;
  config.messages[kStatus] = {0x123, 0x77, 500};
  const auto addresses = can_addresses(config);
  EXPECT_EQ(addresses[kStatus].id, 0x123U);
  EXPECT_EQ(addresses[kStatus].data_id, 0x77);
  EXPECT_EQ(addresses[kStatus].cycle_ms, 500);
  EXPECT_EQ(addresses[kMount].id, 0x3A9U);
}

TEST(CanAddress, ExtendedIdentifiersReachTheFrame) {
  CanConfig config;
  config.extended_ids = true;
  config.base_id = 0x18FF0000;
  const Messages messages = can_messages(config);
  const CanFrame frame = encode(messages[1], MessageValues{}, {});
  EXPECT_TRUE(frame.extended);
  EXPECT_EQ(frame.id, 0x18FF0001U);
  MessageValues values;
  EXPECT_TRUE(decode(messages[1], frame, &values));
}

TEST(CanAddress, RefusesWhatDoesNotFitWithOneSentence) {
  CanConfig config;
  config.messages[kStatus].id = 0x3A0;
  EXPECT_EQ(refusal(config), "can.ego_motion.id and can.status.id are both 928");
  config = CanConfig{};
  config.messages[kMount].data_id = 0x3A01;
  EXPECT_EQ(refusal(config), "can.ego_motion.data_id and can.mount.data_id are both 14849");
  config = CanConfig{};
  config.messages[kStatus].id = 0x800;
  EXPECT_EQ(refusal(config), "can.status.id: 2048 is above 2047; see can.extended_ids");
  config = CanConfig{};
  config.base_id = 0x7F0;  // room for the frame's messages, not for the objects'
  EXPECT_EQ(refusal(config), "can.object_list.id: 2048 is above 2047; see can.extended_ids");
  config = CanConfig{};
  config.base_data_id = 0xFFFE;
  EXPECT_EQ(refusal(config), "can.ego_motion_detail.data_id: 65536 is above 65535");
  config = CanConfig{};
  config.messages[kMount].cycle_ms = 1005;
  EXPECT_EQ(refusal(config), "can.mount.cycle_ms = 1005 is not a multiple of 10");
  for (const char* const name : {"", "2PLB", "P B", "FrontCameraLeft"}) {
    config = CanConfig{};
    config.node = name;
    EXPECT_EQ(refusal(config).rfind("can.node = \"", 0), 0U) << name;
  }
}

TEST(CanLoad, CountsBitsAsIso11898Does) {
  EXPECT_EQ(max_frame_bits(false), 135);
  EXPECT_EQ(max_frame_bits(true), 160);
}

TEST(CanLoad, CountsWhatLeavesInASecond) {
  const Messages& messages = test::default_messages();
  // 4 every 10 ms, 4 every 20 ms, 10 + 1 + 1 a second; odometry and age again for each camera
  // frame.
  EXPECT_NEAR(max_frames_per_s(messages, {10.0, 0.0, 0}), 612 + 1 + 40, 1e-9);
  EXPECT_NEAR(max_frames_per_s(messages, {10.0, 10.0, 8}), 612 + 1 + 40 + 10 + 240, 1e-9);
  EXPECT_NEAR(max_bus_load(messages, {10.0, 0.0, 0}, 500e3), 653 * 135 / 500e3, 1e-9);
}

}  // namespace
}  // namespace plumb
