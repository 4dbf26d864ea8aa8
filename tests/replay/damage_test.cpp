/// Tests logs with random damage. The replay may refuse what it reads, but it must not crash or
/// lose the rest.

#include <gtest/gtest.h>

#include <random>

#include "tests/replay/street_log.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

constexpr int kNumImages = 6;

std::string small_log(const test::TempFolder& folder) {
  CameraModel camera{96, 72, 80.0, 80.0, 48.0, 36.0, 0.0, 0.0, 1.65};
  std::vector<test::StoredEvent> events = {test::stored(test::kStreetStart_us, kCameraCalibration,
                                                        to_wire(camera, test::kStreetStart_us))};
  for (int i = 0; i < kNumImages; ++i) {
    const auto image =
        test::Scene(camera).render({Eigen::Matrix3d::Identity(), {0.0, 0.0, 0.8 * i}});
    events.push_back(test::image_event(i, image.view()));
  }
  test::write_log((folder / "sound.lcm").string(), events);
  return test::read_text(folder / "sound.lcm");
}

struct Tally {
  int num_frames = 0;
  int num_refused = 0;
  std::int64_t num_problems = 0;
};

Tally replay_file(const std::filesystem::path& path) {
  Tally tally;
  LogReader reader(path.string());
  Chain replay(PlumbConfig{}, 1, nullptr, [&](const FrameRecord&) { ++tally.num_frames; });
  for (LogEvent event; reader.next(&event);) replay.take(event);
  replay.finish();
  tally.num_refused = static_cast<int>(replay.num_refused());
  tally.num_problems = reader.num_problems();
  return tally;
}

TEST(Damage, ASoundLogHasNone) {
  const test::TempFolder folder;
  small_log(folder);
  const Tally tally = replay_file(folder / "sound.lcm");
  EXPECT_EQ(tally.num_frames, kNumImages);
  EXPECT_EQ(tally.num_refused, 0);
  EXPECT_EQ(tally.num_problems, 0);
}

TEST(Damage, OneBadByteInAHeaderCostsOneImageAtMost) {
  const test::TempFolder folder;
  const std::string sound = small_log(folder);
  std::mt19937 generator(17);
  std::size_t event = sound.find("\xED\xA1\xDA\x01", 1);  // the first image
  for (int i = 0; i < 150; ++i) {
    std::string bytes = sound;
    const std::size_t at = event + generator() % 80;  // log header, channel, image_t's fields
    bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1 + generator() % 255));
    const Tally tally = replay_file(folder.write("bad.lcm", bytes));
    EXPECT_GE(tally.num_frames, kNumImages - 1) << "byte " << at;
    EXPECT_LE(tally.num_frames, kNumImages) << "byte " << at;
  }
}

TEST(Damage, RandomBytesAnywhereNeverCrash) {
  const test::TempFolder folder;
  const std::string sound = small_log(folder);
  std::mt19937 generator(18);
  for (int i = 0; i < 100; ++i) {
    std::string bytes = sound;
    for (int k = 0; k < 20; ++k) bytes[generator() % bytes.size()] = static_cast<char>(generator());
    bytes.resize(bytes.size() - generator() % (bytes.size() / 2));
    EXPECT_LE(replay_file(folder.write("bad.lcm", bytes)).num_frames, kNumImages);
  }
}

}  // namespace
}  // namespace plumb
