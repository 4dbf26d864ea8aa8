/// Everything that plumb-ground does about the mount: the check of the orientation, the height that
/// the vehicle's speed gives, the message MOUNT, the state file and the sentence in the health of
/// the process.
#pragma once

#include <cstdint>
#include <string>

#include "modules/integrity/one_sender.hpp"
#include "modules/mount/height_learner.hpp"
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

  /// Returns null when the message was taken, else why it was refused.
  [[nodiscard]] const char* take_speed(const vehicle_speed_t& message);
  /// Takes one ground result, the height of the camera that is stated, and the camera's number
  /// (GroundNode::num_cameras): another one makes void what was learned of the height. Returns the
  /// message to publish, once a second and when a status changes, and else null.
  const mount_t* update(const GroundOutput& ground, const CameraHeight& stated_height, int camera);
  [[nodiscard]] const MountReport& report() const { return check_.report(); }
  [[nodiscard]] const HeightReport& height_report() const { return height_.report(); }
  /// The height to use from the next image on; null while it is the stated one.
  [[nodiscard]] const CameraHeight* better_height() const;
  /// The reason why the process is degraded, with the angles of the newest message. Null while the
  /// camera sits as it should.
  [[nodiscard]] const char* alarm() const;

 private:
  void save() const;
  void write_alarm(const CameraHeight& stated_height);

  std::string state_file_;
  MountCheck check_;
  HeightLearner height_;
  int camera_ = 0;  ///< whose height is learned
  OneSender speed_sender_;
  mount_t message_{};
  std::int64_t published_us_ = 0;
  char alarm_[160] = "";
};

}  // namespace plumb
