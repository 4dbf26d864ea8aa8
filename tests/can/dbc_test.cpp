// config/plumbline.dbc is what a receiver is built from: its statements are held against the code.
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "modules/can/can_codec.hpp"
#include "modules/can/can_gate.hpp"
#include "plumb/detection_t.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/object_t.hpp"
#include "plumb/vo_motion_t.hpp"
#include "plumb_paths.hpp"
#include "tests/can/dbc.hpp"

namespace plumb {
namespace {

class DbcFile : public ::testing::Test {
 protected:
  /// Of both tables.
  static std::vector<Message> all_messages() {
    std::vector<Message> all(messages().begin(), messages().end());
    all.insert(all.end(), object_messages().begin(), object_messages().end());
    return all;
  }
  test::Dbc dbc_ = test::read_dbc(PLUMB_SOURCE_DIR "/config/plumbline.dbc");

  /// Calls `check(row of the C++ table, row of the DBC)` for every signal.
  template <typename Check>
  void for_each_signal(Check check) {
    ASSERT_EQ(dbc_.messages.size(), all_messages().size());
    for (const Message& message : all_messages()) {
      for (const Signal& signal : message.signals) {
        SCOPED_TRACE(signal.name);
        const test::DbcSignal* said = dbc_.messages[message.id].find(signal.name);
        ASSERT_NE(said, nullptr);
        check(signal, *said);
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

TEST_F(DbcFile, HasTheMessagesOfTheTableAndNoOthers) {
  ASSERT_EQ(dbc_.messages.size(), all_messages().size());
  for (const Message& message : all_messages()) {
    const test::DbcMessage& said = dbc_.messages[message.id];
    EXPECT_EQ(said.name, message.name);
    EXPECT_EQ(said.bytes, static_cast<int>(kMessageBytes));
    EXPECT_EQ(said.signals.size(), message.signals.size());
    EXPECT_FALSE(said.comment.empty());
  }
}

TEST_F(DbcFile, AgreesOnEveryBitAndScale) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    EXPECT_EQ(said.start_bit, ours.start_bit);
    EXPECT_EQ(said.length, ours.length);
    EXPECT_EQ(said.is_intel, ours.order == ByteOrder::kIntel);
    EXPECT_FALSE(said.is_signed);
    EXPECT_EQ(said.factor, ours.factor);
    EXPECT_EQ(said.offset, ours.offset);
  });
}

TEST_F(DbcFile, AgreesOnEveryRange) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    EXPECT_NEAR(said.min, min_physical(ours), 1e-9);
    EXPECT_NEAR(said.max, max_physical(ours), 1e-9);
  });
}

TEST_F(DbcFile, NamesNotAvailableForEverySignalThatHasIt) {
  for_each_signal([](const Signal& ours, const test::DbcSignal& said) {
    if (!ours.has_sna || ours.value == nullptr) {
      EXPECT_EQ(said.values.size(), 0U);
      return;
    }
    const long all_ones = (1L << ours.length) - 1;
    ASSERT_EQ(said.values.count(all_ones), 1U);
    EXPECT_EQ(said.values.at(all_ones), "SNA");
    EXPECT_EQ(said.attributes.at("GenSigStartValue"), std::to_string(all_ones));
    EXPECT_EQ(said.attributes.at("GenSigInactiveValue"), std::to_string(all_ones));
    EXPECT_NE(said.comment.find("ll ones: not available"), std::string::npos)
        << "the comment says what all ones means";
  });
}

TEST_F(DbcFile, StatesCyclesSendTypesAndDataIds) {
  std::set<std::string> data_ids;
  for (const Message& message : all_messages()) {
    auto& said = dbc_.messages[message.id].attributes;
    EXPECT_EQ(said["GenMsgCycleTime"], std::to_string(message.cycle_ms));
    EXPECT_EQ(said["GenMsgSendType"], message.cycle_ms == 0                  ? "2"
                                      : message.trigger != CanTrigger::kNone ? "1"
                                                                             : "0");
    EXPECT_EQ(said["E2EDataID"], std::to_string(message.data_id));
    EXPECT_EQ(said["E2EProfile"], "PROFILE_11A");
    EXPECT_EQ(said["VFrameFormat"], "0");
    EXPECT_EQ(message.cycle_ms % (CanGate::kTickUs / 1000), 0) << "a cycle is a number of ticks";
    data_ids.insert(said["E2EDataID"]);
  }
  EXPECT_EQ(data_ids.size(), all_messages().size());
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
  EXPECT_EQ(values("PLB_Status", "Status_EgoStatus"), ego);

  const auto& plane = values("PLB_GroundPlaneDetail", "GroundDetail_Status");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_OK), "OK");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_INITIALIZING), "INITIALIZING");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_HELD), "HELD");
  EXPECT_EQ(plane.at(ground_plane_t::STATUS_INVALID), "INVALID");
  EXPECT_EQ(values("PLB_Status", "Status_GroundStatus"), plane);
}

TEST_F(DbcFile, ObjectsHaveTheNumbersOfTheMessages) {
  const auto& object_class = values("PLB_ObjectState", "ObjState_Class");
  EXPECT_EQ(object_class.at(detection_t::CLASS_UNKNOWN), "UNKNOWN");
  EXPECT_EQ(object_class.at(detection_t::CLASS_CAR), "CAR");
  EXPECT_EQ(object_class.at(detection_t::CLASS_VAN), "VAN");
  EXPECT_EQ(object_class.at(detection_t::CLASS_TRUCK), "TRUCK");
  EXPECT_EQ(object_class.at(detection_t::CLASS_BUS), "BUS");
  EXPECT_EQ(object_class.at(detection_t::CLASS_PEDESTRIAN), "PEDESTRIAN");
  EXPECT_EQ(object_class.at(detection_t::CLASS_CYCLIST), "CYCLIST");
  const auto& status = values("PLB_ObjectState", "ObjState_Status");
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
  const auto& reason = values("PLB_Mount", "Mount_Reason");
  EXPECT_EQ(reason.at(mount_t::REASON_NONE), "NONE");
  EXPECT_EQ(reason.at(mount_t::REASON_NO_MOTION), "NO_MOTION");
  EXPECT_EQ(reason.at(mount_t::REASON_NO_PLANE), "NO_PLANE");
  EXPECT_EQ(reason.at(mount_t::REASON_SLOW), "SLOW");
  EXPECT_EQ(reason.at(mount_t::REASON_TURNING), "TURNING");
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
  EXPECT_EQ(values("PLB_GroundPlaneDetail", "GroundDetail_Reason"), plane);
}

TEST_F(DbcFile, ModesAndValiditiesHaveTheNumbersOfTheGate) {
  const auto& mode = values("PLB_Status", "Status_Mode");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kNoInput)), "NO_INPUT");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kInitializing)), "INITIALIZING");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kNormal)), "NORMAL");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kDegraded)), "DEGRADED");
  EXPECT_EQ(mode.at(static_cast<long>(CanMode::kFailed)), "FAILED");

  const auto& validity = values("PLB_EgoMotion", "EgoMotion_Validity");
  EXPECT_EQ(validity.at(static_cast<long>(CanValidity::kInvalid)), "INVALID");
  EXPECT_EQ(validity.at(static_cast<long>(CanValidity::kDegraded)), "DEGRADED");
  EXPECT_EQ(validity.at(static_cast<long>(CanValidity::kValid)), "VALID");
  EXPECT_EQ(values("PLB_GroundPlane", "GroundPlane_Validity"), validity);
}

}  // namespace
}  // namespace plumb
