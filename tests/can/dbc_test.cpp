// Receivers are built from config/plumbline.dbc. These tests compare the file with what the program
// prints and, through their own reader, with the tables of signals and the constants of the
// messages.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

#include "modules/can/can_dbc.hpp"
#include "modules/integrity/signal_guard.hpp"
#include "plumb/detection_t.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/object_t.hpp"
#include "plumb/vo_motion_t.hpp"
#include "plumb_paths.hpp"
#include "tests/can/dbc.hpp"
#include "tests/can/reading.hpp"

namespace plumb {
namespace {

using test::default_messages;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The names that a signal has in the DBC. A signal of an object has one for each index.
std::vector<std::string> dbc_names(const Signal& signal) {
  std::vector<std::string> names;
  const std::string name = signal.name;
  const std::size_t hash = name.find('#');
  if (hash == std::string::npos) return {name};
  for (int k = 0; k < 8; ++k) {
    names.push_back(name);
    names.back()[hash] = static_cast<char>('0' + k);
  }
  return names;
}

/// Whether two signals name their values alike. "Not available" depends on the number of bits.
bool agree(std::map<long, std::string> a, std::map<long, std::string> b) {
  a.erase(std::prev(a.end()));
  b.erase(std::prev(b.end()));
  return a == b;
}

class DbcFile : public ::testing::Test {
 protected:
  const std::string file_ = text_of(PLUMB_SOURCE_DIR "/config/plumbline.dbc");
  test::Dbc dbc_ = test::read_dbc(file_);

  /// Calls `check(row of the C++ table, row of the DBC)` for every signal.
  template <typename Check>
  void for_each_signal(Check check) {
    ASSERT_EQ(dbc_.messages.size(), kNumMessages);
    for (const Message& message : default_messages()) {
      for (const Signal& signal : message.signals) {
        for (const std::string& name : dbc_names(signal)) {
          SCOPED_TRACE(name);
          const test::DbcSignal* said = dbc_.messages[message.address.id].find(name);
          ASSERT_NE(said, nullptr);
          check(signal, *said);
        }
      }
    }
  }
  const std::map<long, std::string>& values(const char* message, const char* signal) {
    for (auto& [id, m] : dbc_.messages) {
      if (m.name == message) return m.find(signal)->values;
    }
    throw std::runtime_error(message);
  }
};

TEST_F(DbcFile, IsWhatPrintDbcPrints) {
  EXPECT_EQ(file_, render_dbc(CanConfig{}, default_messages()))
      << "renew it: plumb-can --print-dbc > config/plumbline.dbc";
}

TEST_F(DbcFile, HasTheMessagesOfTheTableAndNoOthers) {
  ASSERT_EQ(dbc_.messages.size(), kNumMessages);
  for (const Message& message : default_messages()) {
    const test::DbcMessage& said = dbc_.messages[message.address.id];
    EXPECT_EQ(said.name, std::string("PLB_") + message.row->name);
    EXPECT_EQ(said.bytes, static_cast<int>(kMessageBytes));
    std::size_t num_signals = 0;
    for (const Signal& signal : message.signals) num_signals += dbc_names(signal).size();
    EXPECT_EQ(said.signals.size(), num_signals);
    EXPECT_FALSE(said.comment.empty());
  }
}

TEST_F(DbcFile, AgreesOnEveryBitAndScale) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    EXPECT_EQ(said.start_bit, ours.layout.start_bit);
    EXPECT_EQ(said.length, ours.layout.length);
    EXPECT_EQ(said.is_intel, ours.layout.order == ByteOrder::kIntel);
    EXPECT_FALSE(said.is_signed);
    EXPECT_EQ(said.factor, ours.layout.factor);
    EXPECT_EQ(said.offset, ours.layout.offset);
    EXPECT_EQ(said.unit, ours.unit);
  });
}

TEST_F(DbcFile, AgreesOnEveryRange) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    EXPECT_NEAR(said.min, min_physical(ours.layout), 1e-9);
    EXPECT_NEAR(said.max, max_physical(ours.layout), 1e-9);
  });
}

