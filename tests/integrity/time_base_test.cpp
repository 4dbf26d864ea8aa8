#include "modules/integrity/time_base.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/integrity/stamp_stream.hpp"

namespace plumb {
namespace {

using test::judge_all;
using test::regular;
using Stream = std::vector<TimeStampedImage>;

int count(const std::vector<TimeVerdict>& verdicts, TimeReason reason) {
  return static_cast<int>(std::count_if(verdicts.begin(), verdicts.end(),
                                        [&](const TimeVerdict& v) { return v.reason == reason; }));
}

/// Expects that the last image is valid again.
void expect_recovered(const std::vector<TimeVerdict>& verdicts) {
  EXPECT_TRUE(verdicts.back().is_valid()) << describe(verdicts.back().reason);
}

/// Expects that every interval that is called valid is the true one between the two images.
void expect_true_intervals(const Stream& stream, const std::vector<TimeVerdict>& verdicts,
                           double interval_s, double tolerance_s) {
  for (std::size_t i = 0; i < stream.size(); ++i) {
    if (!verdicts[i].is_valid()) continue;
    const auto steps = static_cast<double>(stream[i].seq - verdicts[i].reference_seq);
    EXPECT_NEAR(verdicts[i].interval_s, steps * interval_s, tolerance_s) << "image " << i;
  }
}

TEST(TimeBase, IsValidWithTheThirdImage) {
  const auto verdicts = judge_all(regular(10, 0.1));
  EXPECT_EQ(verdicts[0].reason, TimeReason::kStarting);
  EXPECT_EQ(verdicts[1].reason, TimeReason::kStarting);
  EXPECT_TRUE(verdicts[2].is_valid());
  EXPECT_TRUE(verdicts[2].is_new_base);
  EXPECT_EQ(verdicts[2].reference_seq, 1);
  EXPECT_NEAR(verdicts[2].interval_s, 0.1, 1e-9);
  EXPECT_EQ(count(verdicts, TimeReason::kNone), 8);
  EXPECT_EQ(verdicts.back().reset_count, 0);
}

TEST(TimeBase, SaysHowFarJitterMayHaveMovedAnInterval) {
  Stream stream = regular(40, 0.1);
  stream[20].stamp_us += 3000;
  const auto verdicts = judge_all(stream);
  EXPECT_NEAR(verdicts[19].interval_std_s, 0.0, 1e-6);
  EXPECT_NEAR(verdicts[20].interval_std_s, 0.003, 1e-6);
  EXPECT_NEAR(verdicts[21].interval_std_s, 0.003, 5e-4);
  EXPECT_LT(verdicts[22].interval_std_s, 5e-4);
}

TEST(TimeBase, PassesJitterAtEveryRate) {
  for (const double hz : {5.0, 10.0, 25.0, 30.0, 60.0, 120.0}) {
    Stream stream = regular(400, 1.0 / hz);
    std::mt19937 random(7);
    // Uniform jitter of up to 3 ms; a frame of 120 Hz lasts 8.3 ms.
    std::uniform_int_distribution<int> jitter(-1500, 1500);
    for (auto& image : stream) image.stamp_us += jitter(random);
    const auto verdicts = judge_all(stream);
    EXPECT_GE(count(verdicts, TimeReason::kNone), 396) << hz;
    EXPECT_EQ(verdicts.back().reset_count, 0) << hz;
  }
}

TEST(TimeBase, PassesDroppedFramesAndCountsThem) {
  Stream stream = regular(60, 0.1);
  stream.erase(stream.begin() + 40, stream.begin() + 53);
  stream.erase(stream.begin() + 20);
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(verdicts[20].reason, TimeReason::kGap);
  EXPECT_EQ(verdicts[20].num_lost, 1);
  EXPECT_NEAR(verdicts[20].interval_s, 0.2, 1e-9);
  EXPECT_EQ(verdicts[39].num_lost, 13);
  EXPECT_EQ(count(verdicts, TimeReason::kNone) + count(verdicts, TimeReason::kGap), 44);
}

TEST(TimeBase, SwappedNeighboursAreOutOfOrder) {
  Stream stream = regular(30, 0.1);
  std::swap(stream[14], stream[15]);
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(verdicts[14].reason, TimeReason::kGap);
  EXPECT_EQ(verdicts[14].num_lost, 1);
  EXPECT_EQ(verdicts[15].reason, TimeReason::kOutOfOrder);
  EXPECT_EQ(verdicts[16].reason, TimeReason::kNone);
  EXPECT_EQ(verdicts.back().reset_count, 0);
  expect_true_intervals(stream, verdicts, 0.1, 1e-9);
}

TEST(TimeBase, EachMessageDeliveredTwiceChangesNothing) {
  Stream stream;
  for (const auto& image : regular(30, 0.1)) stream.insert(stream.end(), 2, image);
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(count(verdicts, TimeReason::kNone), 28);
  EXPECT_EQ(count(verdicts, TimeReason::kRepeated), 30);
}

/// One stamp alone is wrong, by any amount in either direction.
TEST(TimeBase, OneBadStampCostsThatImageAlone) {
  for (const double off_s : {3600.0, 0.2, 0.08, 0.03, -0.03, -0.08, -0.2, -3600.0, 1e9}) {
    Stream stream = regular(40, 0.1);
    stream[20].stamp_us += static_cast<std::int64_t>(off_s * 1e6);
    const auto verdicts = judge_all(stream);
    EXPECT_FALSE(verdicts[20].is_valid()) << off_s;
    EXPECT_TRUE(verdicts[20].is_next_picture()) << off_s;
    EXPECT_TRUE(verdicts[21].is_valid()) << off_s;
    EXPECT_EQ(verdicts[21].reference_seq, 19) << off_s;
    EXPECT_EQ(verdicts[21].num_lost, 0) << off_s;
    EXPECT_EQ(verdicts.back().reset_count, 0) << off_s;
    expect_true_intervals(stream, verdicts, 0.1, 1e-9);
  }
}

/// All stamps from one image on are moved. After three images there is a new base, and a reset.
TEST(TimeBase, AJumpOfTheClockMakesANewBase) {
  for (const double off_s : {3600.0, 0.5, 0.2, 0.05, -0.05, -0.08, -5.0, -3600.0}) {
    Stream stream = regular(40, 0.1);
    for (std::size_t i = 20; i < stream.size(); ++i)
      stream[i].stamp_us += static_cast<std::int64_t>(off_s * 1e6);
    const auto verdicts = judge_all(stream);
    EXPECT_FALSE(verdicts[20].is_valid()) << off_s;
    EXPECT_FALSE(verdicts[21].is_valid()) << off_s;
    EXPECT_TRUE(verdicts[22].is_new_base) << off_s;
    EXPECT_EQ(verdicts.back().reset_count, 1) << off_s;
    expect_true_intervals(stream, verdicts, 0.1, 1e-9);
    expect_recovered(verdicts);
  }
}

TEST(TimeBase, NamesJumpsByTheirDirection) {
  Stream stream = regular(40, 0.1);
  stream[20].stamp_us += 3'600'000'000;
  stream[30].stamp_us -= 3'600'000'000;
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(verdicts[20].reason, TimeReason::kJumpForward);
  EXPECT_EQ(verdicts[30].reason, TimeReason::kJumpBack);
}

TEST(TimeBase, FramesDroppedWithoutANumberAreDoubted) {
  Stream stream = regular(40, 0.1);
  for (std::size_t i = 20; i < stream.size(); ++i) stream[i].stamp_us += 100'000;
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(verdicts[20].reason, TimeReason::kIntervalDoubted);
  expect_recovered(verdicts);
}

TEST(TimeBase, AChangeOfTheRateIsNoReset) {
  for (const double to_hz : {10.0, 15.0, 60.0, 120.0}) {
    Stream stream = regular(30, 1.0 / 30.0);
    for (int i = 1; i < 30; ++i) {
      const auto last = stream[29];
      stream.push_back({last.stamp_us + static_cast<std::int64_t>(i * 1e6 / to_hz), last.seq + i});
    }
    const auto verdicts = judge_all(stream);
    EXPECT_FALSE(verdicts[30].is_valid()) << to_hz;
    for (std::size_t i = 32; i < verdicts.size(); ++i) EXPECT_TRUE(verdicts[i].is_valid()) << to_hz;
    EXPECT_EQ(verdicts.back().reset_count, 0) << to_hz;
  }
}

TEST(TimeBase, ASlowlyVaryingRatePasses) {
  Stream stream = regular(1, 0.1);
  double time_s = 10.0;
  for (int i = 1; i < 600; ++i) {
    time_s += 1.0 / (20.0 + 10.0 * std::sin(0.03 * i));  // exposure follows the light
    stream.push_back({static_cast<std::int64_t>(time_s * 1e6), i});
  }
  stream.erase(stream.begin());
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(count(verdicts, TimeReason::kNone), 597);
  EXPECT_EQ(verdicts.back().reset_count, 0);
}

/// The field for microseconds holds milliseconds, nanoseconds or seconds.
TEST(TimeBase, AWrongUnitIsNamed) {
  for (const double factor : {1e-3, 1e3}) {
    Stream from_start = regular(40, 0.1);
    for (auto& image : from_start)
      image.stamp_us = static_cast<std::int64_t>(static_cast<double>(image.stamp_us) * factor);
    auto verdicts = judge_all(from_start);
    EXPECT_EQ(count(verdicts, TimeReason::kWrongUnit), 39) << factor;

    Stream later = regular(40, 0.1);
    for (std::size_t i = 20; i < 30; ++i)
      later[i].stamp_us =
          static_cast<std::int64_t>(static_cast<double>(later[i].stamp_us) * factor);
    verdicts = judge_all(later);
    for (std::size_t i = 20; i < 30; ++i)
      EXPECT_EQ(verdicts[i].reason, TimeReason::kWrongUnit) << factor << " image " << i;
    EXPECT_TRUE(verdicts[30].is_valid()) << factor;
  }
}

TEST(TimeBase, SecondsInAFieldOfMicrosecondsStall) {
  Stream stream = regular(40, 0.1);
  for (auto& image : stream) image.stamp_us /= 1'000'000;
  for (const auto& verdict : judge_all(stream)) EXPECT_FALSE(verdict.is_valid());
}

TEST(TimeBase, NumbersThatBeginAnewMakeANewBase) {
  for (const std::int64_t by : {3, 15, 40, 100}) {
    Stream stream = regular(80, 0.1, 100);
    for (std::size_t i = 40; i < stream.size(); ++i) stream[i].seq -= by;
    const auto verdicts = judge_all(stream);
    EXPECT_EQ(verdicts[40].reason, TimeReason::kNumbersAnew) << by;
    EXPECT_TRUE(verdicts[42].is_new_base) << by;
    EXPECT_EQ(verdicts.back().reset_count, 1) << by;
    expect_recovered(verdicts);
  }
}

TEST(TimeBase, ARestartedSourceIsSeenByItsSession) {
  // The new process continues the old one's numbers and clock exactly.
  Stream stream = regular(40, 0.1);
  for (std::size_t i = 0; i < stream.size(); ++i) stream[i].session = i < 20 ? 111 : 222;
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(verdicts[20].reason, TimeReason::kSourceRestarted);
  EXPECT_TRUE(verdicts[22].is_new_base);
  EXPECT_EQ(verdicts.back().reset_count, 1);
}

TEST(TimeBase, ARestartWithClockAndNumbersAnew) {
  Stream stream = regular(40, 0.1, 500);
  for (const auto& image : regular(20, 0.1))
    stream.push_back({image.stamp_us - 9'990'000, image.seq});
  const auto verdicts = judge_all(stream);
  EXPECT_EQ(verdicts[40].reason, TimeReason::kSourceRestarted);
  EXPECT_TRUE(verdicts[42].is_new_base);
  EXPECT_EQ(verdicts.back().reset_count, 1);
}

TEST(TimeBase, ASecondPassOfTheSameLogIsNamedAndFollowed) {
  for (const int length : {150, 60, 10, 5}) {
    Stream stream;
    for (int pass = 0; pass < 4; ++pass)
      for (const auto& image : regular(length, 0.1)) stream.push_back(image);
    const auto verdicts = judge_all(stream);
    if (length > 20) {
      EXPECT_EQ(verdicts[static_cast<std::size_t>(length)].reason, TimeReason::kSecondPass);
      EXPECT_TRUE(verdicts[static_cast<std::size_t>(length) + 2].is_valid());
      EXPECT_EQ(verdicts.back().reset_count, 3);
      expect_recovered(verdicts);
    }
    // A loop shorter than six images is never long enough to be believed; a longer one is.
    const auto from = static_cast<std::size_t>(length);
    const bool ever = std::any_of(verdicts.begin() + static_cast<std::ptrdiff_t>(from),
                                  verdicts.end(), [](auto& v) { return v.is_valid(); });
    EXPECT_EQ(ever, length >= 6) << length;
  }
}

TEST(TimeBase, ASecondPublisherIsIgnoredAndNamed) {
  Stream stream;
  for (const auto& image : regular(100, 0.1)) {
    stream.push_back(image);
    if (image.seq >= 20) stream.push_back({image.stamp_us + 50'000, image.seq + 5000});
  }
  const auto verdicts = judge_all(stream);
  EXPECT_GE(count(verdicts, TimeReason::kSecondPublisher), 79);
  EXPECT_EQ(count(verdicts, TimeReason::kNone), 98);
  EXPECT_EQ(verdicts.back().reset_count, 0);
}

TEST(TimeBase, TwoPublishersFromTheStartLeaveOneBase) {
  for (const std::int64_t apart : {5000, 1, 0, -300}) {
    Stream stream;
    for (const auto& image : regular(60, 0.1)) {
      stream.push_back(image);
      stream.push_back({image.stamp_us + 41'000, image.seq + apart});
    }
    const auto verdicts = judge_all(stream);
    EXPECT_EQ(verdicts.back().reset_count, 0) << apart;
    EXPECT_GE(count(verdicts, TimeReason::kNone), 55) << apart;
    EXPECT_LE(count(verdicts, TimeReason::kNone), 60) << apart;
    for (const auto& v : verdicts) {
      if (v.is_valid()) {
        EXPECT_NEAR(v.interval_s, 0.1, 1e-9) << apart;
      }
    }
  }
}

TEST(TimeBase, TheSecondPublisherTakesOverWhenTheFirstIsGone) {
  Stream stream;
  for (const auto& image : regular(80, 0.1)) {
    if (image.seq < 40) stream.push_back(image);
    if (image.seq >= 20) stream.push_back({image.stamp_us + 50'000, image.seq + 5000});
  }
  const auto verdicts = judge_all(stream);
  expect_recovered(verdicts);
  EXPECT_EQ(verdicts.back().reset_count, 1);
}

TEST(TimeBase, StampsOrNumbersThatStandStillAreNeverValid) {
  Stream stalled = regular(40, 0.1);
  for (std::size_t i = 20; i < 30; ++i) stalled[i].stamp_us = stalled[19].stamp_us;
  auto verdicts = judge_all(stalled);
  EXPECT_EQ(count(verdicts, TimeReason::kStampStalled), 10);
  EXPECT_TRUE(verdicts[30].is_valid());

  Stream numberless = regular(40, 0.1);
  for (auto& image : numberless) image.seq = 5;
  verdicts = judge_all(numberless);
  EXPECT_EQ(count(verdicts, TimeReason::kNumberStalled), 39);
}

TEST(TimeBase, ExtremeNumbersAreNotFatal) {
  using Limits = std::numeric_limits<std::int64_t>;
  Stream stream = regular(10, 0.1);
  for (const std::int64_t stamp : {Limits::min(), Limits::max(), std::int64_t{0}})
    for (const std::int64_t seq : {Limits::min(), Limits::max(), std::int64_t{0}})
      stream.push_back({stamp, seq});
  for (const auto& image : regular(10, 0.1, 10))
    stream.push_back({image.stamp_us + 1'000'000, image.seq});
  const auto verdicts = judge_all(stream);
  for (std::size_t i = 10; i < 19; ++i) EXPECT_FALSE(verdicts[i].is_valid());
  expect_recovered(verdicts);
}

/// Whatever came before, the third of consecutive good images is valid and its interval is true.
TEST(TimeBase, ThreeGoodImagesAlwaysMakeABase) {
  std::mt19937_64 random(20);
  for (int round = 0; round < 3000; ++round) {
    TimeBase base({});
    const Stream garbage = test::garbage(random, static_cast<int>(random() % 40));
    for (const auto& image : garbage) (void)base.update(image);
    const double interval_s = 1.0 / (5.0 + static_cast<double>(random() % 116));
    // Good images have a stamp and a number that the garbage has not used.
    Stream good = regular(6, interval_s, static_cast<std::int64_t>(1'000'000 + random() % 1000));
    for (auto& image : good)
      image.stamp_us += 77'000'000'000 + static_cast<std::int64_t>(random() % 9);
    TimeVerdict verdict;
    for (std::size_t i = 0; i < good.size(); ++i) {
      verdict = base.update(good[i]);
      if (i < 2) continue;
      ASSERT_TRUE(verdict.is_valid())
          << "round " << round << " image " << i << ": " << describe(verdict.reason);
      const auto steps = static_cast<double>(good[i].seq - verdict.reference_seq);
      ASSERT_NEAR(verdict.interval_s, steps * interval_s, 0.3 * interval_s + 1e-6);
    }
  }
}

/// In a real stream with random faults, no interval that is called valid is wrong, and no count
/// goes back.
TEST(TimeBase, FaultsNeverMakeAWrongIntervalValid) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 500; ++round) {
    const double interval_s = round % 2 == 0 ? 0.1 : 0.0333;
    const Stream stream = test::with_faults(regular(300, interval_s), random);
    const auto verdicts = judge_all(stream);
    std::int32_t resets = 0;
    for (std::size_t i = 0; i < stream.size(); ++i) {
      ASSERT_GE(verdicts[i].reset_count, resets);
      resets = verdicts[i].reset_count;
      if (!verdicts[i].is_valid()) continue;
      const auto steps = static_cast<double>(stream[i].seq - verdicts[i].reference_seq);
      ASSERT_NEAR(verdicts[i].interval_s / (steps * interval_s), 1.0, 0.45) << round << " " << i;
    }
    expect_recovered(verdicts);
  }
}

TEST(TimeBase, IsDeterministic) {
  std::mt19937_64 random(9);
  const Stream stream = test::with_faults(regular(300, 0.1), random);
  const auto a = judge_all(stream);
  const auto b = judge_all(stream);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].reason, b[i].reason);
}

}  // namespace
}  // namespace plumb
