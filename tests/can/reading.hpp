/// Reads frames back, as values by the names of signals.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>

#include "modules/can/can_codec.hpp"
#include "modules/can/can_gate.hpp"
#include "modules/can/signals/signal_tables.hpp"

namespace plumb::test {

/// The messages of the default configuration.
inline const Messages& default_messages() {
  static const Messages kMessages = can_messages(CanConfig{});
  return kMessages;
}

inline const Message& message_named(const std::string& name) {
  for (const Message& message : default_messages()) {
    if (message.row->name == name) return message;
  }
  throw std::logic_error("no message " + name);
}

/// The value of a signal in a sample; NaN for "not available".
inline double value_of(const CanSample& sample, const std::string& signal) {
  for (const Message& message : default_messages()) {
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      if (message.signals[i].name == signal) return sample.values[message.slot[i]];
    }
  }
  throw std::logic_error("no signal " + signal);
}

/// Values by signal; NaN for "not available", and for a signal that was not read yet.
class Reading {
 public:
  double operator[](const std::string& signal) const {
    const auto found = values_.find(signal);
    if (found != values_.end()) return found->second;
    for (const Message& message : default_messages()) {
      for (const Signal& row : message.signals) {
        if (row.name == signal) return kNotAvailable;
      }
    }
    throw std::logic_error("no signal " + signal);
  }
  /// The message's own frame counter and validity, whatever its signals are called.
  [[nodiscard]] double frame_counter() const { return ending_with("_FrameCtr"); }
  [[nodiscard]] double validity() const { return ending_with("_Validity"); }

  /// Reads the values of a frame. Returns false when the frame is not one of this message's.
  bool read(const Message& message, const CanFrame& frame) {
    MessageValues values;
    if (!decode(message, frame, &values)) return false;
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      values_[message.signals[i].name] = values[i];
    }
    return true;
  }
  void merge(const Reading& newer) {
    for (const auto& [name, value] : newer.values_) values_[name] = value;
  }

 private:
  [[nodiscard]] double ending_with(const std::string& end) const {
    for (const auto& [name, value] : values_) {
      if (name.size() > end.size() && name.substr(name.size() - end.size()) == end) return value;
    }
    throw std::logic_error("no signal with " + end);
  }
  std::map<std::string, double> values_;
};

}  // namespace plumb::test
