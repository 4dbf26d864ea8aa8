#include "modules/camera/pacing.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

TEST(Pacer, FollowsTheRecordedTimesAtItsSpeed) {
  Pacer pacer(2.0);
  EXPECT_EQ(pacer.due_us(5'000'000, 100), 100);
  EXPECT_EQ(pacer.due_us(5'100'000, 200), 100 + 50'000);
  EXPECT_EQ(pacer.due_us(5'200'001, 300),
            100 + 100'001);  // half a microsecond is rounded away from 0
  EXPECT_EQ(pacer.due_us(6'000'000, 400), 100 + 500'000);
}

TEST(Pacer, ASlowReaderDoesNotMoveTheSchedule) {
  Pacer pacer(1.0);
  EXPECT_EQ(pacer.due_us(0, 1'000), 1'000);
  // The caller is half a second late. This frame was due before, and the next keeps the schedule.
  EXPECT_EQ(pacer.due_us(100'000, 600'000), 101'000);
  EXPECT_EQ(pacer.due_us(700'000, 610'000), 701'000);
}

TEST(Pacer, SpeedZeroIsAlwaysDueNow) {
  Pacer pacer(0.0);
  EXPECT_EQ(pacer.due_us(0, 10), 10);
  EXPECT_EQ(pacer.due_us(9'000'000, 11), 11);
}

TEST(Pacer, KeepsMicrosecondsOverADay) {
  Pacer pacer(1.0);
  constexpr std::int64_t kDay_us = 86'400'000'000;
  EXPECT_EQ(pacer.due_us(kDay_us, 7), 7);
  EXPECT_EQ(pacer.due_us(2 * kDay_us + 1, 8), 7 + kDay_us + 1);
}

TEST(SequenceTracker, CountsWhatTheDriverDropped) {
  SequenceTracker tracker;
  EXPECT_EQ(tracker.next(40), 0);
  EXPECT_EQ(tracker.next(41), 1);
  EXPECT_EQ(tracker.next(45), 5);
  EXPECT_EQ(tracker.num_missing(), 3);
}

TEST(SequenceTracker, SurvivesTheWrapOfThe32BitCounter) {
  SequenceTracker tracker;
  EXPECT_EQ(tracker.next(0xFFFF'FFFEU), 0);
  EXPECT_EQ(tracker.next(0xFFFF'FFFFU), 1);
  EXPECT_EQ(tracker.next(1), 3);  // frame 0 was dropped
  EXPECT_EQ(tracker.num_missing(), 1);
}

TEST(SequenceTracker, ACounterThatRestsOrStepsBackIsNoLoss) {
  SequenceTracker tracker;
  EXPECT_EQ(tracker.next(7), 0);
  EXPECT_EQ(tracker.next(7), 1);
  EXPECT_EQ(tracker.next(3), 2);
  EXPECT_EQ(tracker.num_missing(), 0);
}

TEST(SequenceTracker, ARestartNeverRepeatsANumberAndCountsTheSilence) {
  SequenceTracker tracker;
  EXPECT_EQ(tracker.next(100), 0);
  tracker.restart(12);
  EXPECT_EQ(tracker.next(0), 13);
  EXPECT_EQ(tracker.next(1), 14);
  EXPECT_EQ(tracker.num_missing(), 12);
}

TEST(SequenceTracker, ARestartBeforeTheFirstFrameMeansNothing) {
  SequenceTracker tracker;
  tracker.restart(12);
  EXPECT_EQ(tracker.next(5), 0);
  EXPECT_EQ(tracker.num_missing(), 0);
}

TEST(BackOff, DoublesUpToItsLimitAndStartsOverAfterSuccess) {
  BackOff back_off(500'000, 3'000'000);
  EXPECT_EQ(back_off.next_us(), 500'000);
  EXPECT_EQ(back_off.next_us(), 1'000'000);
  EXPECT_EQ(back_off.next_us(), 2'000'000);
  EXPECT_EQ(back_off.next_us(), 3'000'000);
  EXPECT_EQ(back_off.next_us(), 3'000'000);
  back_off.reset();
  EXPECT_EQ(back_off.next_us(), 500'000);
}

TEST(BackOff, AMaximumBelowTheMinimumHoldsTheMinimum) {
  BackOff back_off(500'000, 100'000);
  EXPECT_EQ(back_off.next_us(), 500'000);
  EXPECT_EQ(back_off.next_us(), 500'000);
}

}  // namespace
}  // namespace plumb
