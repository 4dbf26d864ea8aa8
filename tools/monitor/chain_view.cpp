#include "tools/monitor/chain_view.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "modules/ground/types/cue_table.hpp"
#include "plumb/status_names.hpp"

namespace plumb {
namespace {

using nlohmann::json;

template <typename T, std::size_t kSize>
json list_of(const T (&values)[kSize]) {
  json list = json::array();
  for (const T& value : values) list.push_back(value);
  return list;
}

/// NaN when the variance is not valid, which JSON shows as null.
double std_of(double variance) { return variance >= 0.0 ? std::sqrt(variance) : kNan; }

/// Rounded, because thousands of points go to the page with every image.
double rounded(float value, double steps) {
  return std::round(static_cast<double>(value) * steps) / steps;
}

bool is_measured(const ego_motion_t& ego) {
  return ego.status != ego_motion_t::STATUS_INITIALIZING && ego.status != ego_motion_t::STATUS_LOST;
}
bool is_valid(const ground_plane_t& plane) {
  return plane.status == ground_plane_t::STATUS_OK || plane.status == ground_plane_t::STATUS_HELD;
}

json camera_json(const camera_calibration_t& m) {
  return {{"width", m.width},
          {"height", m.height},
          {"fx", m.fx_px},
          {"fy", m.fy_px},
          {"cx", m.cx_px},
          {"cy", m.cy_px},
          {"k1", m.residual_k1},
          {"k2", m.residual_k2},
          {"readout_s", m.readout_s},
          {"camera_height", m.camera_height_m}};
}

/// Flat, with half a pixel's precision: hundreds of features go to the page with every image.
json features_json(const vo_motion_t& m) {
  json features = json::array();
  const int count = std::clamp<int>(m.num_features, 0, 1000);
  for (int i = 0; i < count; ++i) {
    features.push_back(rounded(m.features_px[i][0], 2.0));
    features.push_back(rounded(m.features_px[i][1], 2.0));
    features.push_back(m.features_kind[i]);
  }
  return features;
}

json vo_json(const vo_motion_t& m) {
  json points = json::array();
  const int count = std::clamp<int>(m.num_road_points, 0, 384);
  for (int i = 0; i < count; ++i) {
    points.push_back(rounded(m.road_points_px[i][0], 10.0));
    points.push_back(rounded(m.road_points_px[i][1], 10.0));
    points.push_back(rounded(m.road_points_rel_std[i], 1e3));
  }
  return {{"status", m.status},
          {"reason", m.reason},
          {"scale_epoch", m.scale_epoch},
          {"interval_s", m.interval_s},
          {"num_tracked", m.num_tracked},
          {"num_inliers", m.num_inliers},
          {"num_new", m.num_new},
          {"is_keyframe", m.is_keyframe},
          {"median_flow_px", m.median_flow_px},
          {"median_parallax_px", m.median_parallax_px},
          {"rms_residual_px", m.rms_residual_px},
          {"attached_share", m.attached_share},
          {"points", std::move(points)},
          {"features", features_json(m)}};
}

json plane_json(const ground_plane_t& m) {
  json cues = json::array();
  for (const ground_cue_t& cue : m.cues) {
    cues.push_back({{"status", cue.status},
                    {"height", cue.height},
                    {"n1", cue.n1},
                    {"n3", cue.n3},
                    {"height_std", std_of(cue.height_var)},
                    {"n1_std", std_of(cue.n1_var)},
                    {"n3_std", std_of(cue.n3_var)},
                    {"quality", cue.quality},
                    {"test_ratio", cue.test_ratio}});
  }
  return {{"status", m.status},
          {"reason", m.reason},
          {"normal", list_of(m.normal_cam)},
          {"height", m.height_m},
          {"pitch", m.pitch_rad},
          {"roll", m.roll_rad},
          {"height_std", m.height_m * std_of(m.cov[2][2])},
          {"pitch_std", std_of(m.cov[0][0])},
          {"roll_std", std_of(m.cov[1][1])},
          {"cues", std::move(cues)}};
}

json ego_json(const ego_motion_t& m) {
  return {{"status", m.status},
          {"reason", m.reason},
          {"reset_counter", m.reset_counter},
          {"velocity", list_of(m.velocity_ground_m_s)},
          {"speed_std", m.speed_std_m_s},
          {"rate", list_of(m.rate_ground_rad_s)},
          {"yaw_rate_std", m.yaw_rate_std_rad_s},
          {"accel", m.accel_forward_m_s2},
          {"accel_std", m.accel_forward_std_m_s2},
          {"q_world_cam", list_of(m.q_world_cam)},
          {"t_world_cam", list_of(m.t_world_cam_m)},
          {"distance", m.distance_m},
          {"log_scale", m.log_scale},
          {"log_scale_std", m.log_scale_std}};
}

json object_json(const object_t& m) {
  return {{"id", m.track_id},
          {"class", m.class_id},
          {"status", m.status},
          {"reason", m.reason},
          {"position", {m.position_ground_m[0], m.position_ground_m[1]}},
          {"position_std", {std_of(m.position_cov_m2[0][0]), std_of(m.position_cov_m2[1][1])}},
          {"velocity", list_of(m.velocity_ground_m_s)},
          {"yaw", m.yaw_rad},
          {"size", list_of(m.size_m)},
          {"ttc", m.time_to_collision_s}};
}

json boxes_json(const detections_t& m) {
  json list = json::array();
  for (const detection_t& d : m.detections)
    list.push_back({{"box", list_of(d.box_px)}, {"class", d.class_id}, {"score", d.score}});
  return list;
}

json mount_json(const mount_t& m) {
  return {{"status", m.status},
          {"reason", m.reason},
          {"progress", m.progress},
          {"num_stretches", m.num_stretches},
          {"reference", list_of(m.reference_rad)},
          {"reference_std", list_of(m.reference_std_rad)},
          {"recent", list_of(m.recent_rad)},
          {"spread", list_of(m.spread_rad)}};
}

json health_json(const process_health_t& m, double age_ms) {
  json stages = json::array();
  for (const stage_latency_t& stage : m.stages) {
    stages.push_back({{"name", stage.name},
                      {"num", stage.num_samples},
                      {"median_us", stage.median_us},
                      {"p99_us", stage.p99_us},
                      {"max_us", stage.max_us}});
  }
  return {{"process", m.process},
          {"version", m.version},
          {"state", m.state},
          {"state_reason", m.state_reason},
          {"age_ms", age_ms},
          {"received", m.num_received},
          {"rejected", m.num_rejected},
          {"dropped", m.num_dropped},
          {"late", m.num_late},
          {"skipped", m.num_skipped},
          {"unpaired", m.num_unpaired},
          {"published", m.num_published},
          {"unsent", m.num_unsent},
          {"rss_bytes", m.memory_rss_bytes},
          {"peak_bytes", m.memory_peak_bytes},
          {"stages", std::move(stages)}};
}

}  // namespace

json status_words() {
  json cues = json::array();
  for (const CueEntry& cue : kCueTable) cues.push_back(cue.name);
  return {{"vo_status", kVoMotionStatusNames},
          {"vo_reason", kVoMotionReasonNames},
          {"vo_feature", kVoMotionFeatureNames},
          {"plane_status", kGroundPlaneStatusNames},
          {"plane_reason", kGroundPlaneReasonNames},
          {"ego_status", kEgoMotionStatusNames},
          {"cue_status", kGroundCueStatusNames},
          {"mount_status", kMountStatusNames},
          {"mount_reason", kMountReasonNames},
          {"object_class", kDetectionClassNames},
          {"object_status", kObjectStatusNames},
          {"object_reason", kObjectReasonNames},
          {"health_state", {"running", "waiting", "degraded", "stopping"}},
          {"cues", std::move(cues)}};
}

void ChainView::take(const process_health_t& m, std::int64_t now_us) {
  const int place = chain_process(m.process);
  if (place >= 0) health_[static_cast<std::size_t>(place)] = {m, now_us};
}

void ChainView::take(const ego_motion_t& m) {
  if (!ego_ || ego_->session != m.session) ++num_runs_;
  ego_ = m;
}

json ChainView::results(std::int64_t seq) const {
  json out = {{"seq", seq}};
  if (vo_ && vo_->seq == seq) out["vo"] = vo_json(*vo_);
  if (plane_ && plane_->seq == seq) out["plane"] = plane_json(*plane_);
  if (is_of(ego_, seq)) {
    out["ego"] = ego_json(*ego_);
    out["utime"] = ego_->utime;
  }
  const auto is_near = [this, seq](std::int64_t utime, std::int64_t of_seq) {
    return of_seq == seq ||
           (is_of(ego_, seq) && ego_->utime >= utime && ego_->utime - utime <= kMaxObjectAgeUs);
  };
  if (objects_ && is_near(objects_->utime, objects_->seq)) {
    json list = json::array();
    for (const object_t& object : objects_->objects) list.push_back(object_json(object));
    out["objects"] = {{"seq", objects_->seq}, {"list", std::move(list)}};
  }
  if (detections_ && is_near(detections_->utime, detections_->seq))
    out["boxes"] = {{"seq", detections_->seq}, {"list", boxes_json(*detections_)}};
  return out;
}

json ChainView::state(std::int64_t now_us) const {
  json out = json::object();
  if (camera_) out["camera"] = camera_json(*camera_);
  if (mount_) out["mount"] = mount_json(*mount_);
  json health = json::array();
  for (const Health& one : health_) {
    if (one.time_us == 0) continue;
    health.push_back(health_json(one.message, static_cast<double>(now_us - one.time_us) * 1e-3));
  }
  out["health"] = std::move(health);
  return out;
}

Row ChainView::row(double time_s, std::int64_t seq) const {
  const bool has_ego = is_of(ego_, seq);
  const bool moves = has_ego && is_measured(*ego_);
  const bool has_plane = plane_ && plane_->seq == seq;
  const bool lies = has_plane && is_valid(*plane_);
  const bool has_vo = vo_ && vo_->seq == seq;
  const auto motion = [moves](double value) { return moves ? value : kNan; };
  const auto plane = [lies](double value) { return lies ? value : kNan; };
  const ego_motion_t& ego = ego_ ? *ego_ : ego_motion_t{};
  const ground_plane_t& ground = plane_ ? *plane_ : ground_plane_t{};
  const double scale = motion(std::exp(ego.log_scale));
  return {time_s,
          static_cast<double>(seq),
          motion(ego.velocity_ground_m_s[0]),
          motion(ego.speed_std_m_s),
          plane(ground.pitch_rad),
          plane(std_of(ground.cov[0][0])),
          plane(ground.roll_rad),
          plane(std_of(ground.cov[1][1])),
          plane(ground.height_m),
          plane(ground.height_m * std_of(ground.cov[2][2])),
          scale,
          scale * ego.log_scale_std,
          motion(ego.t_world_cam_m[0]),
          motion(ego.t_world_cam_m[2]),
          has_ego ? static_cast<double>(ego.reset_counter) : kNan,
          static_cast<double>(num_runs_),
          has_vo ? static_cast<double>(vo_->status) : kNan,
          has_plane ? static_cast<double>(ground.status) : kNan,
          has_ego ? static_cast<double>(ego.status) : kNan};
}

}  // namespace plumb
