/// Everything that plumb-ground does about the mount: the check, its message MOUNT, its state file
/// and its sentence in the health of the process.
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

  /// Continues with the reference of the state file when it has a valid one. A damaged file is
  /// logged, and the next reference replaces it: the vehicle can drive without it.
  explicit MountNode(const MountConfig& config);

  /// Takes one ground result. Returns the message to publish, once a second and when the status
  /// changes, and else null.
  const mount_t* update(const GroundOutput& ground);
  [[nodiscard]] const MountReport& report() const { return check_.report(); }
  /// The reason why the process is degraded, with the angles of the newest message. Null while the
  /// camera sits as it should.
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
