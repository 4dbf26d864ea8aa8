// Checks that the receiver in docs/can.md works, and that the document's figures are those of the
// tables.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "modules/can/can_load.hpp"
#include "plumb_paths.hpp"
#include "tests/can/gate_fixture.hpp"
#include "tests/can/receiver.h"
#include "tests/can/sums.h"

extern "C" bool receiver_is_fresh(const Receiver* r, std::uint32_t now_ms);

namespace plumb {
namespace {

using test::default_messages;

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

Receiver make_receiver() { return {default_messages()[0].address.data_id, 50, 1, false, 0, 0}; }

CanFrame motion_frame(std::uint8_t alive, double speed_m_s) {
  MessageValues values;
  values.fill(kNotAvailable);
  const Message& message = default_messages()[0];
  for (std::size_t i = 0; i < message.signals.size(); ++i) {
    const std::string name = message.signals[i].name;
    if (name == "EgoMotion_Speed") values[i] = speed_m_s;
    if (name == "EgoMotion_Validity") values[i] = static_cast<double>(CanValidity::kValid);
  }
  return encode(message, values, {alive, 7, 0});
}

TEST(CanGuide, TheReceiverTakesWhatTheGateSends) {
  Receiver receiver = make_receiver();
  for (int i = 0; i < 40; ++i) {
    const CanFrame frame = motion_frame(static_cast<std::uint8_t>(i % 15), 0.5 * i);
    ASSERT_EQ(receive(&receiver, frame.data.data(), static_cast<std::uint32_t>(10 * i)), FRAME_OK);
    double speed_m_s = 0.0;
    ASSERT_TRUE(ego_speed(frame.data.data(), &speed_m_s));
    EXPECT_NEAR(speed_m_s, 0.5 * i, 0.0025);
    EXPECT_EQ(ego_validity(frame.data.data()), 2U);
  }
}

TEST(CanGuide, TheReceiverRefusesDamagedRepeatedAndMissingFrames) {
  Receiver receiver = make_receiver();
  CanFrame frame = motion_frame(3, 1.0);
  EXPECT_EQ(receive(&receiver, frame.data.data(), 0), FRAME_OK);
  EXPECT_EQ(receive(&receiver, frame.data.data(), 10), FRAME_REPEATED);
  EXPECT_EQ(receiver.received_ms, 0U);
  frame = motion_frame(4, 1.0);
  frame.data[5] ^= 1U;
  EXPECT_EQ(receive(&receiver, frame.data.data(), 20), FRAME_WRONG_CRC);
  frame = motion_frame(6, 1.0);
  EXPECT_EQ(receive(&receiver, frame.data.data(), 30), FRAMES_LOST);
  frame = motion_frame(7, 1.0);
  EXPECT_EQ(receive(&receiver, frame.data.data(), 40), FRAME_OK);
  Receiver other = make_receiver();
  ++other.data_id;
  EXPECT_EQ(receive(&other, frame.data.data(), 0), FRAME_WRONG_CRC);
}

TEST(CanGuide, TheReceiverTellsAgeAndAbsence) {
  Receiver receiver = make_receiver();
  EXPECT_FALSE(receiver_is_fresh(&receiver, 0));
  const CanFrame frame = motion_frame(0, kNotAvailable);
  EXPECT_EQ(receive(&receiver, frame.data.data(), 100), FRAME_OK);
  double speed_m_s = 0.0;
  EXPECT_FALSE(ego_speed(frame.data.data(), &speed_m_s));
  EXPECT_TRUE(receiver_is_fresh(&receiver, 150));
  EXPECT_FALSE(receiver_is_fresh(&receiver, 151));
}

TEST(CanGuide, TheReceiverReadsTheAgeOfTheFrame) {
  CanGate gate{CanConfig{}, default_messages()};
  test::RecordingSink sink;
  CanSample ego = test::sample_of(test::make_ego(1));
  ego.capture_mono_us = 1'000'000;
  gate.on_ego_motion(ego, 1'000'000);
  gate.on_ground_plane(test::sample_of(test::make_plane(1)), 1'000'000);
  gate.tick(1'123'000, sink);
  double age_s = 0.0;
  bool is_known = false;
  for (const test::Sent& s : sink.sent) {
    if (s.frame.id == test::message_named("Frame").address.id)
      is_known = frame_age(s.frame.data.data(), &age_s);
  }
  EXPECT_TRUE(is_known);
  EXPECT_NEAR(age_s, 0.123, 1e-9);
  const CanFrame unknown = [] {
    MessageValues values;
    values.fill(kNotAvailable);
    return encode(test::message_named("Frame"), values, {});
  }();
  EXPECT_FALSE(frame_age(unknown.data.data(), &age_s));
}

TEST(CanGuide, TheReceiverNoticesThatSumsBeganAnew) {
  Continuity continuity{false, 0, 0};
  EXPECT_FALSE(continues(&continuity, 3, 7));
  EXPECT_TRUE(continues(&continuity, 3, 7));
  EXPECT_FALSE(continues(&continuity, 4, 7));
  EXPECT_TRUE(continues(&continuity, 4, 7));
  EXPECT_FALSE(continues(&continuity, 4, 8));
}

TEST(CanGuide, TheReceiverTakesDifferencesAcrossTheTurn) {
  for (const double start_m : {0.0, 39'999.0, -40'001.0, 999'999.0, 2e6}) {
    const SignalLayout position = wrapping({24, 24, 0.005, -40'000.0}, 80'000.0);
    const double before_m = to_physical(position, to_raw(position, start_m));
    const double now_m = to_physical(position, to_raw(position, start_m + 2.5));
    EXPECT_NEAR(travelled(now_m, before_m, 80'000.0), 2.5, 0.0051) << start_m;
    EXPECT_NEAR(travelled(before_m, now_m, 80'000.0), -2.5, 0.0051) << start_m;
  }
}

class CanGuideText : public ::testing::Test {
 protected:
  const std::string text_ = text_of_file(PLUMB_SOURCE_DIR "/docs/can.md");

  [[nodiscard]] bool says(const std::string& what) const {
    return text_.find(what) != std::string::npos;
  }
};

TEST_F(CanGuideText, HasTheReceiverThatIsTestedHere) {
  const std::string code = text_of_file(PLUMB_SOURCE_DIR "/tests/can/receiver.h");
  ASSERT_FALSE(code.empty());
  EXPECT_TRUE(says(code)) << "copy tests/can/receiver.h into docs/can.md";
}

TEST_F(CanGuideText, ListsEveryMessageWithIdentifierAndCycle) {
  for (const Message& message : default_messages()) {
    char row[128];
    const int cycle_ms = message.address.cycle_ms;
    std::snprintf(row, sizeof row, "| 0x%X | `PLB_%s` | %s |", message.address.id,
                  message.row->name, cycle_ms > 0 ? std::to_string(cycle_ms).c_str() : "-");
    EXPECT_TRUE(says(row)) << row;
  }
}

TEST_F(CanGuideText, StatesTheLoadOfTheTable) {
  for (const CanTraffic& traffic :
       {CanTraffic{10.0, 0.0, 0}, CanTraffic{10.0, 10.0, 8}, CanTraffic{30.0, 30.0, 8}}) {
    char row[128];
    std::snprintf(row, sizeof row, "| %.0f | %zu | %.0f | %.0f %% |", traffic.camera_hz,
                  traffic.num_objects, max_frames_per_s(default_messages(), traffic),
                  100.0 * max_bus_load(default_messages(), traffic, 500e3));
    EXPECT_TRUE(says(row)) << row;
  }
}

}  // namespace
}  // namespace plumb
