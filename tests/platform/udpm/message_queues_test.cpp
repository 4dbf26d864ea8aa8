#include "platform/udpm/message_queues.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/platform/udpm/packets.hpp"

namespace plumb {
namespace {

using test::Bytes;

Bytes bytes_of(const MessageQueues::View& view) { return {view.bytes.begin(), view.bytes.end()}; }

TEST(MessageQueues, GiveMessagesOfAllChannelsInTheOrderOfArrival) {
  MessageQueues queues;
  const int a = queues.subscribe({"A", 4, 3});
  const int b = queues.subscribe({"B", 4, 3});
  EXPECT_EQ(a, queues.find("A"));
  EXPECT_EQ(b, queues.find("B"));
  EXPECT_EQ(MessageQueues::kNone, queues.find("C"));
  EXPECT_TRUE(queues.is_empty());
  queues.push(b, Bytes{1}, 10);
  queues.push(a, Bytes{2}, 20);
  queues.push(b, Bytes{}, 30);
  queues.push(a, Bytes{4, 4, 4, 4}, 40);
  MessageQueues::View view = queues.pop();
  EXPECT_EQ(b, view.subscription);
  EXPECT_EQ(10, view.arrival_us);
  EXPECT_EQ(Bytes{1}, bytes_of(view));
  EXPECT_EQ(a, queues.pop().subscription);
  view = queues.pop();
  EXPECT_EQ(30, view.arrival_us);
  EXPECT_TRUE(view.bytes.empty());
  EXPECT_FALSE(queues.is_empty());
  EXPECT_EQ((Bytes{4, 4, 4, 4}), bytes_of(queues.pop()));
  EXPECT_TRUE(queues.is_empty());
  EXPECT_EQ(MessageQueues::kNone, queues.pop().subscription);
}

TEST(MessageQueues, AreFullWhenAllSlotsOfAChannelAreTakenTheOneBeingHandledIncluded) {
  MessageQueues queues;
  const int a = queues.subscribe({"A", 1, 2});
  const int b = queues.subscribe({"B", 1, 9});
  for (int round = 0; round < 5; ++round) {
    queues.push(a, Bytes{1}, 0);
    EXPECT_FALSE(queues.is_full());
    queues.push(a, Bytes{2}, 0);
    EXPECT_TRUE(queues.is_full());
    EXPECT_TRUE(queues.is_full(a));
    EXPECT_FALSE(queues.is_full(b));
    EXPECT_EQ(Bytes{1}, bytes_of(queues.pop()));
    EXPECT_TRUE(queues.is_full()) << "the message is being handled";
    queues.release();
    EXPECT_FALSE(queues.is_full());
    EXPECT_EQ(Bytes{2}, bytes_of(queues.pop()));
    queues.release();
  }
}

TEST(MessageQueues, LatestReplacesWhatWaitsAndCountsItAsSkipped) {
  MessageQueues queues;
  const int image = queues.subscribe({"IMAGE", 1, 1, Delivery::kLatest});
  const int motion = queues.subscribe({"MOTION", 1, 9});
  queues.push(image, Bytes{1}, 1);
  queues.push(motion, Bytes{11}, 2);
  queues.push(image, Bytes{2}, 3);
  queues.push(motion, Bytes{12}, 4);
  queues.push(image, Bytes{3}, 5);
  EXPECT_FALSE(queues.is_full());
  EXPECT_EQ(2, queues.num_skipped(image));
  EXPECT_EQ(Bytes{11}, bytes_of(queues.pop()));
  EXPECT_EQ(Bytes{12}, bytes_of(queues.pop()));
  EXPECT_EQ(Bytes{3}, bytes_of(queues.pop()));
  EXPECT_EQ(MessageQueues::kNone, queues.pop().subscription);
  EXPECT_EQ(0, queues.num_skipped(motion));
}

TEST(MessageQueues, LatestLeavesTheMessageBeingHandledAlone) {
  MessageQueues queues;
  const int image = queues.subscribe({"IMAGE", 1, 1, Delivery::kLatest});
  queues.push(image, Bytes{1}, 1);
  const MessageQueues::View handled = queues.pop();
  for (std::uint8_t i = 2; i < 9; ++i) queues.push(image, Bytes{i}, i);
  EXPECT_EQ(Bytes{1}, bytes_of(handled));
  EXPECT_EQ(6, queues.num_skipped(image));
  const MessageQueues::View newest = queues.pop();
  EXPECT_EQ(Bytes{8}, bytes_of(newest));
  EXPECT_EQ(8, newest.arrival_us);
  EXPECT_TRUE(queues.is_empty());
}

TEST(MessageQueues, SwapABufferOfTheSlotsSizeAndCopyAnother) {
  MessageQueues queues;
  const int a = queues.subscribe({"A", 3, 2});
  Bytes same{1, 2, 3};
  const std::uint8_t* const storage = same.data();
  queues.push_buffer(a, &same, 2, 7);
  EXPECT_EQ(3U, same.size());
  const MessageQueues::View swapped = queues.pop();
  EXPECT_EQ(storage, swapped.bytes.data());
  EXPECT_EQ((Bytes{1, 2}), bytes_of(swapped));
  EXPECT_EQ(7, swapped.arrival_us);
  Bytes larger{5, 6, 7, 8};
  queues.push_buffer(a, &larger, 3, 8);
  EXPECT_EQ((Bytes{5, 6, 7, 8}), larger);
  EXPECT_EQ((Bytes{5, 6, 7}), bytes_of(queues.pop()));
}

TEST(MessageQueues, RefuseSubscriptionsThatCannotWork) {
  MessageQueues queues;
  (void)queues.subscribe({"A", 1, 1});
  EXPECT_THROW(queues.subscribe({"A", 1, 1}), std::invalid_argument);
  EXPECT_THROW(queues.subscribe({"", 1, 1}), std::invalid_argument);
  EXPECT_THROW(queues.subscribe({std::string(64, 'C'), 1, 1}), std::invalid_argument);
  EXPECT_THROW(queues.subscribe({"B", 0, 1}), std::invalid_argument);
  EXPECT_THROW(queues.subscribe({"B", 1, 0}), std::invalid_argument);
}

TEST(MessageQueues, ForgetAnUnsubscribedChannelAndItsMessages) {
  MessageQueues queues;
  const int a = queues.subscribe({"A", 1, 1});
  const int b = queues.subscribe({"B", 1, 3});
  queues.push(a, Bytes{1}, 1);
  queues.push(b, Bytes{2}, 2);
  queues.push(b, Bytes{3}, 3);
  EXPECT_EQ(a, queues.pop().subscription);
  queues.unsubscribe(a);
  EXPECT_TRUE(queues.is_unsubscribed(a));
  EXPECT_FALSE(queues.is_full());
  EXPECT_EQ(MessageQueues::kNone, queues.find("A"));
  EXPECT_EQ(MessageQueues::kNone, queues.find(""));
  EXPECT_EQ(b, queues.pop().subscription);
  queues.unsubscribe(b);
  EXPECT_TRUE(queues.is_empty());
  EXPECT_EQ(MessageQueues::kNone, queues.pop().subscription);
  EXPECT_NE(a, queues.subscribe({"A", 1, 1})) << "a number is not used again";
}

}  // namespace
}  // namespace plumb
