#include "platform/health.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "platform/clock.hpp"
#include "platform/memory_usage.hpp"

namespace plumb {
namespace {

constexpr Channel kInput{"INPUT", "test", 10.0, 100'000};

class HealthTest : public testing::Test {
 protected:
  HealthState state_at(std::int64_t now_us) {
    const process_health_t& m = health_.report(now_us, counters_, bus_, timer_);
    reason_ = m.state_reason;
    return static_cast<HealthState>(m.state);
  }
  Counters counters_;
  Bus bus_{"memq://", &counters_};
  StageTimer timer_;
  Health health_{"test"};
  std::string reason_;
};

TEST_F(HealthTest, WaitsUntilAPeriodicInputArrivesAndAgainWhenItFallsSilent) {
  RawSubscriber in(bus_, kInput, Input::kPeriodic, [](RawSubscriber::Bytes) { return nullptr; });
  EXPECT_EQ(HealthState::kWaiting, state_at(monotonic_us()));
  EXPECT_EQ("no INPUT yet", reason_);
  bus_.publish(kInput, std::vector<std::uint8_t>{1});
  bus_.handle(100);
  EXPECT_EQ(HealthState::kRunning, state_at(in.last_us() + 99'000));
  EXPECT_EQ("", reason_);
  EXPECT_EQ(HealthState::kWaiting, state_at(in.last_us() + 1'500'000));
  EXPECT_EQ("no INPUT for 1.5 s", reason_);
}

TEST_F(HealthTest, DoesNotWaitForAnOccasionalInput) {
  RawSubscriber in(bus_, kInput, Input::kOccasional, [](RawSubscriber::Bytes) { return nullptr; });
  EXPECT_EQ(HealthState::kRunning, state_at(1'000'000));
}

TEST_F(HealthTest, IsDegradedForASecondAfterALossOrRejection) {
  EXPECT_EQ(HealthState::kRunning, state_at(1'000'000));
  counters_.reject("too green");
  EXPECT_EQ(HealthState::kDegraded, state_at(1'500'000));
  EXPECT_EQ("1 messages rejected: too green", reason_);
  EXPECT_EQ(HealthState::kDegraded, state_at(2'400'000));
  EXPECT_EQ(HealthState::kRunning, state_at(2'600'000));
  counters_.num_dropped += 3;
  counters_.reject("too green");
  EXPECT_EQ(HealthState::kDegraded, state_at(3'000'000));
  EXPECT_EQ("3 messages lost", reason_) << "a loss is more serious than a rejection";
}

TEST_F(HealthTest, ExcusesTheOutputOfAProcessThatLacksWhatItNeeds) {
  EXPECT_FALSE(health_.is_output_excused());
  health_.set_condition(HealthState::kWaiting, "no calibration yet");
  EXPECT_TRUE(health_.is_output_excused());
  health_.set_condition(HealthState::kDegraded, "no interface", Health::Output::kExcused);
  EXPECT_TRUE(health_.is_output_excused());
  health_.set_condition(HealthState::kDegraded, "the camera was moved");
  EXPECT_FALSE(health_.is_output_excused()) << "it goes on measuring";
  health_.set_condition(HealthState::kDegraded, "no interface", Health::Output::kExcused);
  health_.clear_condition();
  EXPECT_FALSE(health_.is_output_excused());
}

TEST_F(HealthTest, TellsOfSkippedMessagesAndOfResultsWithoutAnInput) {
  counters_.num_late = 1;
  counters_.num_skipped = 12;
  EXPECT_EQ(HealthState::kDegraded, state_at(1'000'000));
  EXPECT_EQ("12 messages skipped for newer ones", reason_);
  counters_.num_unpaired = 2;
  EXPECT_EQ(HealthState::kDegraded, state_at(3'000'000));
  EXPECT_EQ("2 results without an input that came too late", reason_);
}

TEST_F(HealthTest, NamesAnAbsentInputBeforeLosses) {
  RawSubscriber in(bus_, kInput, Input::kPeriodic, [](RawSubscriber::Bytes) { return nullptr; });
  counters_.num_dropped = 3;
  EXPECT_EQ(HealthState::kWaiting, state_at(monotonic_us()));
  EXPECT_EQ("no INPUT yet", reason_);
}

TEST_F(HealthTest, PutsAConditionBeforeEverythingElse) {
  counters_.num_dropped = 1;
  health_.set_condition(HealthState::kWaiting, "no calibration yet");
  EXPECT_EQ(HealthState::kWaiting, state_at(1'000'000));
  EXPECT_EQ("no calibration yet", reason_);
  health_.clear_condition();
  EXPECT_EQ(HealthState::kDegraded, state_at(1'500'000));
}

TEST_F(HealthTest, ReportsCountersStagesAndMemory) {
  counters_ = {1, 2, 3, 4, 5, 6, 7, 8, ""};
  timer_.begin();
  timer_.mark("track");
  timer_.end();
  const process_health_t& m = health_.report(77, counters_, bus_, timer_);
  EXPECT_EQ(77, m.utime);
  EXPECT_EQ("test", m.process);
  EXPECT_EQ(1, m.num_received);
  EXPECT_EQ(2, m.num_rejected);
  EXPECT_EQ(3, m.num_dropped);
  EXPECT_EQ(4, m.num_late);
  EXPECT_EQ(5, m.num_published);
  EXPECT_EQ(6, m.num_unsent);
  EXPECT_EQ(7, m.num_skipped);
  EXPECT_EQ(8, m.num_unpaired);
  ASSERT_EQ(2, m.num_stages);
  EXPECT_EQ("track", m.stages[0].name);
  EXPECT_EQ("total", m.stages[1].name);
  EXPECT_GT(m.memory_rss_bytes, 1'000'000);
  EXPECT_GE(m.memory_peak_bytes, m.memory_rss_bytes / 2);
}

TEST_F(HealthTest, FitsItsPublisherHoweverLongTheTexts) {
  const std::string endless(10'000, 'x');
  std::vector<std::string> names;
  for (std::size_t i = 0; i < StageTimer::kMaxStages; ++i)
    names.push_back(endless + std::to_string(i));
  timer_.begin();
  for (const std::string& name : names) timer_.mark(name.c_str());
  timer_.end();
  health_.set_condition(HealthState::kDegraded, endless.c_str());
  const process_health_t& m = health_.report(1, counters_, bus_, timer_);
  Publisher<process_health_t> out(bus_, kInput, Health::kMaxBytes);
  EXPECT_TRUE(out.publish(m));
  process_health_t back;
  EXPECT_TRUE(decode_bounded(out.encode(m), &back));
}

TEST(MemoryUsage, GrowsWithWhatIsTouched) {
  const MemoryUsage before = memory_usage();
  std::vector<char> block(64 << 20);
  std::memset(block.data(), 1, block.size());
  const MemoryUsage after = memory_usage();
  EXPECT_GT(after.rss_bytes, before.rss_bytes + (60 << 20));
  EXPECT_GE(after.peak_bytes, after.rss_bytes - (1 << 20));
}

}  // namespace
}  // namespace plumb
