/// Tests the parts of a recording, its limits on the disk, and the ring between the two threads.
#include "tools/run/record/recording.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>

#include "core/channels.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/record/message_ring.hpp"
#include "tools/run/record/recorder.hpp"

namespace plumb {
namespace {

std::vector<std::string> channels_of(const std::filesystem::path& path) {
  LogReader reader(path.string());
  std::vector<std::string> channels;
  for (LogEvent event; reader.next(&event);) channels.emplace_back(event.channel);
  EXPECT_EQ(reader.num_problems(), 0) << path;
  return channels;
}

const std::vector<std::uint8_t> kBytes(1000, 7);

TEST(Recording, PartsBeginWithTheCalibrationAndLoseNothing) {
  const test::TempFolder folder;
  Recording recording(folder / "drive.lcm", {.split_us = 1'000'000});
  const char* calibration = kCameraCalibration.name;
  EXPECT_EQ(recording.write(0, calibration, kBytes), nullptr);
  for (int i = 0; i < 25; ++i) EXPECT_EQ(recording.write(100'000 * i, "CAMERA", kBytes), nullptr);
  recording.close();
  EXPECT_EQ(recording.num_parts(), 3);
  EXPECT_EQ(recording.num_messages(), 26);
  const std::size_t sizes[] = {11, 11, 6};
  for (int part = 0; part < 3; ++part) {
    const auto channels = channels_of(folder / ("drive_000" + std::to_string(part) + ".lcm"));
    ASSERT_EQ(channels.size(), sizes[part]);
    EXPECT_EQ(channels[0], calibration);
    EXPECT_EQ(std::count(channels.begin(), channels.end(), "CAMERA"),
              static_cast<std::ptrdiff_t>(channels.size()) - 1);
  }
}

TEST(Recording, DeletesTheOldestPartsAtTheLimit) {
  const test::TempFolder folder;
  Recording recording(folder / "ring.lcm", {.split_bytes = 5'000, .keep_bytes = 20'000});
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(recording.write(i, "CAMERA", kBytes), nullptr);
    std::uintmax_t on_disk = 0;
    recording.flush();
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
      on_disk += entry.file_size();
    EXPECT_LE(on_disk, 20'000U);
  }
  recording.close();
  EXPECT_EQ(recording.num_parts(), 20);
  EXPECT_EQ(recording.num_deleted(), 17);
  EXPECT_FALSE(std::filesystem::exists(folder / "ring_0016.lcm"));
  EXPECT_EQ(channels_of(folder / "ring_0017.lcm").size(), 5U);
}

TEST(Recording, EndsAtTheLimitWithoutParts) {
  const test::TempFolder folder;
  Recording recording(folder / "one.lcm", {.keep_bytes = 5'000});
  int num_written = 1;
  while (recording.write(0, "CAMERA", kBytes) == nullptr && num_written < 100) ++num_written;
  recording.close();
  EXPECT_EQ(num_written, 5);
  EXPECT_EQ(channels_of(folder / "one.lcm").size(), 5U);
}

TEST(Recording, EndsWhenTheDiskIsNearlyFull) {
  const test::TempFolder folder;
  Recording recording(folder / "one.lcm", {.free_bytes = std::int64_t{1} << 60});
  const std::vector<std::uint8_t> large(9 << 20);
  EXPECT_STREQ(recording.write(0, "CAMERA", large), "the disk is nearly full");
}

TEST(ImageCount, CountsGapsButNotNewStarts) {
  ImageCount count;
  for (const std::int64_t seq : {5, 6, 9}) count.take(1, seq);
  EXPECT_EQ(count.num_lost(), 2);
  for (const std::int64_t seq : {0, 1}) count.take(2, seq);  // another session
  for (const std::int64_t seq : {0, 1}) count.take(2, seq);  // the same log once more
  EXPECT_EQ(count.num_lost(), 2);
  EXPECT_EQ(count.num_images(), 7);
}

TEST(MessageRing, HandsOnEveryByteInOrderWhileItWrapsAndFills) {
  MessageRing ring(10'000);
  constexpr int kNumMessages = 2'000;
  std::thread sender([&ring] {
    std::vector<std::uint8_t> bytes;
    for (int i = 0; i < kNumMessages; ++i) {
      bytes.resize(static_cast<std::size_t>(i * 37 % 4'000));
      std::iota(bytes.begin(), bytes.end(), static_cast<std::uint8_t>(i));
      EXPECT_TRUE(ring.push(i % 5, i, bytes));
    }
    ring.close();
  });
  MessageRing::Message message;
  int num_taken = 0;
  while (ring.pop(&message, 1'000) == MessageRing::Result::kMessage) {
    EXPECT_EQ(message.log_us, num_taken);
    EXPECT_EQ(message.channel, num_taken % 5);
    ASSERT_EQ(message.bytes.size(), static_cast<std::size_t>(num_taken * 37 % 4'000));
    for (std::size_t i = 0; i < message.bytes.size(); ++i)
      ASSERT_EQ(message.bytes[i],
                static_cast<std::uint8_t>(static_cast<std::size_t>(num_taken) + i));
    ++num_taken;
  }
  sender.join();
  EXPECT_EQ(num_taken, kNumMessages);
  EXPECT_GT(ring.peak_bytes(), 6'000U);
  EXPECT_LE(ring.peak_bytes(), ring.size_bytes());
}

TEST(MessageRing, ClosingFreesASenderThatWaits) {
  MessageRing ring(1'000);
  EXPECT_TRUE(ring.push(0, 0, std::vector<std::uint8_t>(900)));
  std::thread sender([&ring] { EXPECT_FALSE(ring.push(0, 1, std::vector<std::uint8_t>(900))); });
  ring.close();
  sender.join();
  MessageRing::Message message;
  EXPECT_EQ(ring.pop(&message, 0), MessageRing::Result::kMessage);
  EXPECT_EQ(ring.pop(&message, 0), MessageRing::Result::kClosed);
}

}  // namespace
}  // namespace plumb
