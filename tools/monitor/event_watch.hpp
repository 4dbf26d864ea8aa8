/// Turns the messages of the chain into the events that somebody who watches it wants to know of:
/// resets, faults and alarms, by the changes of status, reason, health and counters.
///
/// Memory:
///   The last message of each kind, and nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "plumb/mount_t.hpp"
#include "plumb/process_health_t.hpp"
#include "plumb/vo_motion_t.hpp"

namespace plumb {

enum class EventLevel : std::uint8_t { kInfo, kWarning, kAlarm };
inline constexpr std::array<const char*, 3> kEventLevelNames = {"info", "warning", "alarm"};

/// Where health reports come from: the processes of the chain, in the order of the data flow.
inline constexpr std::array<const char*, 6> kChainProcesses = {"camera", "detect",  "vo",
                                                               "ground", "objects", "can"};
/// The place of a process in kChainProcesses, or -1.
[[nodiscard]] int chain_process(const std::string& name);

class EventWatch {
 public:
  using Sink = std::function<void(EventLevel, const char* source, const std::string& text)>;
  explicit EventWatch(Sink sink) : sink_(std::move(sink)) {}

  void take(const vo_motion_t& message);
  void take(const ground_plane_t& message);
  void take(const ego_motion_t& message);
  void take(const mount_t& message);
  /// A report that arrived at `now_us` of any clock that does not step.
  void take(const process_health_t& message, std::int64_t now_us);
  /// Frames on CAN that a receiver would refuse or miss, counted from the start.
  void take_can_faults(std::int64_t num_faults, std::int64_t now_us);
  /// Notices processes that fell silent.
  void check_silence(std::int64_t now_us);

 private:
  struct Status {
    int status = -1;
    int reason = 0;
  };
  struct Health {
    std::int64_t time_us = 0;
    bool silent = false;
    int state = -1;
    std::string reason;
    std::int64_t num_bad = 0;
  };
  using NameOf = const char* (*)(int);
  void follow(const char* source, int status, int reason, EventLevel level, NameOf status_name,
              NameOf reason_name, Status* last);
  void follow_session(const char* source, std::int64_t session, std::int64_t* last);
  void tell_losses(const process_health_t& message, const char* process, Health* last);

  Sink sink_;
  Status vo_, plane_, ego_, mount_;
  std::int64_t vo_session_ = -1;
  std::int64_t ground_session_ = -1;
  int scale_epoch_ = -1;
  int reset_counter_ = -1;
  std::array<Health, kChainProcesses.size()> health_;
  std::int64_t num_can_faults_ = 0;
  std::int64_t can_told_us_ = INT64_MIN;
};

}  // namespace plumb
