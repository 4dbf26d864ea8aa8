/// Watches VO's speed for jumps that no vehicle makes: then VO has lost its unit, or its pose,
/// without saying so.
///
/// After a gap, VO may find the old map's points at wrong places. It then reports a motion with
/// small residuals that is several times too long, and while it recovers its unit changes. Between
/// the last sound speed and this one the vehicle can have changed its speed by so much only. If
/// VO's speed changed by more, nothing is known of the unit any more, and the steps that follow
/// mean nothing until they are steady. After a long gap, the vehicle can have changed its speed by
/// much; then the next step has to confirm the one that crosses the gap.
///
/// Units:
///   Speeds in [vo]/s; the scale in metres per [vo].
/// Memory:
///   in place.
#pragma once

#include <cstdint>

#include "modules/ground/types/ego_config.hpp"
#include "modules/vo/vo.hpp"

namespace plumb {

enum class UnitVerdict {
  kSteady,     ///< nothing contradicts the unit
  kUnproven,   ///< the step crosses a gap, and no step has confirmed it yet
  kJump,       ///< with this image the unit was lost
  kUnsettled,  ///< the unit was lost, and the speeds are not steady yet
};

class UnitWatch {
 public:
  explicit UnitWatch(const EgoConfig& config = {}) : config_(config) {}

  /// Takes one result of VO. `metres_per_vo` is the scale so far, and 0 while it is not known.
  UnitVerdict watch(const VoOutput& vo, double metres_per_vo);

 private:
  /// A speed at a time.
  struct Speed {
    bool known = false;
    std::int64_t capture_us = 0;
    double vo_s = 0.0;
    double std_vo_s = 0.0;
  };

  [[nodiscard]] static double seconds_between(const Speed& before, const Speed& now);
  [[nodiscard]] bool follows(const Speed& before, const Speed& now, double num_std) const;
  UnitVerdict compare(const VoOutput& vo, const Speed& now);
  UnitVerdict settle(const Speed& now);

  EgoConfig config_;
  double metres_per_vo_ = 0.0;  ///< last known, also while the unit is lost: its order of magnitude
  Speed sound_;                 ///< newest speed that followed from those before
  Speed last_;                  ///< newest speed
  bool unsettled_ = false;
  bool unproven_ = false;  ///< last_ crossed a gap
  int num_steady_ = 0;
};

}  // namespace plumb
