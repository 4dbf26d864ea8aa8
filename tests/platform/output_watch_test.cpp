#include "platform/output_watch.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "platform/clock.hpp"

namespace plumb {
namespace {

constexpr Channel kImages{"IMAGES", "test", 10.0, 100'000};
constexpr Channel kBoxes{"BOXES", "test", 10.0, 100'000};
constexpr Channel kLens{"LENS", "test", 1.0, 100'000};

class OutputWatchTest : public testing::Test {
 protected:
  void bring(const Channel& channel) {
    bus_.publish(channel, std::vector<std::uint8_t>{1});
    ASSERT_TRUE(bus_.handle(100));
  }
  bool judge(bool is_excused = false) {
    return watch_.judge(monotonic_us(), bus_, counters_, is_excused);
  }
  RawSubscriber::Handler handler() {
    return [this](RawSubscriber::Bytes) { return refusal_; };
  }

  Counters counters_;
  Bus bus_{"memq://", &counters_};
  const char* refusal_ = nullptr;
  OutputWatch watch_{false};
};

TEST_F(OutputWatchTest, OutputIsDueWhenAllPeriodicInputsWereAccepted) {
  RawSubscriber images(bus_, kImages, Input::kPeriodic, handler());
  RawSubscriber boxes(bus_, kBoxes, Input::kPeriodic, handler());
  RawSubscriber lens(bus_, kLens, Input::kOccasional, handler());
  EXPECT_TRUE(judge()) << "nothing arrived";
  bring(kImages);
  bring(kLens);
  EXPECT_TRUE(judge()) << "there are no boxes";
  bring(kBoxes);
  EXPECT_TRUE(judge()) << "no image since all was well";
  bring(kImages);
  bring(kBoxes);
  EXPECT_FALSE(judge());
  EXPECT_FALSE(judge()) << "time alone mends nothing";
  EXPECT_TRUE(judge(true)) << "it says what it lacks";
  bring(kImages);
  bring(kBoxes);
  EXPECT_FALSE(judge());
  ++counters_.num_published;
  EXPECT_TRUE(judge());
}

TEST_F(OutputWatchTest, ARefusedOrSkippedInputMakesNoOutputDue) {
  RawSubscriber boxes(bus_, kBoxes, Input::kPeriodic, handler());
  std::optional<RawSubscriber> images;
  images.emplace(bus_, kImages, Input::kPeriodic, [&images](RawSubscriber::Bytes) {
    images->skip();
    return nullptr;
  });
  refusal_ = "too green";
  bring(kBoxes);
  bring(kImages);
  EXPECT_TRUE(judge());
  refusal_ = nullptr;
  bring(kBoxes);
  EXPECT_TRUE(judge()) << "the image was skipped";
}

TEST_F(OutputWatchTest, ACyclicProcessOwesItsOutputAlways) {
  OutputWatch watch(true);
  EXPECT_FALSE(watch.judge(1, bus_, counters_, false));
  counters_.num_published = 5;
  EXPECT_TRUE(watch.judge(2, bus_, counters_, false));
  EXPECT_FALSE(watch.judge(3, bus_, counters_, false));
  EXPECT_TRUE(watch.judge(4, bus_, counters_, true)) << "the interface is down, and it says so";
}

}  // namespace
}  // namespace plumb
