#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "modules/vehicle/dbc_signal_source.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

// Rows as public databases have them: Motorola and Intel, signed, extended identifiers, a
// multiplexed signal.
constexpr const char* kText = R"(VERSION ""

BO_ 180 SPEED: 8 XXX
 SG_ ENCODER : 39|8@0+ (1,0) [0|255] "" XXX
 SG_ SPEED : 47|16@0+ (0.01,0) [0|250] "km/h" XXX

BO_ 2364540158 EEC_Speed: 8 Vector__XXX
 SG_ Speed : 8|16@1+ (0.00390625,0) [0|250.996] "km/h" Vector__XXX

BO_ 400 Motion: 8 ECU
 SG_ Kind M : 0|8@1+ (1,0) [0|3] "" ECU
 SG_ Fast m1 : 8|16@1+ (0.01,0) [0|300] "mph" ECU
 SG_ Forward : 24|12@1- (0.05,0.5) [-100|100] "m/s" ECU
 SG_ Wide : 60|8@1+ (1,0) [0|0] "m/s" ECU
 SG_ Gear : 40|4@1+ (1,0) [0|0] "gears" ECU
 SG_ Torn : 40|4@1+ (1,0) [0|
 SG_ Endless : 40|4@1+ (nan,0) [0|0] "m/s" ECU
 SG_ Huge : 40|4@1+ (1e308,0) [0|0] "m/s" ECU
)";

CanFrame frame_of(std::uint32_t id, std::initializer_list<int> bytes) {
  CanFrame frame;
  frame.id = id;
  for (const int byte : bytes) frame.data[frame.size++] = static_cast<std::uint8_t>(byte);
  return frame;
}

DbcSignal find(const std::string& name) { return find_dbc_signal(kText, name, "car.dbc"); }

TEST(DbcSignal, ReadsMotorolaBytes) {
  const DbcSignal signal = find("SPEED.SPEED");
  EXPECT_EQ(signal.id, 180U);
  EXPECT_EQ(signal.unit, "km/h");
  // Bytes 5 and 6, the most significant one first: 0x1234 = 4660.
  EXPECT_NEAR(*signal.value(frame_of(180, {0, 0, 0, 0, 0, 0x12, 0x34, 0})), 46.60, 1e-12);
}

TEST(DbcSignal, ReadsIntelBytesOfAnExtendedIdentifier) {
  const DbcSignal signal = find("EEC_Speed.Speed");
  CanFrame frame = frame_of(0xCF004FE & 0x1FFFFFFF, {0, 0x00, 0x50, 0, 0, 0, 0, 0});
  frame.id = signal.id;
  EXPECT_EQ(signal.id, 2364540158U & 0x7FFFFFFFU);
  EXPECT_FALSE(signal.value(frame)) << "a standard frame of the same number is another one";
  frame.extended = true;
  EXPECT_NEAR(*signal.value(frame), 80.0, 1e-9);
}

TEST(DbcSignal, ReadsSignedNumbersWithAnOffset) {
  const DbcSignal signal = find("Motion.Forward");
  // -20 in twelve bits is 0xFEC, from bit 24 on.
  EXPECT_NEAR(*signal.value(frame_of(400, {0, 0, 0, 0xEC, 0x0F, 0, 0, 0})), -0.5, 1e-12);
}

TEST(DbcSignal, GivesNothingForWhatTheVehicleDoesNotKnow) {
  const DbcSignal signal = find("SPEED.SPEED");
  EXPECT_FALSE(signal.value(frame_of(180, {0, 0, 0, 0, 0, 0xFF, 0xFF, 0}))) << "655 km/h";
  EXPECT_FALSE(signal.value(frame_of(180, {0, 0, 0, 0, 0, 0x12}))) << "a short frame";
  EXPECT_FALSE(signal.value(frame_of(181, {0, 0, 0, 0, 0, 0x12, 0x34, 0}))) << "another frame";
  const DbcSignal huge = find("Motion.Huge");
  EXPECT_EQ(*huge.value(frame_of(400, {0, 0, 0, 0, 0, 1})), 1e308);
  EXPECT_FALSE(huge.value(frame_of(400, {0, 0, 0, 0, 0, 2}))) << "beyond all numbers";
}

TEST(DbcSignal, NamesWhatIsWrong) {
  const auto error = [](const std::string& name) {
    return test::input_error_of([&] { (void)find(name); });
  };
  EXPECT_EQ(error("SPEED"), "vehicle_speed.signal \"SPEED\" is not Message.Signal");
  EXPECT_EQ(error("SPED.SPEED"), "car.dbc: no message SPED");
  EXPECT_EQ(error("SPEED.SPED"), "car.dbc: the message SPEED has no signal SPED");
  EXPECT_EQ(error("Motion.Fast"),
            "car.dbc:12: the signal Fast is multiplexed; name one that always holds");
  EXPECT_EQ(error("Motion.Torn"), "car.dbc:16: the row of the signal Torn cannot be read");
  EXPECT_EQ(error("Motion.Endless"), "car.dbc:17: the row of the signal Endless cannot be read");
}

TEST(SpeedSignal, IsInMetresPerSecond) {
  const test::TempFolder folder;
  const std::string path = (folder.path() / "car.dbc").string();
  std::ofstream(path) << kText;
  VehicleSpeedConfig config;
  config.dbc_file = path;
  config.signal = "SPEED.SPEED";
  const DbcSignal signal = load_speed_signal(config);
  EXPECT_NEAR(*signal.value(frame_of(180, {0, 0, 0, 0, 0, 0x0E, 0x10, 0})), 10.0, 1e-12)
      << "3600 hundredths of km/h";
  EXPECT_NEAR(signal.max, 250.0 / 3.6, 1e-12);
  config.signal = "Motion.Gear";
  EXPECT_EQ(
      test::input_error_of([&] { (void)load_speed_signal(config); }),
      path + ": the signal Motion.Gear has the unit \"gears\", which is not m/s, km/h or mph");
  config.dbc_file = (folder.path() / "none.dbc").string();
  EXPECT_EQ(test::input_error_of([&] { (void)load_speed_signal(config); }),
            "cannot read " + config.dbc_file);
}

}  // namespace
}  // namespace plumb
