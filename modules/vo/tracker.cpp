#include "modules/vo/tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/percentile.hpp"
#include "modules/vo/patch.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr double kSearchBorderPx = 10.0;
constexpr float kMaxRoundTripPx = 0.7F;
constexpr float kMinSearchNcc = 0.5F;
constexpr float kMinAlignNcc = 0.75F;
// A track that was on the road before needs no other warp when the road's matches this well.
constexpr float kRoadNcc = 0.9F;
constexpr double kRoadBelowHorizonPx = 25.0;
// Determinant below which the road's warp is degenerate.
constexpr double kMinRoadWarp = 0.05;
// Below this standard deviation, as a share of the inverse depth, the depth is used in predictions.
constexpr double kUsableDepth = 0.5;
// Below this one, the alignment with the host checks a match better than a backward search does.
constexpr double kSettledSearchDepth = 0.1;
constexpr AlignLimits kAlignLimits{};
// A search that starts on level l converges from kReachPx 2^l away.
constexpr int kReachPx = 4;
constexpr int kRetryLevel = 2;
constexpr float kUnknownStdPx = 30.0F;
constexpr double kMinStdPx = 0.5;

Eigen::Matrix2f inverse_of(const Eigen::Matrix2d& B) { return B.inverse().cast<float>(); }

/// Returns the linear warp from the host image to the newest one for a patch of a level road.
/// There, rho is proportional to y of the ray, so that every pixel of the patch has a depth of its
/// own.
Eigen::Matrix2d road_warp(const CameraModel& camera, const Track& track, const Se3& T_cam_host) {
  const auto warp = [&](double du, double dv) {
    const Eigen::Vector3d n = camera.unproject(track.host_px + Eigen::Vector2d(du, dv));
    const double rho = track.rho * n.y() / track.host_xy.y();
    return camera.project(T_cam_host.R * n + rho * T_cam_host.t);
  };
  Eigen::Matrix2d B;
  B << (warp(2, 0) - warp(-2, 0)) / 4.0, (warp(0, 2) - warp(0, -2)) / 4.0;
  return B;
}

}  // namespace

Tracker::Tracker(const CameraModel& camera, int track_capacity)
    : camera_(camera),
      predictions_(static_cast<std::size_t>(track_capacity)),
      found_(static_cast<std::size_t>(track_capacity)),
      flow_(static_cast<std::size_t>(track_capacity)) {
  scratch_.reserve(static_cast<std::size_t>(track_capacity));
}

bool Tracker::inside(const Eigen::Vector2d& px) const {
  return px.x() >= kSearchBorderPx && px.y() >= kSearchBorderPx &&
         px.x() <= camera_.width_px - kSearchBorderPx - 1 &&
         px.y() <= camera_.height_px - kSearchBorderPx - 1;
}

void Tracker::begin(TrackTable& tracks, double dt_s) {
  dt_s_ = dt_s;
  for (const int index : tracks.active()) {
    Track& track = tracks[index];
    flow_[static_cast<std::size_t>(index)] = track.px - track.prev_px;
    track.prev_px = track.px;
    found_[static_cast<std::size_t>(index)] = 0;
  }
}

/// Sets the newest position of a track. With a rolling shutter, the position is measured at the
/// time of its row. The track's own motion since the previous image moves it to the image's time
/// stamp, independently of its depth. For a track that started in the previous image, the host's
/// position is corrected in the same way now, because its motion was not known before.
void Tracker::set_position(const Eigen::Vector2d& px, Track& track) const {
  track.px = px;
  track.xy = camera_.to_normalized(px);
  if (camera_.readout_s <= 0.0 || dt_s_ <= 0.0) return;
  const double row_s = camera_.row_time_s(px.y());
  const double prev_row_s = camera_.row_time_s(track.prev_px.y());
  const Eigen::Vector2d prev_shown_xy = camera_.to_normalized(track.prev_px);
  const Eigen::Vector2d velocity = (track.xy - prev_shown_xy) / (dt_s_ + row_s - prev_row_s);
  if (track.num_images == 1 && track.prev_px == track.host_px) {
    track.row_shift = prev_row_s * velocity;
    track.host_xy = prev_shown_xy - track.row_shift;
    track.observe(track.host, track.host_xy, track.row_shift);
  }
  track.row_shift = row_s * velocity;
  track.xy -= track.row_shift;
}

