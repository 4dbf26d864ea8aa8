#include "modules/can/can_codec.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <cmath>
#include <random>
#include <string>

#include "core/numbers.hpp"
#include "modules/can/can_e2e.hpp"

namespace plumb {
namespace {

/// Calls `check(message, signal)` for every signal that carries a value.
template <typename Check>
void for_each_signal(Check check) {
  for (const Message& message : messages()) {
    for (const Signal& signal : message.signals) {
      SCOPED_TRACE(signal.name);
      if (signal.value != nullptr) check(message, signal);
    }
  }
}

/// Raw value of `signal` after the whole message was encoded with `physical` in it.
std::uint64_t sent_raw(const Message& message, const Signal& signal, double physical) {
  CanValues values;
  values.*signal.value = physical;
  const CanFrame frame = encode(message, values, 3);
  EXPECT_TRUE(e2e_check({frame.data.data(), frame.size}, message.data_id));
  return extract_raw(signal, frame.data);
}

TEST(CanCodec, EverySignalIsExactAtItsMinimum) {
  for_each_signal([](const Message& message, const Signal& signal) {
    EXPECT_EQ(sent_raw(message, signal, min_physical(signal)), 0U);
  });
}

TEST(CanCodec, EverySignalIsExactAtItsMaximum) {
  for_each_signal([](const Message& message, const Signal& signal) {
    EXPECT_EQ(sent_raw(message, signal, max_physical(signal)), max_raw(signal));
    CanValues back;
    CanValues values;
    values.*signal.value = max_physical(signal);
    ASSERT_TRUE(decode(message, encode(message, values, 0), &back));
    EXPECT_EQ(back.*signal.value, max_physical(signal));
  });
}

TEST(CanCodec, EverySignalSaturatesBelowItsMinimum) {
  for_each_signal([](const Message& message, const Signal& signal) {
    for (const double below : {signal.factor, 1e3, 1e9, 1e300, kInf}) {
      EXPECT_EQ(sent_raw(message, signal, min_physical(signal) - below), 0U) << below;
    }
  });
}

TEST(CanCodec, EverySignalSaturatesAboveItsMaximumAndNeverReachesNotAvailable) {
  for_each_signal([](const Message& message, const Signal& signal) {
    for (const double above : {signal.factor, 1e3, 1e9, 1e300, kInf}) {
      EXPECT_EQ(sent_raw(message, signal, max_physical(signal) + above), max_raw(signal)) << above;
    }
  });
}

TEST(CanCodec, NanIsSentAsAllOnesAndReadBackAsNan) {
  for_each_signal([](const Message& message, const Signal& signal) {
    const std::uint64_t raw = sent_raw(message, signal, kNotAvailable);
    if (!signal.has_sna) {
      EXPECT_EQ(raw, 0U);
      return;
    }
    EXPECT_EQ(raw, (std::uint64_t{1} << static_cast<unsigned>(signal.length)) - 1);
    EXPECT_TRUE(std::isnan(to_physical(signal, raw)));
  });
}

TEST(CanCodec, TwoHundredAndSixtyDoesNotBecomeFour) {
  const Signal byte{"Byte", 0, 8, 1.0, 0.0, nullptr};
  EXPECT_EQ(to_raw(byte, 260.0), 254U);
  EXPECT_EQ(to_raw(byte, -1.0), 0U);
}

TEST(CanCodec, DecodedValuesAreWithinHalfAStepOfWhatWasEncoded) {
  std::mt19937_64 random(20);
  for_each_signal([&](const Message& message, const Signal& signal) {
    std::uniform_real_distribution<double> inside(min_physical(signal), max_physical(signal));
    for (int i = 0; i < 2000; ++i) {
      CanValues values;
      values.*signal.value = inside(random);
      const auto alive = static_cast<std::uint8_t>(i % kE2eCounterModulo);
      CanValues back;
      ASSERT_TRUE(decode(message, encode(message, values, alive), &back));
      ASSERT_LE(std::abs(back.*signal.value - values.*signal.value), 0.5001 * signal.factor);
    }
  });
}

TEST(CanCodec, SignalsDoNotDisturbEachOther) {
  for (const Message& message : messages()) {
    for (const Signal& one : message.signals) {
      if (one.value == nullptr) continue;
      CanValues values;  // all not available, one at its minimum
      values.*one.value = min_physical(one);
      CanValues back;
      ASSERT_TRUE(decode(message, encode(message, values, 0), &back));
      for (const Signal& other : message.signals) {
        if (other.value == nullptr || other.value == one.value || !other.has_sna) continue;
        EXPECT_TRUE(std::isnan(back.*other.value)) << one.name << " disturbs " << other.name;
      }
    }
  }
}

TEST(CanCodec, SignalsOfAMessageShareNoBitAndStayInside) {
  for (const Message& message : messages()) {
    std::bitset<8 * kMessageBytes> taken;
    for (const Signal& signal : message.signals) {
      ASSERT_GE(signal.start_bit, 0);
      ASSERT_LE(signal.start_bit + signal.length, static_cast<int>(taken.size())) << signal.name;
      for (int bit = 0; bit < signal.length; ++bit) {
        const auto at = static_cast<std::size_t>(signal.start_bit + bit);
        EXPECT_FALSE(taken.test(at)) << signal.name << " bit " << at;
        taken.set(at);
      }
    }
  }
}

TEST(CanCodec, ZeroIsExactForEverySignalThatHasIt) {
  for_each_signal([](const Message& /*message*/, const Signal& signal) {
    if (min_physical(signal) > 0.0) return;
    EXPECT_NEAR(to_physical(signal, to_raw(signal, 0.0)), 0.0, 1e-9 * signal.factor);
  });
}

TEST(CanCodec, AFrameOfAnotherIdSizeOrKindIsRefused) {
  const Message& message = messages()[0];
  const CanFrame good = encode(message, CanValues{}, 0);
  CanValues values;
  ASSERT_TRUE(decode(message, good, &values));

  CanFrame bad = good;
  bad.id = messages()[1].id;
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
  CanFrame frame = encode(messages()[0], CanValues{}, 0);
  frame.data[5] ^= 0x10U;
  CanValues values;
  values.speed_m_s = 12.0;
  EXPECT_FALSE(decode(messages()[0], frame, &values));
  EXPECT_EQ(values.speed_m_s, 12.0);
}

TEST(CanCodec, IntelSignalsFillBytesFromTheLeastSignificantBit) {
  const Signal signal{"Intel", 12, 12, 1.0, 0.0, nullptr};
  std::array<std::uint8_t, 8> data{};
  insert_raw(signal, 0xABC, data);
  EXPECT_EQ(data, (std::array<std::uint8_t, 8>{0x00, 0xC0, 0xAB}));
  EXPECT_EQ(extract_raw(signal, data), 0xABCU);
}

TEST(CanCodec, MotorolaSignalsFillBytesFromTheMostSignificantBit) {
  // A DBC's "3|12@0": bits 3..0 of byte 0, then all of byte 1.
  const Signal signal{"Motorola", 3, 12, 1.0, 0.0, nullptr, true, ByteOrder::kMotorola};
  std::array<std::uint8_t, 8> data{};
  insert_raw(signal, 0xABC, data);
  EXPECT_EQ(data, (std::array<std::uint8_t, 8>{0x0A, 0xBC}));
  EXPECT_EQ(extract_raw(signal, data), 0xABCU);
}

TEST(CanCodec, InsertingClearsWhatWasThere) {
  const Signal signal{"Intel", 4, 8, 1.0, 0.0, nullptr};
  std::array<std::uint8_t, 8> data{};
  data.fill(0xFF);
  insert_raw(signal, 0, data);
  EXPECT_EQ(data[0], 0x0F);
  EXPECT_EQ(data[1], 0xF0);
  EXPECT_EQ(data[2], 0xFF);
}

}  // namespace
}  // namespace plumb
