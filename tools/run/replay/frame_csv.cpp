#include "tools/run/replay/frame_csv.hpp"

#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"
#include "modules/ground/types/cue_table.hpp"
#include "modules/ground/types/ground_types.hpp"
#include "tools/run/replay/csv_row.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

void add_vo(const vo_motion_t& vo, bool holds, CsvRow* row) {
  row->add("vo_status", holds ? vo_status_name(vo.status) : "");
  row->add("vo_reason", holds ? vo_reason_name(vo.reason) : "");
  row->add("scale_epoch", static_cast<std::int64_t>(vo.scale_epoch));
  row->add("num_tracked", static_cast<std::int64_t>(vo.num_tracked));
  row->add("num_inliers", static_cast<std::int64_t>(vo.num_inliers));
  row->add("num_new", static_cast<std::int64_t>(vo.num_new));
  row->add("is_keyframe", static_cast<std::int64_t>(vo.is_keyframe));
  row->add("num_road_points", static_cast<std::int64_t>(vo.num_road_points));
  row->add("median_flow_px", static_cast<double>(vo.median_flow_px), holds);
  row->add("median_parallax_px", static_cast<double>(vo.median_parallax_px), holds);
  row->add("rms_residual_px", static_cast<double>(vo.rms_residual_px), holds);
  row->add("attached_share", static_cast<double>(vo.attached_share), holds);
  const char* axes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) row->add(format("vo_t_%s", axes[i]), vo.t_prev_cam[i], holds);
}

// Cues whose columns stand among those of the plane. Columns never move, so those of other cues
// follow at the end of the row.
constexpr std::size_t kNumFirstCues = 3;

bool plane_is_valid(const ground_plane_t& plane, bool answered) {
  return answered &&
         (plane.status == ground_plane_t::STATUS_OK || plane.status == ground_plane_t::STATUS_HELD);
}

const ground_cue_t& cue_of(const ground_plane_t& plane, std::size_t i) {
  static const ground_cue_t kNoCue = [] {
    ground_cue_t cue{};
    cue.status = static_cast<std::int8_t>(CueStatus::kAbsent);
    return cue;
  }();
  return i < plane.cues.size() ? plane.cues[i] : kNoCue;
}

void add_cue(const ground_plane_t& plane, std::size_t i, bool answered, CsvRow* row) {
  const ground_cue_t& cue = cue_of(plane, i);
  const std::string prefix = std::string(kCueTable[i].name) + "_";
  row->add(prefix + "status", answered ? cue_status_name(cue.status) : "");
  const bool seen =
      plane_is_valid(plane, answered) && cue.status != static_cast<std::int8_t>(CueStatus::kAbsent);
  row->add(prefix + "height_vo", cue.height, seen);
  row->add(prefix + "n1", cue.n1, seen);
  row->add(prefix + "n3", cue.n3, seen);
  row->add(prefix + "height_std_vo", deviation(cue.height_var), seen);
  row->add(prefix + "n1_std", deviation(cue.n1_var), seen);
  row->add(prefix + "n3_std", deviation(cue.n3_var), seen);
  row->add(prefix + "quality", cue.quality, seen);
}

void add_innovation(const ground_plane_t& plane, std::size_t i, bool answered, CsvRow* row) {
  const ground_cue_t& cue = cue_of(plane, i);
  const std::string prefix = std::string(kCueTable[i].name) + "_";
  const bool seen =
      plane_is_valid(plane, answered) && cue.status != static_cast<std::int8_t>(CueStatus::kAbsent);
  row->add(prefix + "innovation_n1", cue.innovation[0], seen);
  row->add(prefix + "innovation_n3", cue.innovation[1], seen);
  row->add(prefix + "innovation_ln_height", cue.innovation[2], seen);
  row->add(prefix + "test_ratio", cue.test_ratio, seen);
}

void add_plane(const ground_plane_t& plane, bool answered, CsvRow* row) {
  const bool holds = plane_is_valid(plane, answered);
  row->add("plane_status", answered ? plane_status_name(plane.status) : "");
  row->add("plane_reason", answered ? plane_reason_name(plane.reason) : "");
  for (int i = 0; i < 3; ++i) row->add(format("n%d", i + 1), plane.normal_cam[i], holds);
  row->add("height_m", plane.height_m, holds);
  row->add("pitch_rad", plane.pitch_rad, holds);
  row->add("roll_rad", plane.roll_rad, holds);
  row->add("height_std_m", plane.height_m * deviation(plane.cov[2][2]), holds);
  row->add("pitch_std_rad", deviation(plane.cov[0][0]), holds);
  row->add("roll_std_rad", deviation(plane.cov[1][1]), holds);
  for (std::size_t i = 0; i < kNumFirstCues; ++i) add_cue(plane, i, answered, row);
}