void Tracker::predict_by_flow(const TrackTable& tracks) {
  for (const int index : tracks.active()) {
    const auto i = static_cast<std::size_t>(index);
    predictions_[i] = {(tracks[index].prev_px + flow_[i]).cast<float>(), 1.0F, kUnknownStdPx};
  }
}

void Tracker::predict_by_pose(const TrackTable& tracks, const Window& window,
                              const Se3& T_prev_world, const Se3& T_cam_world) {
  std::array<Se3, kMaxFrames> T_cam_host;
  std::array<Se3, kMaxFrames> T_prev_host;
  for (const int slot : window.order()) {
    const Se3 T_world_host = window[slot].T_cam_world.inverse();
    T_cam_host[static_cast<std::size_t>(slot)] = T_cam_world * T_world_host;
    T_prev_host[static_cast<std::size_t>(slot)] = T_prev_world * T_world_host;
  }
  for (const int index : tracks.active()) {
    const Track& track = tracks[index];
    Prediction& prediction = predictions_[static_cast<std::size_t>(index)];
    prediction = {track.prev_px.cast<float>(), 1.0F, kUnknownStdPx};
    const auto host = static_cast<std::size_t>(track.host);
    const Eigen::Vector3d Y = transfer_point(T_cam_host[host], track.host_xy, track.rho);
    const Eigen::Vector3d Y_prev = transfer_point(T_prev_host[host], track.host_xy, track.rho);
    if (Y.z() < kMinDepthRatio || Y_prev.z() < kMinDepthRatio) continue;
    // With an uncertain depth or a rolling shutter, the projected position is biased. The predicted
    // flow, added to the previous position, is not, because the biases of both images cancel.
    const Eigen::Vector2d now = camera_.project(Y);
    const Eigen::Vector2d before = camera_.project(Y_prev);
    const bool usable = track.rho_std < kUsableDepth * track.rho && camera_.readout_s <= 0.0;
    prediction.px = (usable ? now : Eigen::Vector2d(track.prev_px + now - before)).cast<float>();
    const double flow_std = (now - before).norm() * track.rho_std / track.rho;
    prediction.std_px = static_cast<float>(kMinStdPx + prediction_error_px_ + flow_std);
    prediction.scale = std::clamp(static_cast<float>(Y_prev.z() / Y.z()), 0.5F, 2.0F);
  }
}

/// Searches one track in `to` and, when its depth is uncertain, back in `from`. Returns a match
/// that is not ok() when one of the searches fails.
KltMatch Tracker::find(const Pyramid& from, const Pyramid& to, const Track& track,
                       const Prediction& prediction, bool wide) const {
  const int coarsest = from.num_levels() - 1;
  const Eigen::Vector2f start = track.prev_px.cast<float>();
  int level = wide ? coarsest : 0;
  while (level < coarsest && static_cast<float>(kReachPx << level) < 2.0F * prediction.std_px) {
    ++level;
  }
  KltMatch there = klt_search(from, start, to, prediction.px, prediction.scale, level);
  if (level < kRetryLevel && there.ncc < kMinSearchNcc) {
    there = klt_search(from, start, to, prediction.px, prediction.scale, kRetryLevel);
  }
  if (!there.ok() || there.ncc < kMinSearchNcc || !inside(there.px.cast<double>())) return {};
  if (track.rho_std >= kSettledSearchDepth * track.rho) {
    const KltMatch back = klt_search(to, there.px, from, start, 1.0F / prediction.scale, 0);
    if (!back.ok() || (back.px - start).norm() > kMaxRoundTripPx) return {};
  }
  return there;
}

