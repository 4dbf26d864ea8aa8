#include "modules/integrity/one_sender.hpp"

#include <gtest/gtest.h>

#include "modules/integrity/steady_numbers.hpp"

namespace plumb {
namespace {

using Verdict = OneSender::Verdict;

TEST(OneSender, FollowsTheNewestAndIgnoresAnOlderOneThatInterleaves) {
  OneSender sender;
  EXPECT_EQ(sender.take(5), Verdict::kNew);
  EXPECT_EQ(sender.take(9), Verdict::kNew);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(sender.take(5), Verdict::kForeign);
    EXPECT_EQ(sender.take(5), Verdict::kForeign);
    EXPECT_EQ(sender.take(9), Verdict::kSame);
  }
}

TEST(OneSender, FollowsAnOlderOneWhenTheNewestIsSilent) {
  OneSender sender;
  EXPECT_EQ(sender.take(9), Verdict::kNew);
  EXPECT_EQ(sender.take(5), Verdict::kForeign);
  EXPECT_EQ(sender.take(7), Verdict::kForeign);
  EXPECT_EQ(sender.take(5), Verdict::kForeign);
  EXPECT_EQ(sender.take(5), Verdict::kForeign);
  EXPECT_EQ(sender.take(5), Verdict::kNew);
  EXPECT_EQ(sender.take(5), Verdict::kSame);
}

TEST(OneSender, FollowsASenderThatStatesItsSessionRatherThanOneThatDoesNot) {
  OneSender sender;
  EXPECT_EQ(sender.take(0), Verdict::kNew);
  EXPECT_EQ(sender.take(7), Verdict::kNew);
  EXPECT_EQ(sender.take(0), Verdict::kForeign);
  EXPECT_EQ(sender.take(7), Verdict::kSame);
}

TEST(OneSender, FollowsWhoeverIsHeardNextAfterItForgot) {
  OneSender sender(7);
  EXPECT_EQ(sender.take(9), Verdict::kNew);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(sender.take(5), Verdict::kForeign) << i;
  EXPECT_EQ(sender.take(9), Verdict::kSame);
  sender.forget();
  EXPECT_EQ(sender.take(5), Verdict::kNew);
}

TEST(SteadyNumbers, NeverGoBack) {
  SteadyNumbers numbers;
  EXPECT_EQ(numbers.take(80), 80);
  EXPECT_EQ(numbers.take(81), 81);
  numbers.begin_anew(3);
  EXPECT_EQ(numbers.take(3), 81 + SteadyNumbers::kGap);
  EXPECT_EQ(numbers.take(4), 82 + SteadyNumbers::kGap);
  EXPECT_EQ(numbers.source(82 + SteadyNumbers::kGap), 4);
  EXPECT_FALSE(numbers.is_present(81)) << "an image of the earlier time line";
  EXPECT_TRUE(numbers.is_present(numbers.steady(3)));
}

TEST(SteadyNumbers, TakeTheNumbersOfAHostileSource) {
  SteadyNumbers numbers;
  EXPECT_EQ(numbers.take(5), 5);
  numbers.begin_anew(INT64_MIN);
  EXPECT_EQ(numbers.take(INT64_MIN), 5 + SteadyNumbers::kGap);
  EXPECT_EQ(numbers.source(5 + SteadyNumbers::kGap), INT64_MIN);
}

}  // namespace
}  // namespace plumb