TEST_F(DbcFile, MultiplexesObjectsByTheirIndex) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    const std::size_t hash = std::string(ours.name).find('#');
    const std::string index =
        hash == std::string::npos ? "" : std::string("m") + said.name.substr(hash, 1);
    EXPECT_EQ(said.multiplexing, is_framing(ours, Framing::kObjectIndex) ? "M" : index);
    EXPECT_EQ(said.comment.find('#'), std::string::npos) << said.comment;
  });
  EXPECT_EQ(dbc_.messages[0x3B2].find("Obj3_VelXStd")->comment,
            "Standard deviation of Obj3_VelX. All ones: not available.");
}

TEST_F(DbcFile, NamesNotAvailableForEverySignalThatHasIt) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    if (!ours.layout.has_sna || source_of(ours) == CanSource::kFraming) {
      EXPECT_EQ(said.values.size(), 0U);
      return;
    }
    const long all_ones = (1L << ours.layout.length) - 1;
    ASSERT_EQ(said.values.count(all_ones), 1U);
    EXPECT_EQ(said.values.at(all_ones), "SNA");
    EXPECT_EQ(said.attributes.at("GenSigStartValue"), std::to_string(all_ones));
    EXPECT_EQ(said.attributes.at("GenSigInactiveValue"), std::to_string(all_ones));
    EXPECT_NE(said.comment.find("All ones: not available"), std::string::npos)
        << "the comment says what all ones means";
  });
}

TEST_F(DbcFile, StatesCyclesSendTypesAndDataIds) {
  for (const Message& message : default_messages()) {
    auto& said = dbc_.messages[message.address.id].attributes;
    const int cycle_ms = message.address.cycle_ms;
    EXPECT_EQ(said["GenMsgCycleTime"], std::to_string(cycle_ms));
    EXPECT_EQ(said["GenMsgSendType"], cycle_ms == 0                               ? "2"
                                      : message.row->trigger != CanTrigger::kNone ? "1"
                                                                                  : "0");
    EXPECT_EQ(said["E2EDataID"], std::to_string(message.address.data_id));
    EXPECT_EQ(said["E2EProfile"], "PROFILE_11A");
    EXPECT_EQ(said["VFrameFormat"], "0");
  }
}

TEST_F(DbcFile, FollowsTheConfiguration) {
  CanConfig config;
  config.node = "REAR";
  config.extended_ids = true;
  config.base_id = 0x18FF0000;
  config.base_data_id = 0x100;
  config.stale_s = 0.35;
  config.messages[message_index("Status")].cycle_ms = 200;
  const std::string text = render_dbc(config, can_messages(config));
  EXPECT_NE(text.find("more than 0.35 s ago"), std::string::npos);
  test::Dbc dbc = test::read_dbc(text);
  ASSERT_EQ(dbc.messages.size(), kNumMessages);
  test::DbcMessage& status = dbc.messages[0x80000000U | 0x18FF0007U];
  EXPECT_EQ(status.name, "REAR_Status");
  EXPECT_EQ(status.attributes["GenMsgCycleTime"], "200");
  EXPECT_EQ(status.attributes["E2EDataID"], std::to_string(0x108));
  EXPECT_EQ(status.attributes["VFrameFormat"], "1");
}

TEST_F(DbcFile, IsWhatStrictParsersRead) {
  std::istringstream lines(file_);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(std::count(line.begin(), line.end(), '"') % 2, 0) << "text on one line: " << line;
  }
  for (const auto& [id, message] : dbc_.messages) {
    EXPECT_LE(message.name.size(), 32U) << message.name;
    for (const test::DbcSignal& signal : message.signals) EXPECT_LE(signal.name.size(), 32U);
  }
}

TEST_F(DbcFile, EverySignalSaysWhatItIs) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    EXPECT_GT(said.comment.size(), 20U);
    const std::string name = ours.name;
    const bool is_axis = said.unit == "rad/s" || said.unit == "m/s^2" || said.unit == "m/s" ||
                         name.find("Pitch") != std::string::npos ||
                         name.find("Roll") != std::string::npos ||
                         name.find("YawChange") != std::string::npos;
    if (is_axis && name.find("Std") == std::string::npos) {
      EXPECT_NE(said.comment.find("ISO 8855"), std::string::npos);
      EXPECT_NE(said.comment.find("positive"), std::string::npos);
    }
  });
}

