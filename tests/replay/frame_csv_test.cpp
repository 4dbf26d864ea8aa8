#include "tools/run/replay/frame_csv.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "modules/datasets/number_file.hpp"

namespace plumb {
namespace {

struct Messages {
  vo_motion_t vo{};
  ground_plane_t plane{};
  ego_motion_t ego{};
  [[nodiscard]] FrameRecord record() const {
    FrameRecord record;
    record.seq = 7;
    record.capture_us = 1'000'000;
    record.vo = &vo;
    record.plane = &plane;
    record.ego = &ego;
    return record;
  }
};

std::string cell(const FrameRecord& record, const std::string& name) {
  const std::string header = frame_csv_header(false);
  const std::string row = frame_csv_row(record, false);
  const auto names = split_cells(header);
  const auto cells = split_cells(row);
  EXPECT_EQ(names.size(), cells.size());
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return "no column " + name;
  return std::string(cells[static_cast<std::size_t>(found - names.begin())]);
}

TEST(FrameCsv, NamesEveryCellOnce) {
  const std::string header = frame_csv_header(true);
  auto names = split_cells(header);
  const Messages messages;
  FrameRecord record = messages.record();
  StageTimer timer;
  record.vo_timer = &timer;
  record.ground_timer = &timer;
  const std::string row = frame_csv_row(record, true);
  EXPECT_EQ(split_cells(row).size(), names.size());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(FrameCsv, WritesNumbersThatReadBackToTheSameBits) {
  Messages messages;
  messages.plane.height_m = 1.6499999999999999;
  messages.ego.velocity_ground_m_s[0] = 0.1 + 0.2;
  EXPECT_EQ(*parse_number(cell(messages.record(), "height_m")), messages.plane.height_m);
  EXPECT_EQ(cell(messages.record(), "speed_m_s"), "0.30000000000000004");
  EXPECT_EQ(cell(messages.record(), "seq"), "7");
}

TEST(FrameCsv, TurnsVariancesIntoDeviations) {
  Messages messages;
  messages.plane.height_m = 1.5;
  messages.plane.cov[0][0] = 4e-6;
  messages.plane.cov[2][2] = 1e-4;  // variance of ln height
  EXPECT_NEAR(*parse_number(cell(messages.record(), "pitch_std_rad")), 2e-3, 1e-12);
  EXPECT_NEAR(*parse_number(cell(messages.record(), "height_std_m")), 0.015, 1e-12);
}

TEST(FrameCsv, LeavesEmptyWhatDoesNotHold) {
  Messages messages;
  messages.plane.status = ground_plane_t::STATUS_INITIALIZING;
  messages.ego.status = ego_motion_t::STATUS_LOST;
  EXPECT_EQ(cell(messages.record(), "plane_status"), "initializing");
  EXPECT_EQ(cell(messages.record(), "height_m"), "");
  EXPECT_EQ(cell(messages.record(), "dense_height_vo"), "");
  EXPECT_EQ(cell(messages.record(), "ego_status"), "lost");
  EXPECT_EQ(cell(messages.record(), "speed_m_s"), "");
}

TEST(FrameCsv, AnImageThatWasRefusedHasItsReasonAndNothingElse) {
  FrameRecord record;
  record.seq = 3;
  record.refused = "JPEG is cut off";
  EXPECT_EQ(cell(record, "refused"), "JPEG is cut off");
  record.refused = "neither here, nor there";
  EXPECT_EQ(cell(record, "refused"), "neither here; nor there") << "a comma would begin a cell";
  for (const char* name : {"vo_status", "plane_status", "height_m", "ego_status", "x_m"}) {
    EXPECT_EQ(cell(record, name), "") << name;
  }
}

}  // namespace
}  // namespace plumb
