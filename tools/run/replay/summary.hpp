/// The summary that plumb-replay prints at the end: statuses, mount and times.
#pragma once

#include <map>
#include <string>

#include "modules/chain/chain.hpp"
#include "platform/stage_timer.hpp"

namespace plumb {

class StatusCount {
 public:
  void add(const FrameRecord& record);
  /// Lines such as "vo     370 ok, 6 initializing, 1 standstill" for vo, plane and ego.
  [[nodiscard]] std::string text() const;

 private:
  std::map<int, int> vo_;
  std::map<int, int> plane_;
  std::map<int, int> ego_;
  int num_refused_ = 0;
};

/// The result of the mount check in one line.
[[nodiscard]] std::string mount_text(const MountReport& report);
/// What the vehicle's speed says about the camera's height, in one line; empty without a speed.
[[nodiscard]] std::string height_text(const HeightReport& report);

/// Table of the stages of `program`: frames, median, 99th percentile and maximum in milliseconds.
[[nodiscard]] std::string stage_table(const std::string& program, const StageTimer& timer);

}  // namespace plumb
