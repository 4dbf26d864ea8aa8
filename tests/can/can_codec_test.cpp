#include "modules/can/can_codec.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "core/numbers.hpp"
#include "modules/can/can_e2e.hpp"
#include "tests/can/reading.hpp"

namespace plumb {
namespace {

using test::default_messages;

MessageValues no_values() {
  MessageValues values;
  values.fill(kNotAvailable);
  return values;
}

bool has_value(const Signal& signal) { return source_of(signal) != CanSource::kFraming; }

/// Calls `check(message, number of the signal, its layout)` for every signal that carries a value.
template <typename Check>
void for_each_signal(Check check) {
  for (const Message& message : default_messages()) {
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      SCOPED_TRACE(message.signals[i].name);
      if (has_value(message.signals[i])) check(message, i, message.signals[i].layout);
    }
  }
}

/// Returns the raw value of a signal in a message that was encoded with `physical` in it.
std::uint64_t sent_raw(const Message& message, std::size_t i, double physical) {
  MessageValues values = no_values();
  values[i] = physical;
  const CanFrame frame = encode(message, values, {3, 0, 0});
  EXPECT_TRUE(e2e_check({frame.data.data(), frame.size}, message.address.data_id));
  return extract_raw(message.signals[i].layout, frame.data);
}

TEST(CanCodec, EverySignalIsExactAtItsMinimum) {
  for_each_signal([](const Message& message, std::size_t i, const SignalLayout& signal) {
    EXPECT_EQ(sent_raw(message, i, min_physical(signal)), 0U);
  });
}

TEST(CanCodec, EverySignalIsExactAtItsMaximum) {
  for_each_signal([](const Message& message, std::size_t i, const SignalLayout& signal) {
    EXPECT_EQ(sent_raw(message, i, max_physical(signal)), max_raw(signal));
    MessageValues back{};
    MessageValues values = no_values();
    values[i] = max_physical(signal);
    ASSERT_TRUE(decode(message, encode(message, values, {}), &back));
    EXPECT_EQ(back[i], max_physical(signal));
  });
}

/// What stands for "not available"; 0 where the signal has no such value.
std::uint64_t absent(const SignalLayout& signal) { return signal.has_sna ? sna_raw(signal) : 0; }

TEST(CanCodec, AValueBelowTheRangeIsNotAvailable) {
  for_each_signal([](const Message& message, std::size_t i, const SignalLayout& signal) {
    if (signal.beyond == Beyond::kWraps) return;
    for (const double below : {signal.factor, 1e3, 1e9, 1e300, kInf}) {
      EXPECT_EQ(sent_raw(message, i, min_physical(signal) - below), absent(signal)) << below;
    }
  });
}

TEST(CanCodec, AValueAboveTheRangeIsNotAvailableUnlessTheSignalStays) {
  int num_staying = 0;
  for_each_signal([&](const Message& message, std::size_t i, const SignalLayout& signal) {
    if (signal.beyond == Beyond::kWraps) return;
    const bool stays = signal.beyond == Beyond::kStays;
    num_staying += stays ? 1 : 0;
    for (const double above : {signal.factor, 1e3, 1e9, 1e300}) {
      EXPECT_EQ(sent_raw(message, i, max_physical(signal) + above),
                stays ? max_raw(signal) : absent(signal))
          << above;
    }
    EXPECT_EQ(sent_raw(message, i, kInf), absent(signal));
    const bool says_so =
        std::string(message.signals[i].comment).find("tays at") != std::string::npos;
    EXPECT_EQ(says_so, stays) << "the comment says that the value stays";
  });
  EXPECT_EQ(num_staying, 8);
}

TEST(CanCodec, APositionIsSentModuloAndKeepsItsDifferences) {
  int num_wrapping = 0;
  for_each_signal([&](const Message& message, std::size_t i, const SignalLayout& signal) {
    if (signal.beyond != Beyond::kWraps) return;
    ++num_wrapping;
    const std::string comment = message.signals[i].comment;
    EXPECT_NE(comment.find("Modulo " + std::to_string(static_cast<long>(signal.modulus)) + " m"),
              std::string::npos);
    for (const double m : {0.0, 12.5, 41'943.0, -41'944.0, 838'861.0, 1'000'000.0, 2.5e6, -3e6}) {
      const double sent = to_physical(signal, sent_raw(message, i, m));
      const double turns = (m - sent) / signal.modulus;
      EXPECT_NEAR(turns, std::round(turns), 0.51 * signal.factor / signal.modulus) << m;
    }
    EXPECT_EQ(sent_raw(message, i, signal.offset + signal.modulus - 0.1 * signal.factor), 0U);
    EXPECT_EQ(sent_raw(message, i, kInf), sna_raw(signal));
  });
  EXPECT_EQ(num_wrapping, 4);
}

TEST(CanCodec, NanIsSentAsAllOnesAndReadBackAsNan) {
  for_each_signal([](const Message& message, std::size_t i, const SignalLayout& signal) {
    const std::uint64_t raw = sent_raw(message, i, kNotAvailable);
    if (!signal.has_sna) {
      EXPECT_EQ(raw, 0U);
      return;
    }
    EXPECT_EQ(raw, (std::uint64_t{1} << static_cast<unsigned>(signal.length)) - 1);
    EXPECT_TRUE(std::isnan(to_physical(signal, raw)));
  });
}

TEST(CanCodec, TwoHundredAndSixtyDoesNotBecomeFour) {
  const SignalLayout byte{0, 8};
  EXPECT_EQ(to_raw(byte, 260.0), 255U);
  EXPECT_EQ(to_raw(byte, -1.0), 255U);
  EXPECT_EQ(to_raw(byte, -0.4), 0U) << "within half a step";
  EXPECT_EQ(to_raw(staying(byte), 260.0), 254U);
  EXPECT_EQ(to_raw(staying(byte), -1.0), 255U);
  EXPECT_FALSE(is_sendable(byte, 260.0));
  EXPECT_TRUE(is_sendable(byte, 254.0));
}

TEST(CanCodec, DecodedValuesAreWithinHalfAStepOfWhatWasEncoded) {
  std::mt19937_64 random(20);
  for_each_signal([&](const Message& message, std::size_t k, const SignalLayout& signal) {
    std::uniform_real_distribution<double> inside(min_physical(signal), max_physical(signal));
    for (int i = 0; i < 2000; ++i) {
      MessageValues values = no_values();
      values[k] = inside(random);
      const auto alive = static_cast<std::uint8_t>(i % kE2eCounterModulo);
      MessageValues back{};
      ASSERT_TRUE(decode(message, encode(message, values, {alive, 0, 0}), &back));
      ASSERT_LE(std::abs(back[k] - values[k]), 0.5001 * signal.factor);
    }
  });
}

TEST(CanCodec, SignalsDoNotDisturbEachOther) {
  for_each_signal([](const Message& message, std::size_t i, const SignalLayout& signal) {
    MessageValues values = no_values();  // all not available, one at its minimum
    values[i] = min_physical(signal);
    MessageValues back{};
    ASSERT_TRUE(decode(message, encode(message, values, {}), &back));
    for (std::size_t k = 0; k < message.signals.size(); ++k) {
      const Signal& other = message.signals[k];
      if (k == i || !has_value(other) || !other.layout.has_sna) continue;
      EXPECT_TRUE(std::isnan(back[k])) << "disturbs " << other.name;
    }
  });
}

TEST(CanCodec, ATableWhoseSignalsShareABitOrLeaveTheMessageDoesNotFit) {
  constexpr SignalValue kNone{Framing::kCrc};
  constexpr const char* kThree[] = {"a", "b", "c"};
  constexpr const char* kFour[] = {"a", "b", "c", "d"};
  static_assert(fit_message(
      std::array<Signal, 2>{{{"A", {0, 8}, "", kNone, ""}, {"B", {8, 8}, "", kNone, ""}}}));
  static_assert(!fit_message(
      std::array<Signal, 2>{{{"A", {0, 8}, "", kNone, ""}, {"B", {7, 8}, "", kNone, ""}}}));
  static_assert(!fit_message(std::array<Signal, 1>{{{"A", {57, 8}, "", kNone, ""}}}));
  static_assert(!fit_message(std::array<Signal, 1>{{{"A", {0, 33}, "", kNone, ""}}}));
  // All ones means "not available", so that two bits leave three values.
  static_assert(fit_message(std::array<Signal, 1>{{{"A", {0, 2}, "", kNone, "", kThree}}}));
  static_assert(!fit_message(std::array<Signal, 1>{{{"A", {0, 2}, "", kNone, "", kFour}}}));
}

TEST(CanCodec, ZeroIsExactForEverySignalThatHasIt) {
  for_each_signal([](const Message& /*message*/, std::size_t /*i*/, const SignalLayout& signal) {
    if (min_physical(signal) > 0.0) return;
    EXPECT_NEAR(to_physical(signal, to_raw(signal, 0.0)), 0.0, 1e-9 * signal.factor);
  });
}

TEST(CanCodec, AFrameOfAnotherIdSizeOrKindIsRefused) {
  const Message& message = default_messages()[0];
  const CanFrame good = encode(message, no_values(), {});
  MessageValues values = no_values();
  ASSERT_TRUE(decode(message, good, &values));

  CanFrame bad = good;
  bad.id = default_messages()[1].address.id;
  EXPECT_FALSE(decode(message, bad, &values));
  bad = good;
  bad.size = 7;
  EXPECT_FALSE(decode(message, bad, &values));
  bad = good;
  bad.extended = true;
  EXPECT_FALSE(decode(message, bad, &values));
  bad = good;
  bad.fd = true;
  EXPECT_FALSE(decode(message, bad, &values));
}

TEST(CanCodec, ACorruptFrameLeavesTheValuesAlone) {
  CanFrame frame = encode(default_messages()[0], no_values(), {});
  frame.data[5] ^= 0x10U;
  MessageValues values = no_values();
  values[5] = 12.0;
  EXPECT_FALSE(decode(default_messages()[0], frame, &values));
  EXPECT_EQ(values[5], 12.0);
}

TEST(CanCodec, IntelSignalsFillBytesFromTheLeastSignificantBit) {
  const SignalLayout signal{12, 12};
  std::array<std::uint8_t, 8> data{};
  insert_raw(signal, 0xABC, data);
  EXPECT_EQ(data, (std::array<std::uint8_t, 8>{0x00, 0xC0, 0xAB}));
  EXPECT_EQ(extract_raw(signal, data), 0xABCU);
}

TEST(CanCodec, MotorolaSignalsFillBytesFromTheMostSignificantBit) {
  // A DBC's "3|12@0": bits 3..0 of byte 0, then all of byte 1.
  const SignalLayout signal{3, 12, 1.0, 0.0, true, ByteOrder::kMotorola};
  std::array<std::uint8_t, 8> data{};
  insert_raw(signal, 0xABC, data);
  EXPECT_EQ(data, (std::array<std::uint8_t, 8>{0x0A, 0xBC}));
  EXPECT_EQ(extract_raw(signal, data), 0xABCU);
}

TEST(CanCodec, InsertingClearsWhatWasThere) {
  const SignalLayout signal{4, 8};
  std::array<std::uint8_t, 8> data{};
  data.fill(0xFF);
  insert_raw(signal, 0, data);
  EXPECT_EQ(data[0], 0x0F);
  EXPECT_EQ(data[1], 0xF0);
  EXPECT_EQ(data[2], 0xFF);
}

}  // namespace
}  // namespace plumb
