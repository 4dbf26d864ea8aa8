/// The state of one process, and the process_health_t that tells it.
///
/// Memory   the message is built in place; its texts and stages keep the room they get at
/// construction.
#pragma once

#include <cstdint>
#include <string>

#include "core/counters.hpp"
#include "platform/bus.hpp"
#include "platform/stage_timer.hpp"
#include "plumb/process_health_t.hpp"

namespace plumb {

/// Same numbers as process_health_t.state.
enum class HealthState : std::int8_t { kRunning = 0, kWaiting = 1, kDegraded = 2, kStopping = 3 };

class Health {
 public:
  /// [bytes] largest encoding: texts are cut to kMaxText.
  static constexpr std::size_t kMaxBytes = 4096;
  static constexpr std::size_t kMaxText = 160;

  explicit Health(const char* process);

  /// What only the process itself knows ("no calibration yet"); holds until clear_condition().
  void set_condition(HealthState state, const char* reason);
  void clear_condition() { condition_ = HealthState::kRunning; }

  /// The message now. Without a condition the process is degraded for a second after it rejected,
  /// lost, missed a deadline or failed to send, and waiting while a periodic input is silent.
  const process_health_t& report(std::int64_t now_us, const Counters& counters, const Bus& bus,
                                 const StageTimer& timer);
  /// The last message: stopping.
  const process_health_t& report_stopping(std::int64_t now_us, const char* reason);

 private:
  void set_state(HealthState state, const char* reason);
  void judge(std::int64_t now_us, const Counters& counters, const Bus& bus);
  bool judge_counters(std::int64_t now_us, const Counters& counters);
  void copy_stages(const StageTimer& timer);

  process_health_t message_{};
  HealthState condition_ = HealthState::kRunning;
  std::string condition_reason_;
  Counters before_;
  std::string trouble_;
  std::int64_t trouble_until_us_ = 0;
};

}  // namespace plumb