TEST_F(DbcFile, CarriesTheVersionThatPlbInfoSends) {
  EXPECT_EQ(dbc_.version, std::to_string(kDatabaseVersion));
}

TEST_F(DbcFile, EnumerationsHaveTheNumbersOfTheMessages) {
  const auto& ego = values("PLB_EgoMotionDetail", "EgoDetail_Status");
  EXPECT_EQ(ego.at(ego_motion_t::STATUS_OK), "OK");
  EXPECT_EQ(ego.at(ego_motion_t::STATUS_INITIALIZING), "INITIALIZING");
  EXPECT_EQ(ego.at(ego_motion_t::STATUS_SCALE_HELD), "SCALE_HELD");
  EXPECT_EQ(ego.at(ego_motion_t::STATUS_STANDSTILL), "STANDSTILL");
  EXPECT_EQ(ego.at(ego_motion_t::STATUS_COASTING), "COASTING");
  EXPECT_EQ(ego.at(ego_motion_t::STATUS_LOST), "LOST");
  EXPECT_TRUE(agree(values("PLB_Status", "Status_EgoStatus"), ego));

  const auto& plane = values("PLB_GroundPlaneDetail", "GroundDetail_Status");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_OK), "OK");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_INITIALIZING), "INITIALIZING");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_HELD), "HELD");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_INVALID), "INVALID");
  EXPECT_TRUE(agree(values("PLB_Status", "Status_GroundStatus"), plane));
}

TEST_F(DbcFile, ObjectsHaveTheNumbersOfTheMessages) {
  const auto& object_class = values("PLB_ObjectState", "Obj0_Class");
  EXPECT_EQ(object_class.at(detection_t::CLASS_UNKNOWN), "UNKNOWN");
  EXPECT_EQ(object_class.at(detection_t::CLASS_CAR), "CAR");
  EXPECT_EQ(object_class.at(detection_t::CLASS_VAN), "VAN");
  EXPECT_EQ(object_class.at(detection_t::CLASS_TRUCK), "TRUCK");
  EXPECT_EQ(object_class.at(detection_t::CLASS_BUS), "BUS");
  EXPECT_EQ(object_class.at(detection_t::CLASS_PEDESTRIAN), "PEDESTRIAN");
  EXPECT_EQ(object_class.at(detection_t::CLASS_CYCLIST), "CYCLIST");
  const auto& status = values("PLB_ObjectState", "Obj7_Status");
  EXPECT_EQ(status.at(object_t::STATUS_MEASURED), "MEASURED");
  EXPECT_EQ(status.at(object_t::STATUS_PREDICTED), "PREDICTED");
  EXPECT_EQ(status.at(object_t::STATUS_NOT_LOCALISED), "NOT_LOCALISED");
}

TEST_F(DbcFile, TheMountHasTheNumbersOfTheMessage) {
  const auto& status = values("PLB_Mount", "Mount_Status");
  EXPECT_EQ(status.at(mount_t::STATUS_COLLECTING), "COLLECTING");
  EXPECT_EQ(status.at(mount_t::STATUS_UNSTEADY), "UNSTEADY");
  EXPECT_EQ(status.at(mount_t::STATUS_STEADY), "STEADY");
  EXPECT_EQ(status.at(mount_t::STATUS_MOVED), "MOVED");
  EXPECT_EQ(status.at(mount_t::STATUS_MISALIGNED), "MISALIGNED");
  const auto& reason = values("PLB_Mount", "Mount_Reason");
  EXPECT_EQ(reason.at(mount_t::REASON_NONE), "NONE");
  EXPECT_EQ(reason.at(mount_t::REASON_NO_MOTION), "NO_MOTION");
  EXPECT_EQ(reason.at(mount_t::REASON_NO_PLANE), "NO_PLANE");
  EXPECT_EQ(reason.at(mount_t::REASON_SLOW), "SLOW");
  EXPECT_EQ(reason.at(mount_t::REASON_TURNING), "TURNING");
  EXPECT_EQ(reason.at(mount_t::REASON_UPSIDE_DOWN), "UPSIDE_DOWN");
}

