// Tests the reader of messages from outside: every length at its limit and one beyond.
#include "platform/bounded_decode.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "plumb/mount_t.hpp"

namespace plumb {
namespace {

using Octets = std::vector<std::uint8_t>;

template <typename Message>
Octets octets_of(const Message& message) {
  Octets bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

template <typename Message>
bool is_accepted(std::span<const std::uint8_t> bytes) {
  Message message;
  return decode_bounded(bytes, &message);
}

/// Every shorter message and one with a byte more is refused.
template <typename Message>
void expect_exact_size(Octets bytes) {
  EXPECT_TRUE(is_accepted<Message>(bytes));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Octets cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(is_accepted<Message>(cut)) << size << " of " << bytes.size();
  }
  bytes.push_back(0);
  EXPECT_FALSE(is_accepted<Message>(bytes));
}

process_health_t health_with(std::int32_t num_stages) {
  process_health_t message{};
  message.process = "vo";
  message.version = "1";
  message.state_reason = "why";
  message.num_stages = num_stages;
  message.stages.resize(static_cast<std::size_t>(num_stages));
  for (stage_latency_t& stage : message.stages) stage.name = "stage";
  return message;
}

std::int32_t i32_at(const Octets& bytes, std::size_t at) {
  return WireCursor(std::span(bytes).subspan(at)).i32();
}

void set_i32(std::int32_t value, std::size_t at, Octets* bytes) {
  for (std::size_t i = 0; i < 4; ++i)
    (*bytes)[at + i] =
        static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24U - 8U * i));
}

TEST(WireCursor, ReadsBigEndianNumbers) {
  const Octets bytes = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08, 0xFF, 0xFF, 0xFF, 0xFE};
  WireCursor cursor(bytes);
  EXPECT_EQ(0x0102030405060708, cursor.i64());
  EXPECT_TRUE(cursor.ok());
  EXPECT_FALSE(cursor.at_end());
  EXPECT_EQ(-2, cursor.i32());
  EXPECT_TRUE(cursor.ok());
  EXPECT_TRUE(cursor.at_end());
}

TEST(WireCursor, ReadsZeroBeyondTheEndAndStaysBroken) {
  const Octets bytes = {1, 2, 3, 4, 5};
  WireCursor cursor(bytes);
  EXPECT_EQ(0, cursor.i64());
  EXPECT_FALSE(cursor.ok());
  EXPECT_EQ(0, cursor.i32()) << "although four bytes are there";
  EXPECT_FALSE(cursor.at_end());
}

TEST(WireCursor, TakesUpToTheEndAndNothingNegative) {
  const Octets bytes = {1, 2, 3};
  WireCursor cursor(bytes);
  EXPECT_EQ(2U, cursor.take(2).size());
  EXPECT_EQ(0U, cursor.take(0).size());
  EXPECT_TRUE(cursor.ok());
  EXPECT_EQ(3, cursor.take(1).front());
  EXPECT_TRUE(cursor.at_end());
  WireCursor back(bytes);
  back.skip(-1);
  EXPECT_FALSE(back.ok());
  WireCursor beyond(bytes);
  beyond.skip(4);
  EXPECT_FALSE(beyond.ok());
}

TEST(WireCursor, TakesTextsThatEndWithZero) {
  const Octets good = {0, 0, 0, 3, 'a', 'b', 0, 'c'};
  WireCursor cursor(good);
  const auto text = cursor.text();
  EXPECT_EQ("ab", std::string(text.begin(), text.end()));
  EXPECT_TRUE(cursor.ok());
  EXPECT_EQ('c', cursor.take(1).front());
  const Octets lone_zero = {0, 0, 0, 1, 0};
  WireCursor nothing(lone_zero);
  EXPECT_TRUE(nothing.text().empty());
  EXPECT_TRUE(nothing.at_end());
  for (const Octets& bad : {Octets{0, 0, 0, 2, 'a', 'b'}, Octets{0, 0, 0, 0, 'a'},
                            Octets{0xFF, 0xFF, 0xFF, 0xFF, 0}, Octets{0, 0, 0, 3, 'a', 0}}) {
    WireCursor broken(bad);
    EXPECT_TRUE(broken.text().empty());
    EXPECT_FALSE(broken.ok());
  }
}