/// Columns that came later, at the end of the row.
void add_later_columns(const ground_plane_t& plane, bool answered, CsvRow* row) {
  for (std::size_t i = kNumFirstCues; i < kNumCues; ++i) add_cue(plane, i, answered, row);
  for (std::size_t i = 0; i < kNumCues; ++i) add_innovation(plane, i, answered, row);
}

void add_ego(const ego_motion_t& ego, bool answered, CsvRow* row) {
  const bool holds = answered && ego.status != ego_motion_t::STATUS_INITIALIZING &&
                     ego.status != ego_motion_t::STATUS_LOST;
  row->add("ego_status", answered ? ego_status_name(ego.status) : "");
  row->add("ego_reason", answered ? vo_reason_name(ego.reason) : "");
  row->add("reset_counter", static_cast<std::int64_t>(ego.reset_counter));
  row->add("log_scale", ego.log_scale, holds);
  row->add("log_scale_std", ego.log_scale_std, holds);
  row->add("speed_m_s", ego.velocity_ground_m_s[0], holds);
  row->add("speed_std_m_s", ego.speed_std_m_s, holds);
  row->add("yaw_rate_rad_s", ego.rate_ground_rad_s[2], holds);
  row->add("yaw_rate_std_rad_s", ego.yaw_rate_std_rad_s, holds);
  row->add("accel_forward_m_s2", ego.accel_forward_m_s2, holds);
  row->add("accel_forward_std_m_s2", ego.accel_forward_std_m_s2, holds);
  row->add("step_m", root_sum_square(ego.t_prev_cam_m[0], ego.t_prev_cam_m[1], ego.t_prev_cam_m[2]),
           holds);
  row->add("x_m", ego.t_world_cam_m[0], holds);
  row->add("y_m", ego.t_world_cam_m[1], holds);
  row->add("z_m", ego.t_world_cam_m[2], holds);
  row->add("distance_m", ego.distance_m, holds);
}

std::string stage_text(const StageTimer& timer) {
  std::string text;
  for (std::size_t i = 0; i < timer.num_stages(); ++i) {
    const StageStats stage = timer.stats(i);
    if (i + 1 == timer.num_stages()) break;  // the total has a column of its own
    text += format("%s%s=%.0f", text.empty() ? "" : " ", stage.name, stage.last_us);
  }
  return text;
}

void add_times(const FrameRecord& record, CsvRow* row) {
  const bool ran = record.vo != nullptr && record.vo_timer != nullptr;
  const auto total_us = [ran](const StageTimer* timer) {
    return ran ? std::round(timer->total().last_us) : 0.0;
  };
  row->add("vo_us", total_us(record.vo_timer), ran);
  row->add("ground_us", total_us(record.ground_timer), ran);
  row->add("vo_stages_us", ran ? stage_text(*record.vo_timer).c_str() : "");
  row->add("ground_stages_us", ran ? stage_text(*record.ground_timer).c_str() : "");
}

std::string build(const FrameRecord& record, bool with_times, bool names_only) {
  static const vo_motion_t kNoMotion{};
  static const ground_plane_t kNoPlane{};
  static const ego_motion_t kNoEgo{};
  CsvRow row(names_only);
  row.add("seq", record.seq);
  row.add("utime", record.capture_us);
  row.add("refused", record.refused);
  add_vo(record.vo != nullptr ? *record.vo : kNoMotion, record.vo != nullptr, &row);
  const ground_plane_t& plane = record.plane != nullptr ? *record.plane : kNoPlane;
  add_plane(plane, record.plane != nullptr, &row);
  add_ego(record.ego != nullptr ? *record.ego : kNoEgo, record.ego != nullptr, &row);
  if (with_times) add_times(record, &row);
  add_later_columns(plane, record.plane != nullptr, &row);
  return row.text();
}

}  // namespace

std::string frame_csv_header(bool with_times) { return build({}, with_times, true); }

std::string frame_csv_row(const FrameRecord& record, bool with_times) {
  return build(record, with_times, false);
}

}  // namespace plumb
