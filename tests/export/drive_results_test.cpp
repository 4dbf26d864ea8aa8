/// Tests that results read from a log are those that a replay gives.
#include "tools/run/export/drive_results.hpp"

#include <gtest/gtest.h>

#include "core/channels.hpp"
#include "modules/chain/chain.hpp"
#include "platform/log_file.hpp"
#include "plumb_paths.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

constexpr const char* kDrive = PLUMB_SOURCE_DIR "/tools/run/demo_drive/drive.lcm";
constexpr int kNumImages = 30;

/// Copies the first images of the drive with what the chain publishes about them, as a recording of
/// the live chain has it: results come after their image, and a health message without end.
class Recording {
 public:
  explicit Recording(const std::string& path)
      : log_(path),
        chain_(
            PlumbConfig{}, 1, nullptr, [this](const FrameRecord& record) { take(record); },
            [this](const objects_t& objects) { write(kObjects, objects); }) {
    LogReader reader(kDrive);
    LogEvent event;
    while (chain_.num_frames() < kNumImages && reader.next(&event)) {
      log_.write(event.log_us, event.channel, event.data);
      chain_.take(event);
    }
    log_.close();
  }

 private:
  void take(const FrameRecord& record) {
    if (record.vo != nullptr) write(kVoMotion, *record.vo);
    if (record.ego != nullptr) write(kEgoMotion, *record.ego);
    if (record.plane != nullptr) write(kGroundPlane, *record.plane);
    process_health_t health{};
    health.process = "vo";
    health.num_received = record.seq;
    write(kHealthVo, health);
  }
  template <typename Message>
  void write(const Channel& channel, const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
    log_.write(0, channel.name, bytes);
  }
  LogWriter log_;
  Chain chain_;
};

TEST(DriveResults, AreTheSameFromTheLogAndFromAReplay) {
  const test::TempFolder folder;
  const std::string path = (folder / "results.lcm").string();
  const Recording recording(path);
  const DriveResults read = read_drive({path, "", false, 1});
  const DriveResults replayed = read_drive({path, "", true, 1});
  EXPECT_FALSE(read.replayed);
  EXPECT_TRUE(replayed.replayed);
  ASSERT_EQ(read.frames.size(), static_cast<std::size_t>(kNumImages));
  ASSERT_EQ(replayed.frames.size(), read.frames.size());
  int num_objects = 0;
  for (std::size_t i = 0; i < read.frames.size(); ++i) {
    EXPECT_EQ(read.frames[i].csv_row, replayed.frames[i].csv_row);
    EXPECT_EQ(has_pose(read.frames[i]), has_pose(replayed.frames[i]));
    ASSERT_EQ(read.frames[i].objects.has_value(), replayed.frames[i].objects.has_value());
    if (read.frames[i].objects) num_objects += read.frames[i].objects->num_objects;
    ASSERT_EQ(read.frames[i].health.size(), 1U);
    EXPECT_EQ(read.frames[i].health[0].num_received, read.frames[i].seq);
  }
  EXPECT_GT(num_objects, 0);
  EXPECT_TRUE(read.problems.empty());
}

TEST(DriveResults, KeepWhatIsIntact) {
  const test::TempFolder folder;
  const std::string whole = (folder / "results.lcm").string();
  const Recording recording(whole);
  std::string bytes = test::read_text(whole);
  bytes.replace(bytes.size() / 2, 150000, 150000, 'x');  // more than one event
  const DriveResults damaged = read_drive({folder.write("damaged.lcm", bytes), "", false, 1});
  EXPECT_FALSE(damaged.problems.empty());
  EXPECT_GT(damaged.frames.size(), static_cast<std::size_t>(kNumImages / 2));
  for (const FrameResult& frame : damaged.frames) EXPECT_FALSE(frame.csv_row.empty());
}

}  // namespace
}  // namespace plumb