TEST(BoundedDecode, TakesExactlyOneMessage) {
  expect_exact_size<mount_t>(octets_of(mount_t{}));
  expect_exact_size<process_health_t>(octets_of(health_with(2)));
  detections_t detections{};
  detections.num_detections = 1;
  detections.detections.resize(1);
  expect_exact_size<detections_t>(octets_of(detections));
  objects_t objects{};
  objects.num_objects = 1;
  objects.objects.resize(1);
  expect_exact_size<objects_t>(octets_of(objects));
  ground_plane_t plane{};
  plane.num_cues = 1;
  plane.cues.resize(1);
  expect_exact_size<ground_plane_t>(octets_of(plane));
}

TEST(BoundedDecode, RefusesASizeThatOnlyFitsWhenItIsCut) {
  const Octets bytes = octets_of(mount_t{});
  mount_t message;
  // Nothing is read: the size alone decides.
  const std::span<const std::uint8_t> endless(bytes.data(), bytes.size() + (std::size_t{1} << 32U));
  EXPECT_FALSE(decode_bounded(endless, &message));
}

TEST(BoundedDecode, LimitsDetections) {
  for (const std::int32_t extra : {0, 1}) {
    detections_t message{};
    message.num_detections = detections_t::MAX_DETECTIONS + extra;
    message.detections.resize(static_cast<std::size_t>(message.num_detections));
    EXPECT_EQ(extra == 0, is_accepted<detections_t>(octets_of(message)));
  }
  Octets none = octets_of(detections_t{});
  EXPECT_TRUE(is_accepted<detections_t>(none));
  set_i32(-1, 24, &none);
  EXPECT_FALSE(is_accepted<detections_t>(none));
}

TEST(BoundedDecode, LimitsObjects) {
  for (const std::int32_t extra : {0, 1}) {
    objects_t message{};
    message.num_objects = objects_t::MAX_OBJECTS + extra;
    message.objects.resize(static_cast<std::size_t>(message.num_objects));
    EXPECT_EQ(extra == 0, is_accepted<objects_t>(octets_of(message)));
  }
  Octets none = octets_of(objects_t{});
  EXPECT_TRUE(is_accepted<objects_t>(none));
  set_i32(-1, 32, &none);
  EXPECT_FALSE(is_accepted<objects_t>(none));
}

TEST(BoundedDecode, LimitsCues) {
  for (const int extra : {0, 1}) {
    ground_plane_t message{};
    message.num_cues = static_cast<std::int8_t>(ground_plane_t::MAX_CUES + extra);
    message.cues.resize(static_cast<std::size_t>(message.num_cues));
    EXPECT_EQ(extra == 0, is_accepted<ground_plane_t>(octets_of(message)));
  }
  EXPECT_TRUE(is_accepted<ground_plane_t>(octets_of(ground_plane_t{})));
}

TEST(BoundedDecode, LimitsStages) {
  EXPECT_TRUE(is_accepted<process_health_t>(octets_of(health_with(0))));
  EXPECT_TRUE(is_accepted<process_health_t>(octets_of(health_with(16))));
  EXPECT_FALSE(is_accepted<process_health_t>(octets_of(health_with(17))));
  Octets negative = octets_of(health_with(0));
  set_i32(-1, negative.size() - 4, &negative);
  EXPECT_FALSE(is_accepted<process_health_t>(negative));
}

TEST(BoundedDecode, RefusesTextsOfHealthThatDoNotEnd) {
  const Octets whole = octets_of(health_with(1));
  int num_texts = 0;
  for (std::size_t i = 20; i + 4 < whole.size(); ++i) {
    const std::int32_t length = i32_at(whole, i);
    if (length < 2 || length > 6 || i + 4 + static_cast<std::size_t>(length) > whole.size())
      continue;
    const std::size_t last = i + 3 + static_cast<std::size_t>(length);
    if (whole[last] != 0 || (whole[last - 1] < 'A' && whole[last - 1] != '1')) continue;
    Octets broken = whole;
    broken[last] = 'x';
    EXPECT_FALSE(is_accepted<process_health_t>(broken)) << "text at byte " << i;
    ++num_texts;
  }
  EXPECT_GE(num_texts, 3);
}

}  // namespace
}  // namespace plumb
