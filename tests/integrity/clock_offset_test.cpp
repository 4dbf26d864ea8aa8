#include "modules/integrity/clock_offset.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace plumb {
namespace {

constexpr std::int64_t kSecond = 1'000'000;
constexpr ClockEpoch kEpoch{42, 0};

/// A source whose clock is `offset` behind the local one and drifts; messages take 2 ms and more.
class ClockOffsetTest : public testing::Test {
 protected:
  std::int64_t stamp_at(double true_s) const {
    return static_cast<std::int64_t>((true_s * (1.0 + drift_) + source_ahead_s_) * 1e6);
  }
  void send(double true_s, double delay_s, const ClockEpoch& epoch = kEpoch) {
    clock_.update(stamp_at(true_s), local(true_s + delay_s), epoch);
  }
  static std::int64_t local(double true_s) { return static_cast<std::int64_t>(true_s * 1e6); }

  double drift_ = 0.0;
  double source_ahead_s_ = 1.7e9;
  ClockOffset clock_{ClockOffsetConfig{.min_messages = 5}};
};

TEST_F(ClockOffsetTest, IsUnknownBeforeFiveMessages) {
  for (int i = 0; i < 4; ++i) send(10.0 + 0.1 * i, 0.002);
  EXPECT_FALSE(clock_.is_known());
  EXPECT_FALSE(clock_.capture_us(stamp_at(10.3)).has_value());
  EXPECT_FALSE(clock_.age_us(stamp_at(10.3), local(10.4)).has_value());
  send(10.4, 0.002);
  EXPECT_TRUE(clock_.is_known());
}

TEST_F(ClockOffsetTest, AgeIsThatOfTheCaptureWhateverTheDelay) {
  std::mt19937 random(3);
  std::exponential_distribution<double> delay(1.0 / 0.03);
  for (int i = 0; i < 300; ++i) {
    const double t = 10.0 + 0.1 * i;
    send(t, 0.002 + delay(random));
    if (i < 100) continue;
    const auto age = clock_.age_us(stamp_at(t), local(t + 0.25));
    ASSERT_TRUE(age.has_value());
    EXPECT_NEAR(static_cast<double>(*age), 250e3, 4e3);
  }
}

TEST_F(ClockOffsetTest, LateMessagesNeverMakeContentYounger) {
  for (int i = 0; i < 50; ++i) send(10.0 + 0.1 * i, 0.002);
  // The reader stood still for 10 s and then reads what has queued up.
  for (int i = 50; i < 150; ++i) {
    const double t = 10.0 + 0.1 * i;
    send(t, 25.0 - t + 0.001 * i);
    const auto age = clock_.age_us(stamp_at(t), local(25.1));
    EXPECT_NEAR(static_cast<double>(*age), (25.1 - t) * 1e6, 3e3);
  }
}

TEST_F(ClockOffsetTest, FollowsADriftOf100PartsPerMillion) {
  for (const double drift : {100e-6, -100e-6}) {
    drift_ = drift;
    clock_ = ClockOffset(ClockOffsetConfig{.min_messages = 5});
    for (int i = 0; i < 6000; ++i) {
      const double t = 10.0 + 0.1 * i;
      send(t, 0.002);
      const auto age = clock_.age_us(stamp_at(t), local(t + 0.1));
      if (i >= 5) {
        EXPECT_NEAR(static_cast<double>(*age), 100e3, 9e3) << t;
      }
    }
  }
}

TEST_F(ClockOffsetTest, AClockThatJumpsForwardIsFollowedAtOnce) {
  for (int i = 0; i < 50; ++i) send(10.0 + 0.1 * i, 0.002);
  source_ahead_s_ += 3600.0;
  send(15.0, 0.002);
  EXPECT_NEAR(static_cast<double>(*clock_.age_us(stamp_at(15.0), local(15.05))), 50e3, 3e3);
}

TEST_F(ClockOffsetTest, AClockThatJumpsBackMakesContentOlderNeverYounger) {
  for (int i = 0; i < 50; ++i) send(10.0 + 0.1 * i, 0.002);
  source_ahead_s_ -= 2.0;
  for (int i = 50; i < 1000; ++i) {
    const double t = 10.0 + 0.1 * i;
    send(t, 0.002);
    EXPECT_GE(*clock_.age_us(stamp_at(t), local(t + 0.1)), 97'000);
  }
  EXPECT_NEAR(static_cast<double>(*clock_.age_us(stamp_at(109.9), local(110.0))), 100e3, 3e3);
}

TEST_F(ClockOffsetTest, ANewEpochBeginsAnew) {
  for (const ClockEpoch epoch : {ClockEpoch{42, 1}, ClockEpoch{43, 0}}) {
    clock_ = ClockOffset(ClockOffsetConfig{.min_messages = 5});
    source_ahead_s_ = 1.7e9;
    for (int i = 0; i < 50; ++i) send(10.0 + 0.1 * i, 0.002);
    source_ahead_s_ -= 2.0;
    for (int i = 50; i < 55; ++i) {
      EXPECT_EQ(clock_.is_known(), i == 50) << i;
      send(10.0 + 0.1 * i, 0.002, epoch);
    }
    EXPECT_NEAR(static_cast<double>(*clock_.age_us(stamp_at(15.4), local(15.5))), 100e3, 3e3);
  }
}

TEST_F(ClockOffsetTest, CaptureIsNeverLaterThanReceipt) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 20000; ++i) {
    const auto stamp = static_cast<std::int64_t>(random() % (1000 * kSecond));
    const std::int64_t receive = kSecond + i * 10'000;
    clock_.update(stamp, receive, kEpoch);
    if (!clock_.is_known()) continue;
    ASSERT_LE(*clock_.capture_us(stamp), receive);
    ASSERT_GE(*clock_.age_us(stamp, receive), 0);
  }
}

TEST_F(ClockOffsetTest, ExtremeStampsAreNotFatal) {
  using Limits = std::numeric_limits<std::int64_t>;
  for (const std::int64_t stamp : {Limits::min(), Limits::max(), std::int64_t{0}}) {
    for (int i = 1; i < 10; ++i) clock_.update(stamp, i * kSecond, {stamp, 0});
    for (const std::int64_t asked : {Limits::min(), Limits::max()}) {
      const auto age = clock_.age_us(asked, 10 * kSecond);
      if (age) {
        EXPECT_GE(*age, 0);
      }
    }
  }
}

}  // namespace
}  // namespace plumb
