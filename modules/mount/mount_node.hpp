/// Everything plumb-ground does about the mount between the chain's results and MOUNT: the check, its message once a
/// second, its file and its word in the process's health.
#pragma once

#include <cstdint>
#include <string>

#include "modules/mount/mount_check.hpp"
#include "modules/mount/mount_config.hpp"
#include "modules/mount/mount_wire.hpp"

namespace plumb {

class MountNode {
 public:
  static constexpr std::int64_t kPeriod_us = 1'000'000;

  /// Goes on from the state file where there is a sound one. A damaged file is said on stderr and replaced: the
  /// vehicle drives on without it.
  explicit MountNode(const MountConfig& config);

  /// One result of the chain. The message to publish, once a second and when the status changes; else null.
  const mount_t* update(const GroundOutput& ground);
  [[nodiscard]] const MountReport& report() const { return check_.report(); }
  /// Why the process is degraded, by the angles of the newest message; null while the camera has not moved.
  [[nodiscard]] const char* alarm() const;

 private:
  void save() const;
  void write_alarm();

  std::string state_file_;
  MountCheck check_;
  mount_t message_{};
  std::int64_t published_us_ = 0;
  char alarm_[128] = "";
};

}  // namespace plumb
