/// Tests real KITTI drives from the images to the metric trajectory, causally and with one
/// configuration for all. The bounds are those that the project promises; README.md has what it
/// reaches.

#include <gtest/gtest.h>

#include "modules/chain/chain.hpp"
#include "platform/log_file.hpp"
#include "tests/support/kitti_data.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/evaluate/eval/kitti_metric.hpp"
#include "tools/run/kitti2lcm/convert.hpp"
#include "tools/run/replay/pose_track.hpp"

namespace plumb {
namespace {

std::vector<PoseMatrix> replay_poses(const std::filesystem::path& log, std::uint64_t seed) {
  std::string text;
  PoseTrack track;
  Chain replay(PlumbConfig{}, seed, nullptr, [&](const FrameRecord& record) {
    EXPECT_EQ(record.refused, nullptr);
    text += track.row(record.ego) + "\n";
  });
  LogReader reader(log.string());
  for (LogEvent event; reader.next(&event);) replay.take(event);
  const test::TempFolder folder;
  return read_poses(folder.write("poses.txt", text));
}

/// Converts, replays and compares one drive. Returns its segments, or none when it is not here.
std::vector<SegmentError> segments_of(const std::string& name, std::vector<double> lengths_m) {
  const auto folder = test::kitti_sequence(name);
  if (folder.empty()) return {};
  const test::TempFolder scratch;
  SequenceOptions sequence;
  sequence.folder = folder;
  convert(read_sequence(sequence), {scratch / "drive.lcm", false});
  const auto est = replay_poses(scratch / "drive.lcm", 1);
  const auto gt = read_poses(folder / "poses.txt");
  EXPECT_EQ(est.size(), gt.size());
  if (est.size() != gt.size()) return {};
  return segment_errors(gt, est, {std::move(lengths_m), 10});
}

TEST(RealDrives, TheLongDriveKeepsItsScaleAndHeading) {
  const auto segments = segments_of("raw/drive0039_024-400", {100, 200});
  if (segments.empty()) GTEST_SKIP() << test::kNoKitti;
  const MeanError error = summarize(segments, {100, 200}).all;
  RecordProperty("t_percent", std::to_string(error.t_percent));
  RecordProperty("r_deg_m", std::to_string(error.r_deg_m));
  EXPECT_LE(error.t_percent, 1.5);
  EXPECT_LE(error.r_deg_m, 0.003);
}

TEST(RealDrives, ShortDrivesAndTurnsStayWithinThreePercent) {
  std::vector<SegmentError> all;
  for (const char* name : {"odometry/sequences/04_000-050", "odometry/sequences/05_100-159",
                           "odometry/sequences/06_000-050", "odometry/sequences/07_000-159",
                           "raw/drive0009_000-050"}) {
    const auto segments = segments_of(name, {10, 20, 50});
    if (segments.empty()) GTEST_SKIP() << test::kNoKitti;
    const double t_percent = summarize(segments, {10, 20, 50}).all.t_percent;
    EXPECT_LE(t_percent, 6.0) << name << " failed";
    all.insert(all.end(), segments.begin(), segments.end());
  }
  const MeanError error = summarize(all, {10, 20, 50}).all;
  RecordProperty("t_percent", std::to_string(error.t_percent));
  EXPECT_LE(error.t_percent, 3.0);
}

}  // namespace
}  // namespace plumb
