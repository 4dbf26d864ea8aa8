/// Keeps the frames that were sent and reads them back.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/can/reading.hpp"

namespace plumb::test {

struct Sent {
  std::int64_t time_us;
  CanFrame frame;
};

class RecordingSink final : public CanSink {
 public:
  std::vector<Sent> sent;

  void send(std::int64_t time_us, const CanFrame& frame) override {
    sent.push_back({time_us, frame});
  }

  /// Every frame of a message; a frame that does not decode fails the test.
  [[nodiscard]] std::vector<Reading> all(const std::string& name) const {
    const Message& message = message_named(name);
    std::vector<Reading> result;
    for (const Sent& s : sent) {
      if (s.frame.id != message.address.id) continue;
      Reading reading;
      EXPECT_TRUE(reading.read(message, s.frame));
      result.push_back(reading);
    }
    return result;
  }
  /// The newest frame of every message, merged into one reading.
  [[nodiscard]] Reading newest() const {
    Reading result;
    for (const Message& message : default_messages()) {
      const std::vector<Reading> list = all(message.row->name);
      if (!list.empty()) result.merge(list.back());
    }
    return result;
  }
};

}  // namespace plumb::test
