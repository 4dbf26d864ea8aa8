/// EGO_MOTION and GROUND_PLANE with a judgement: which of their values a road vehicle can have.
///
/// The messages say what was measured; this says what of it may be sent. A value that is refused
/// becomes NaN in the copy, and the signals read the copy.
///
/// Interval:
///   Between two messages of one session it is the difference of their image times. Where that is
///   no interval of a camera, it is the difference of the capture times on this machine's clock,
///   which another session has in common.
/// Missing messages:
///   A step over a gap in the numbers is not compared with speed and distance: the message states
///   the motion since the image before, which was not received.
/// Memory:
///   Copies of the newest messages.
#pragma once

#include <cstdint>

#include "modules/can/can_sample.hpp"
#include "modules/integrity/plausibility.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"

namespace plumb {

struct JudgedMotion : ego_motion_t {
  GroupValidities validity{};
  PlausibilityVerdict verdict;
  /// Counts the losses of continuity of the pose over the sessions of plumb-ground.
  std::uint32_t reset_count = 0;
};

struct JudgedPlane : ground_plane_t {
  GroupValidities validity{};
  PlausibilityVerdict verdict;
};

/// Copies the message and takes its status at its word.
void take_at_its_word(const ego_motion_t& message, JudgedMotion* judged);
void take_at_its_word(const ground_plane_t& message, JudgedPlane* judged);

/// Times and number of the message before.
class MessageInterval {
 public:
  /// Returns the time [s] since the message before; NaN when it is not known.
  double step(std::int64_t session, std::int64_t seq, std::int64_t utime,
              std::int64_t capture_mono_us, const PlausibilityConfig& config);
  /// Whether the newest message followed the one before in the same session, without a gap.
  [[nodiscard]] bool is_next() const { return is_next_; }
  [[nodiscard]] bool is_new_session() const { return is_new_session_; }

 private:
  bool has_last_ = false;
  std::int64_t session_ = 0;
  std::int64_t seq_ = 0;
  std::int64_t utime_ = 0;
  std::int64_t capture_mono_us_ = 0;
  bool is_next_ = false;
  bool is_new_session_ = true;
};

class MotionJudge {
 public:
  explicit MotionJudge(const PlausibilityConfig& config) : config_(config), check_(config) {}

  /// The result is valid until the next call. @pre fault_of(message) is null
  const JudgedMotion& judge(const ego_motion_t& message);
  /// Where the count of resets begins.
  void set_first_reset(std::uint32_t count) { reset_count_ = count; }
  /// Messages of which a value was refused.
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }
  /// Why the newest value was refused; kNone before the first.
  [[nodiscard]] PlausibilityReason last_reason() const { return last_reason_; }

 private:
  [[nodiscard]] VehicleMotion motion_of(const ego_motion_t& message);
  void count_resets(const ego_motion_t& message);
  void apply();

  PlausibilityConfig config_;
  Plausibility check_;
  MessageInterval interval_;
  JudgedMotion judged_;
  bool has_pose_ = false;
  std::int32_t reset_counter_ = 0;  ///< of the message before
  std::uint32_t reset_count_ = 0;
  std::int64_t num_refused_ = 0;
  PlausibilityReason last_reason_ = PlausibilityReason::kNone;
};

class PlaneJudge {
 public:
  explicit PlaneJudge(const PlausibilityConfig& config);

  /// As MotionJudge::judge().
  const JudgedPlane& judge(const ground_plane_t& message);
  [[nodiscard]] std::int64_t num_refused() const { return num_refused_; }
  [[nodiscard]] PlausibilityReason last_reason() const { return last_reason_; }

 private:
  PlausibilityConfig config_;
  Plausibility check_;
  MessageInterval interval_;
  JudgedPlane judged_;
  std::int64_t num_refused_ = 0;
  PlausibilityReason last_reason_ = PlausibilityReason::kNone;
};

}  // namespace plumb
