/// The state of one process and the process_health_t that reports it.
///
/// Memory:
///   The message is built in place. Its texts and stages keep the
///   capacity that they get at construction.
#pragma once

#include <cstdint>
#include <string>

#include "core/counters.hpp"
#include "platform/bus.hpp"
#include "platform/stage_timer.hpp"
#include "plumb/process_health_t.hpp"

namespace plumb {

/// The numbers are those of process_health_t.state.
enum class HealthState : std::int8_t { kRunning = 0, kWaiting = 1, kDegraded = 2, kStopping = 3 };

class Health {
 public:
  /// [bytes] The largest encoding. Longer texts are cut to kMaxText.
  static constexpr std::size_t kMaxBytes = 4096;
  static constexpr std::size_t kMaxText = 160;

  explicit Health(const char* process);

  /// Whether a degraded process still owes its output (OutputWatch). One whose device or bus is
  /// gone does not: to start it anew would not help.
  enum class Output : std::uint8_t { kDue, kExcused };

  /// Sets a state that only the process itself knows, such as "no calibration yet". It stays until
  /// clear_condition().
  void set_condition(HealthState state, const char* reason, Output output = Output::kDue);
  void clear_condition() { condition_ = HealthState::kRunning; }
  /// Is it waiting, or without what it needs for its output?
  [[nodiscard]] bool is_output_excused() const {
    return condition_ == HealthState::kWaiting ||
           (condition_ != HealthState::kRunning && output_ == Output::kExcused);
  }

  /// Builds the message. Without a condition the process is waiting while no message arrives
  /// on a periodic input, and else degraded for a second after it rejected, lost, skipped or missed
  /// a message, was late or failed to send.
  const process_health_t& report(std::int64_t now_us, const Counters& counters, const Bus& bus,
                                 const StageTimer& timer);
  /// Builds the last message, whose state is stopping.
  const process_health_t& report_stopping(std::int64_t now_us, const char* reason);

 private:
  void set_state(HealthState state, const char* reason);
  void judge(std::int64_t now_us, const Counters& counters, const Bus& bus);
  bool judge_counters(std::int64_t now_us, const Counters& counters);
  void copy_stages(const StageTimer& timer);

  process_health_t message_{};
  HealthState condition_ = HealthState::kRunning;
  Output output_ = Output::kDue;  ///< of the condition
  std::string condition_reason_;
  Counters before_;
  std::string trouble_;
  std::int64_t trouble_until_us_ = 0;
};

}  // namespace plumb
