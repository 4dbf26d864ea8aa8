#include "platform/bus.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "platform/clock.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/vo_motion_t.hpp"
#include "tests/support/private_network.hpp"

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <typename Message>
Bytes encoded(const Message& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

void put_i32(Bytes* bytes, std::size_t at, std::int32_t value) {
  for (std::size_t i = 0; i < 4; ++i)
    (*bytes)[at + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
}

// A count of 2^31 - 1 has to be refused before the generated decoder allocates terabytes for it.
template <typename Message>
void expect_refused_at_every_flaw(const Message& message) {
  const Bytes whole = encoded(message);
  Message out;
  EXPECT_TRUE(decode_bounded(whole, &out));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_FALSE(decode_bounded(cut, &out)) << "cut to " << length << " of " << whole.size();
  }
  Bytes longer = whole;
  longer.push_back(0);
  EXPECT_FALSE(decode_bounded(longer, &out)) << "one byte too many";
  Bytes other = whole;
  other[0] ^= 1U;
  EXPECT_FALSE(decode_bounded(other, &out)) << "another type's fingerprint";
  std::mt19937 random(7);
  for (int i = 0; i < 5'000; ++i) {  // flipped bytes may decode, but must not throw or crash
    Bytes noisy = whole;
    for (int k = 0; k < 4; ++k)
      noisy[random() % noisy.size()] = static_cast<std::uint8_t>(random());
    EXPECT_NO_THROW((void)decode_bounded(noisy, &out));
  }
}

process_health_t sample_health() {
  process_health_t m{};
  m.process = "vo";
  m.version = "1.2.3";
  m.state_reason = "a reason";
  m.num_stages = 2;
  m.stages.resize(2);
  m.stages[0].name = "decode";
  m.stages[1].name = "track";
  m.stages[1].p99_us = 1234.5;
  return m;
}

TEST(BoundedDecode, RefusesEveryFlawOfAFixedMessage) {
  expect_refused_at_every_flaw(vo_motion_t{});
  expect_refused_at_every_flaw(ground_plane_t{});
}

TEST(BoundedDecode, RefusesEveryFlawOfAMessageWithTexts) {
  expect_refused_at_every_flaw(sample_health());
}

TEST(BoundedDecode, RefusesEveryFlawOfAList) {
  detections_t detections{};
  detections.num_detections = 2;
  detections.detections.resize(2);
  expect_refused_at_every_flaw(detections);
  objects_t objects{};
  objects.num_objects = 1;
  objects.objects.resize(1);
  expect_refused_at_every_flaw(objects);
}

TEST(BoundedDecode, RefusesListsLongerThanTheirMaximum) {
  detections_t detections{};
  detections.num_detections = detections_t::MAX_DETECTIONS;
  detections.detections.resize(detections_t::MAX_DETECTIONS);
  detections_t out;
  EXPECT_TRUE(decode_bounded(encoded(detections), &out));
  detections.num_detections++;
  detections.detections.resize(detections_t::MAX_DETECTIONS + 1);
  EXPECT_FALSE(decode_bounded(encoded(detections), &out));
}

TEST(BoundedDecode, RefusesHostileCountsAndTextLengths) {
  for (const std::int32_t hostile : {-1, 0x7FFFFFFF, 0x10000000, -2147483647 - 1}) {
    Bytes list = encoded(detections_t{});
    put_i32(&list, 24, hostile);
    detections_t detections;
    EXPECT_FALSE(decode_bounded(list, &detections)) << hostile;
    list = encoded(objects_t{});
    put_i32(&list, 32, hostile);
    objects_t objects;
    EXPECT_FALSE(decode_bounded(list, &objects)) << hostile;
    Bytes text = encoded(sample_health());
    put_i32(&text, 16, hostile);  // the length of `process`
    process_health_t health;
    EXPECT_FALSE(decode_bounded(text, &health)) << hostile;
  }
}

TEST(WireCursor, ReadsZeroBeyondTheEndAndSaysSo) {
  const Bytes bytes{0, 0, 0, 5, 1};
  WireCursor cursor(bytes);
  EXPECT_EQ(5, cursor.i32());
  EXPECT_TRUE(cursor.ok());
  EXPECT_FALSE(cursor.at_end());
  EXPECT_EQ(0, cursor.i32());
  EXPECT_FALSE(cursor.ok());
  EXPECT_TRUE(cursor.take(1).empty()) << "a failed cursor stays failed";
}

class BusTest : public testing::Test {
 protected:
  Counters counters_;
  Bus bus_{"memq://", &counters_};
};

TEST_F(BusTest, CarriesAMessageUnchanged) {
  ground_plane_t received{};
  Publisher<ground_plane_t> out(bus_, kGroundPlane);
  Subscriber<ground_plane_t> in(bus_, kGroundPlane, Input::kPeriodic, [&](const auto& m) {
    received = m;
    return nullptr;
  });
  ground_plane_t sent{};
  sent.seq = -7;
  sent.height_m = 1.0 / 3.0;
  sent.num_cues = 3;
  sent.cues.resize(3);
  sent.cues[2].n3 = -0.0;
  sent.cov[2][1] = 5e-324;  // the smallest positive number
  EXPECT_TRUE(out.publish(sent));
  EXPECT_TRUE(bus_.handle(1000));
  EXPECT_EQ(encoded(sent), encoded(received));
  EXPECT_EQ(1, counters_.num_received);
  EXPECT_EQ(1, counters_.num_published);
  EXPECT_EQ(0, counters_.num_rejected);
}

TEST_F(BusTest, HandlesEveryMessageInOrderWhenTheyPileUp) {
  std::vector<std::int64_t> seen;
  Publisher<ground_plane_t> out(bus_, kGroundPlane);
  Subscriber<ground_plane_t> in(bus_, kGroundPlane, Input::kPeriodic, [&](const auto& m) {
    seen.push_back(m.seq);
    return nullptr;
  });
  ground_plane_t message{};
  for (; message.seq < RawSubscriber::kQueueMessages; ++message.seq)
    ASSERT_TRUE(out.publish(message));
  while (bus_.handle(0)) {
  }
  ASSERT_EQ(static_cast<std::size_t>(RawSubscriber::kQueueMessages), seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(static_cast<std::int64_t>(i), seen[i]);
}

TEST_F(BusTest, CountsWhatDoesNotDecodeAndWhatItsHandlerRefuses) {
  int handled = 0;
  Subscriber<ground_plane_t> in(bus_, kGroundPlane, Input::kPeriodic, [&](const auto&) {
    ++handled;
    return "not today";
  });
  const Bytes good = encoded(ground_plane_t{});
  bus_.publish(kGroundPlane, std::span(good).first(20));
  bus_.publish(kGroundPlane, good);
  while (bus_.handle(0)) {
  }
  EXPECT_EQ(1, handled);
  EXPECT_EQ(2, counters_.num_received);
  EXPECT_EQ(2, counters_.num_rejected);
  EXPECT_STREQ("not today", counters_.last_rejection);
}

TEST_F(BusTest, SurvivesAHandlerThatThrows) {
  RawSubscriber in(bus_, kCamera, Input::kPeriodic,
                   [](RawSubscriber::Bytes) -> const char* { throw std::runtime_error("boom"); });
  bus_.publish(kCamera, Bytes{1});
  EXPECT_TRUE(bus_.handle(1000));
  EXPECT_EQ(1, counters_.num_rejected);
}

TEST_F(BusTest, CountsAMessageThatDoesNotFitAsUnsent) {
  Publisher<ground_plane_t> out(bus_, kGroundPlane, 16);
  EXPECT_FALSE(out.publish(ground_plane_t{}));
  EXPECT_EQ(1, counters_.num_unsent);
  EXPECT_EQ(0, counters_.num_published);
}

TEST_F(BusTest, CountsAMessageThatWaitedTooLongAsLate) {
  static constexpr Channel kImpatient{"IMPATIENT", "test", 10.0, 20'000};
  RawSubscriber in(bus_, kImpatient, Input::kPeriodic,
                   [](RawSubscriber::Bytes) { return nullptr; });
  bus_.publish(kImpatient, Bytes{1});
  bus_.handle(0);
  EXPECT_EQ(0, counters_.num_late);
  bus_.publish(kImpatient, Bytes{1});
  usleep(60'000);
  bus_.handle(0);
  EXPECT_EQ(1, counters_.num_late);
  EXPECT_GE(in.last_us() - in.arrival_us(), 60'000);
}

TEST_F(BusTest, CountsAMessageAsLateByTheTimeOfItsCaptureWhereThatIsKnown) {
  static constexpr Channel kImpatient{"IMPATIENT", "test", 10.0, 20'000};
  Subscriber<vo_motion_t> in(bus_, kImpatient, Input::kPeriodic,
                             [](const vo_motion_t&) { return nullptr; });
  const auto handle = [&](std::int64_t capture_us) {
    vo_motion_t motion{};
    motion.capture_mono_us = capture_us;
    bus_.publish(kImpatient, encoded(motion));
    bus_.handle(0);
    return counters_.num_late;
  };
  EXPECT_EQ(0, handle(0)) << "not known";
  EXPECT_EQ(0, handle(monotonic_us()));
  EXPECT_EQ(1, handle(monotonic_us() - 30'000)) << "it came at once, and shows what is 30 ms old";
  EXPECT_EQ(1, handle(monotonic_us() + 3'600'000'000)) << "no capture lies in the future";
  EXPECT_EQ(1, handle(std::numeric_limits<std::int64_t>::min()));
  EXPECT_EQ(2, handle(1));
}

TEST_F(BusTest, SaysWhetherAMessageWasOvertakenAndCountsItAsSkippedInsteadOfLate) {
  static constexpr Channel kImpatient{"IMPATIENT", "test", 10.0, 20'000};
  std::vector<bool> overtaken;
  RawSubscriber in(bus_, kImpatient, Input::kPeriodic, [&](RawSubscriber::Bytes) {
    overtaken.push_back(in.is_overtaken(30'000));
    if (overtaken.back()) in.skip();
    return nullptr;
  });
  bus_.publish(kImpatient, Bytes{1});
  bus_.publish(kImpatient, Bytes{2});
  bus_.handle(0);
  usleep(60'000);
  bus_.publish(kImpatient, Bytes{3});
  while (bus_.handle(0)) {
  }
  EXPECT_EQ((std::vector<bool>{false, true, false}), overtaken)
      << "the first one was on time, the second one was not, and none was newer than the third";
  EXPECT_EQ(1, counters_.num_skipped);
  EXPECT_EQ(0, counters_.num_late);
}

TEST_F(BusTest, CountsNoWaitFromBeforeTheProcessWasReady) {
  bool by_arrival = false;
  bool since_ready = true;
  RawSubscriber in(bus_, kCamera, Input::kPeriodic, [&](RawSubscriber::Bytes) {
    by_arrival = by_arrival || in.is_overtaken(30'000);
    since_ready = in.is_overtaken(30'000, monotonic_us() - 20'000);
    return nullptr;
  });
  bus_.publish(kCamera, Bytes{1});
  bus_.publish(kCamera, Bytes{2});
  usleep(60'000);
  bus_.handle(0);
  EXPECT_TRUE(by_arrival);
  EXPECT_FALSE(since_ready);
}

TEST_F(BusTest, GivesTheNewestMessageAloneWhereItsReaderAsksForIt) {
  std::vector<std::uint8_t> seen;
  RawSubscriber in(bus_, kCamera, Input::kPeriodic,
                   [&](RawSubscriber::Bytes bytes) {
                     seen.push_back(bytes[0]);
                     return nullptr;
                   },
                   {10, 2, Delivery::kLatest});
  for (std::uint8_t i = 1; i <= 5; ++i) EXPECT_TRUE(bus_.publish(kCamera, Bytes{i}));
  while (bus_.handle(0)) {
  }
  EXPECT_EQ(Bytes{5}, seen);
  EXPECT_EQ(4, in.num_skipped());
  EXPECT_EQ(1, counters_.num_received);
}

TEST_F(BusTest, HandsOnAMessageWithoutBytes) {
  std::size_t size = 99;
  RawSubscriber in(bus_, kCamera, Input::kPeriodic, [&](RawSubscriber::Bytes bytes) {
    size = bytes.size();
    return nullptr;
  });
  EXPECT_TRUE(bus_.publish(kCamera, {}));
  EXPECT_TRUE(bus_.handle(0));
  EXPECT_EQ(0U, size);
}

TEST_F(BusTest, DoesNotTakeWhatItsReaderHasNoRoomFor) {
  RawSubscriber in(bus_, kCamera, Input::kPeriodic, [](RawSubscriber::Bytes) { return nullptr; },
                   {10, 2});
  EXPECT_FALSE(bus_.publish(kCamera, Bytes(11)));
  EXPECT_TRUE(bus_.publish(kCamera, Bytes(10)));
  EXPECT_TRUE(bus_.publish(kCamera, Bytes(10)));
  EXPECT_FALSE(bus_.publish(kCamera, Bytes(10)));
  EXPECT_TRUE(bus_.publish(kVoMotion, Bytes(10))) << "nobody reads it";
}

TEST_F(BusTest, AChannelHasOneReader) {
  const auto take = [](RawSubscriber::Bytes) { return nullptr; };
  {
    RawSubscriber first(bus_, kCamera, Input::kPeriodic, take);
    EXPECT_THROW(RawSubscriber(bus_, kCamera, Input::kPeriodic, take), BusError);
  }
  EXPECT_NO_THROW(RawSubscriber(bus_, kCamera, Input::kPeriodic, take));
}

TEST(Bus, RefusesWhatIsNoNetworkItCanUse) {
  Counters counters;
  for (const char* url : {"nosuch://", "tcpq://10.0.0.1", "file://log", "udpm://10.0.0.1"})
    EXPECT_THROW(Bus(url, &counters), BusError) << url;
}

class BusOnNetwork : public testing::Test {
 protected:
  static void SetUpTestSuite() { is_private_ = test::enter_private_network(); }
  void SetUp() override {
    if (!is_private_) GTEST_SKIP() << test::kNoPrivateNetwork;
  }
  static inline bool is_private_ = false;
};

TEST_F(BusOnNetwork, CarriesMessagesBetweenTwoProgramsAndRefusesWhatIsTooLarge) {
  Counters sent;
  Counters received;
  Bus sender("udpm://239.255.76.67:7667?ttl=0", &sent);
  Bus receiver("udpm://239.255.76.67:7667?ttl=0", &received);
  EXPECT_EQ(0, sender.receive_buffer_bytes()) << "it has not joined";
  std::size_t size = 0;
  RawSubscriber in(receiver, kCamera, Input::kPeriodic,
                   [&](RawSubscriber::Bytes bytes) {
                     size = bytes.size();
                     return nullptr;
                   },
                   {200'000, 2});
  EXPECT_GT(receiver.receive_buffer_bytes(), 0);
  EXPECT_TRUE(sender.publish(kCamera, Bytes(200'000)));
  EXPECT_TRUE(receiver.handle(1'000));
  EXPECT_EQ(200'000U, size);
  EXPECT_TRUE(sender.publish(kCamera, Bytes(200'001)));
  EXPECT_TRUE(sender.publish(kVoMotion, Bytes(10)));
  EXPECT_FALSE(receiver.handle(100));
  EXPECT_EQ(1, received.num_rejected);
  EXPECT_STREQ("the message is larger than its channel allows", received.last_rejection);
}

TEST(LossCounter, CountsGapsAndTellsThemFromRepeatsAndRestarts) {
  LossCounter losses;
  EXPECT_EQ(SeqStep::kFirst, losses.take(40));
  EXPECT_EQ(SeqStep::kNext, losses.take(41));
  EXPECT_EQ(SeqStep::kRepeat, losses.take(41));
  EXPECT_EQ(SeqStep::kGap, losses.take(45));
  EXPECT_EQ(3, losses.num_lost());
  EXPECT_EQ(SeqStep::kRestart, losses.take(0));
  EXPECT_EQ(SeqStep::kNext, losses.take(1));
  EXPECT_EQ(SeqStep::kRestart, losses.take(INT64_MAX));
  EXPECT_EQ(SeqStep::kNext, losses.take(INT64_MIN)) << "numbers may wrap";
  EXPECT_EQ(3, losses.num_lost());
}

}  // namespace
}  // namespace plumb
