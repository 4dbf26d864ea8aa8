/// What a receiver on the bus would make of the frames of plumb-can: the newest frame of each
/// message, decoded by the table of signals, with its age and the state of its E2E protection.
///
/// Memory:
///   One place per message, or per message and object; nothing grows with the frames.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "core/can_frame.hpp"
#include "modules/can/can_config.hpp"
#include "modules/can/can_signal.hpp"

namespace plumb {

class CanView {
 public:
  /// Throws InputError for addresses that do not fit together, see can_addresses().
  explicit CanView(const CanConfig& config);

  /// Takes a frame that was seen at `now_us`. Frames with other identifiers are counted.
  void take(const CanFrame& frame, std::int64_t now_us);

  /// What does not change: names, identifiers, cycles and signals of all messages.
  [[nodiscard]] nlohmann::json schema() const;
  /// The newest frames. Ages are in milliseconds before `now_us`; a value that is not available is
  /// null. Messages that never came are left out, and so are objects that no frame has named for
  /// longer than kObjectAgeUs.
  [[nodiscard]] nlohmann::json values(std::int64_t now_us) const;

  /// Whether the burst of the camera frame with this number is complete.
  [[nodiscard]] bool has_burst(std::int64_t seq) const;
  /// Whether bursts have come within the last second.
  [[nodiscard]] bool has_bursts(std::int64_t now_us) const;

  /// Failures of the CRC, lost and repeated frames, of all messages.
  [[nodiscard]] std::int64_t num_faults() const { return num_faults_; }
  [[nodiscard]] std::int64_t num_frames() const { return num_frames_; }

  static constexpr std::int64_t kObjectAgeUs = 1'000'000;

 private:
  static constexpr std::size_t kBurstEnd = message_index("Frame");  ///< the last of a burst

  enum class E2e : std::uint8_t { kOk, kFirst, kLost, kRepeated, kWrong };
  struct Slot {
    std::int64_t time_us = 0;  ///< of the newest frame that passed the check; 0: none
    std::int64_t num_frames = 0;
    std::int64_t num_wrong = 0;  ///< that failed the check
    std::int64_t num_lost = 0;   ///< by the alive counter
    std::int64_t num_repeated = 0;
    E2e state = E2e::kFirst;
    int alive = -1;
    MessageValues values{};
  };
  struct ObjectSlot {
    std::int64_t time_us = 0;
    MessageValues values{};
  };

  void follow_counter(int alive, Slot* slot);
  [[nodiscard]] nlohmann::json values_of(std::size_t message, const MessageValues& values) const;
  [[nodiscard]] nlohmann::json message_values(std::size_t message, std::int64_t now_us) const;

  Messages messages_;
  std::size_t burst_counter_;  ///< the signal of kBurstEnd that counts camera frames
  std::array<Slot, kNumMessages> slots_{};
  std::array<std::array<ObjectSlot, kMaxCanObjects>, kNumMessages> objects_{};
  std::int64_t num_frames_ = 0;
  std::int64_t num_foreign_ = 0;
  std::int64_t num_faults_ = 0;
};

}  // namespace plumb
