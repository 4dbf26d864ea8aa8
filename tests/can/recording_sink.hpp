/// Keeps what was sent and reads it back.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "modules/can/can_codec.hpp"

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

  /// Every frame of a message, decoded; a frame that does not decode fails the test.
  [[nodiscard]] std::vector<CanValues> all(const std::string& name) const {
    std::vector<CanValues> result;
    for (const Message& message : messages()) {
      if (message.name != name) continue;
      for (const Sent& s : sent) {
        if (s.frame.id != message.id) continue;
        CanValues values;
        EXPECT_TRUE(decode(message, s.frame, &values));
        result.push_back(values);
      }
    }
    return result;
  }
  /// All messages of the newest moment in one.
  [[nodiscard]] CanValues newest() const {
    CanValues values;
    for (const Message& message : messages()) {
      const std::vector<CanValues> list = all(message.name);
      if (list.empty()) continue;
      for (const Signal& signal : message.signals) {
        if (signal.value != nullptr) values.*signal.value = list.back().*signal.value;
      }
    }
    return values;
  }
};

}  // namespace plumb::test