int Tracker::search(const Pyramid& from, const Pyramid& to, TrackTable& tracks, bool wide) {
  int num_found = 0;
  scratch_.clear();
  for (const int index : tracks.active()) {
    const auto i = static_cast<std::size_t>(index);
    if (found_[i] != 0) {
      ++num_found;
      continue;
    }
    Track& track = tracks[index];
    const Prediction& prediction = predictions_[i];
    const KltMatch match = find(from, to, track, prediction, wide);
    if (!match.ok()) continue;
    found_[i] = 1;
    ++num_found;
    set_position(match.px.cast<double>(), track);
    if (track.rho_std < kUsableDepth * track.rho) {
      scratch_.push_back(static_cast<double>((match.px - prediction.px).norm()));
    }
  }
  if (!scratch_.empty()) prediction_error_px_ = upper_median(scratch_);
  return num_found;
}

void Tracker::drop_missing(TrackTable& tracks) {
  tracks.sift_active([this](int index) {
    return found_[static_cast<std::size_t>(index)] != 0 ? TrackTable::Fate::kStay
                                                        : TrackTable::Fate::kRetire;
  });
}

/// Aligns one track with its host patch. Below the horizon, the patch is warped like a part of the
/// road and like a surface that faces the camera, and the better match counts.
bool Tracker::align(const ImageView& image, Track& track, const ImageView& host_image,
                    const Se3& T_cam_host) const {
  const Eigen::Vector3d Y = transfer_point(T_cam_host, track.host_xy, track.rho);
  if (Y.z() < kMinDepthRatio) return false;
  const bool usable = track.rho_std < kUsableDepth * track.rho;
  const Eigen::Vector2f start = track.px.cast<float>();
  const Eigen::Vector2f host_px = track.host_px.cast<float>();
  Alignment best;
  bool on_road = false;
  Patch<5> patch;

  if (usable && track.host_px.y() > camera_.cy_px + kRoadBelowHorizonPx) {
    const Eigen::Matrix2d B = road_warp(camera_, track, T_cam_host);
    if (B.determinant() > kMinRoadWarp && patch.cut(host_image, host_px, inverse_of(B))) {
      best = patch.align(image, start, kAlignLimits);
      on_road = best.ok();
    }
  }
  if (!(track.on_road && best.ncc > kRoadNcc)) {
    // The warp of a patch that faces the camera: host offset = (Z / Z_host) R_roll^T offset.
    const double scale = usable ? Y.z() : 1.0;
    const Eigen::Matrix2f A =
        (scale * T_cam_host.R.topLeftCorner<2, 2>().transpose()).cast<float>();
    if (patch.cut(host_image, host_px, A)) {
      const Alignment facing = patch.align(image, start, kAlignLimits);
      if (facing.ncc > best.ncc) {
        best = facing;
        on_road = false;
      }
    }
  }
  if (best.ncc < kMinAlignNcc) return false;
  track.on_road = on_road;
  set_position(best.px.cast<double>(), track);
  return true;
}

void Tracker::align_to_hosts(const ImageView& image, TrackTable& tracks, const Window& window,
                             const Se3& T_cam_world) {
  std::array<Se3, kMaxFrames> T_cam_host;
  for (const int slot : window.order()) {
    T_cam_host[static_cast<std::size_t>(slot)] = T_cam_world * window[slot].T_cam_world.inverse();
  }
  tracks.sift_active([&](int index) {
    Track& track = tracks[index];
    const Se3& T = T_cam_host[static_cast<std::size_t>(track.host)];
    return align(image, track, window.image(track.host), T) ? TrackTable::Fate::kStay
                                                            : TrackTable::Fate::kRetire;
  });
}

}  // namespace plumb::vo