TEST_F(DbcFile, ReasonsHaveTheNumbersOfTheMessages) {
  const auto& ego = values("PLB_Status", "Status_EgoReason");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_NONE), "NONE");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_FIRST_FRAME), "FIRST_FRAME");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_LOW_PARALLAX), "LOW_PARALLAX");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_TOO_FEW_FEATURES), "TOO_FEW_FEATURES");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_TOO_FEW_INLIERS), "TOO_FEW_INLIERS");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_IMAGE_DARK), "IMAGE_DARK");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_IMAGE_FLAT), "IMAGE_FLAT");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_IMAGE_FROZEN), "IMAGE_FROZEN");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_FRAMES_MISSING), "FRAMES_MISSING");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_TIME_BACKWARDS), "TIME_BACKWARDS");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_NO_CALIBRATION), "NO_CALIBRATION");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_RESTARTED), "RESTARTED");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_IMAGE_UNPROVEN), "IMAGE_UNPROVEN");
  EXPECT_EQ(ego.at(vo_motion_t::REASON_IMPLAUSIBLE), "IMPLAUSIBLE");

  const auto& plane = values("PLB_Status", "Status_GroundReason");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_NONE), "NONE");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_VO_NOT_READY), "VO_NOT_READY");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_STANDSTILL), "STANDSTILL");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_LOW_BASELINE), "LOW_BASELINE");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_NO_CUE), "NO_CUE");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_CUES_REJECTED), "CUES_REJECTED");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_IMAGE_MISSING), "IMAGE_MISSING");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_VO_LOST), "VO_LOST");
  EXPECT_EQ(plane.at(ground_plane_t::REASON_NO_CALIBRATION), "NO_CALIBRATION");
  EXPECT_TRUE(agree(values("PLB_GroundPlaneDetail", "GroundDetail_Reason"), plane));
}

TEST_F(DbcFile, ModesAndValiditiesHaveTheNumbersOfTheGate) {
  const auto& mode = values("PLB_Status", "Status_Mode");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kNoInput)), "NO_INPUT");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kInitializing)), "INITIALIZING");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kNormal)), "NORMAL");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kDegraded)), "DEGRADED");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kFailed)), "FAILED");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kTooOld)), "TOO_OLD");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kAgeUnknown)), "AGE_UNKNOWN");

  const auto& validity = values("PLB_EgoMotion", "EgoMotion_Validity");
  EXPECT_EQ(validity.at(static_cast<long>(CanValidity::kInvalid)), "INVALID");
  EXPECT_EQ(validity.at(static_cast<long>(CanValidity::kDegraded)), "DEGRADED");
  EXPECT_EQ(validity.at(static_cast<long>(CanValidity::kValid)), "VALID");
  EXPECT_EQ(values("PLB_GroundPlane", "GroundPlane_Validity"), validity);

  const auto& doubt = values("PLB_Frame", "Frame_SpeedDoubt");
  const auto name = [&doubt](PlausibilityReason reason) {
    return doubt.at(static_cast<long>(reason));
  };
  EXPECT_EQ(name(PlausibilityReason::kNone), "NONE");
  EXPECT_EQ(name(PlausibilityReason::kNotMeasured), "NOT_MEASURED");
  EXPECT_EQ(name(PlausibilityReason::kOutOfRange), "OUT_OF_RANGE");
  EXPECT_EQ(name(PlausibilityReason::kTooFast), "TOO_FAST");
  EXPECT_EQ(name(PlausibilityReason::kRecovering), "RECOVERING");
  EXPECT_EQ(name(PlausibilityReason::kInterval), "INTERVAL");
  EXPECT_EQ(name(PlausibilityReason::kInconsistent), "INCONSISTENT");
  EXPECT_EQ(name(PlausibilityReason::kDependent), "DEPENDENT");
}

}  // namespace
}  // namespace plumb
