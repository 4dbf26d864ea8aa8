#include "platform/event_loop.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "platform/clock.hpp"

namespace plumb {
namespace {

TEST(EventLoop, KeepsAPeriodWithoutDrift) {
  EventLoop loop;
  std::vector<std::int64_t> fired_us;
  const std::int64_t start_us = monotonic_us();
  loop.every(20'000, [&] {
    fired_us.push_back(monotonic_us() - start_us);
    usleep(8'000);  // the duration of a callback must not delay the next one
    if (fired_us.size() == 10) loop.stop();
  });
  loop.run();
  ASSERT_EQ(10U, fired_us.size());
  EXPECT_GE(fired_us.back(), 200'000);
  EXPECT_LT(fired_us.back(), 240'000);
}

TEST(EventLoop, DoesNotLetAFloodStarveATimer) {
  EventLoop loop;
  int ends[2];
  ASSERT_EQ(0, ::pipe(ends));
  ASSERT_EQ(1, ::write(ends[1], "x", 1));
  int rounds = 0;
  int ticks = 0;
  loop.watch(ends[0], [&] { ++rounds; });  // is never read and so is always ready
  loop.every(10'000, [&] {
    if (++ticks == 5) loop.stop();
  });
  const std::int64_t start_us = monotonic_us();
  loop.run();
  EXPECT_LT(monotonic_us() - start_us, 150'000);
  EXPECT_GT(rounds, 100);
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(EventLoop, FiresAnArmedTimerOnceAndADisarmedOneNever) {
  EventLoop loop;
  int once = 0;
  int never = 0;
  const auto a = loop.timer([&] { ++once; });
  const auto b = loop.timer([&] { ++never; });
  const auto past = loop.timer([&] { ++once; });
  loop.arm_at(a, monotonic_us() + 10'000);
  loop.arm_at(b, monotonic_us() + 10'000);
  loop.disarm(b);
  loop.arm_at(past, 0);
  loop.every(60'000, [&] { loop.stop(); });
  loop.run();
  EXPECT_EQ(2, once);
  EXPECT_EQ(0, never);
}

TEST(EventLoop, EndsOnAStopSignal) {
  for (const int number : {SIGINT, SIGTERM}) {
    EventLoop loop;
    ::kill(::getpid(), number);
    loop.run();
    EXPECT_EQ(number, loop.stop_signal());
    EXPECT_FALSE(loop.step(0));
  }
}

}  // namespace
}  // namespace plumb
