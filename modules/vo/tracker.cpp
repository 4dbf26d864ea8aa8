#include "modules/vo/tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/percentile.hpp"
#include "modules/vo/klt.hpp"
#include "modules/vo/patch.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

constexpr double kSearchBorderPx = 10.0;
constexpr float kMaxRoundTripPx = 0.7F;
constexpr float kMinSearchNcc = 0.5F;
constexpr float kMinAnchorNcc = 0.75F;
// Good enough with the road's warp alone, for a point that was on the road before.
constexpr float kRoadNcc = 0.9F;
constexpr double kRoadBelowHorizonPx = 25.0;
// Depth deviations, as a share of rho, up to which a prediction leans on them.
constexpr double kUsableDepth = 0.5;
// Up to here the host's patch checks a match better than the way back does.
constexpr double kSettledSearchDepth = 0.1;
constexpr AlignLimits kAnchorLimits{};
// A search on level l finds what is kReachPx 2^l away.
constexpr int kReachPx = 4;
constexpr int kRetryLevel = 2;
constexpr float kUnknownStdPx = 30.0F;
constexpr double kMinStdPx = 0.5;

Eigen::Matrix2f inverse_of(const Eigen::Matrix2d& B) { return B.inverse().cast<float>(); }

}  // namespace

Tracker::Tracker(const CameraModel& camera, int track_capacity)
    : camera_(camera),
      guesses_(static_cast<std::size_t>(track_capacity)),
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
    track.prev_xy = track.xy;
    found_[static_cast<std::size_t>(index)] = 0;
  }
}

/// Under a rolling shutter a point is seen at its row's time; its own motion between the last two images brings it to
/// the image's time, whatever its depth. A point new in the image before learns only now where that was.
void Tracker::place(const Eigen::Vector2d& px, Track& track) const {
  track.px = px;
  track.xy = camera_.to_normalized(px);
  if (camera_.readout_s <= 0.0 || dt_s_ <= 0.0) return;
  const double row_s = camera_.row_time_s(px.y());
  const double prev_row_s = camera_.row_time_s(track.prev_px.y());
  const Eigen::Vector2d prev_shown_xy = camera_.to_normalized(track.prev_px);
  const Eigen::Vector2d velocity = (track.xy - prev_shown_xy) / (dt_s_ + row_s - prev_row_s);
  if (track.num_images == 1 && track.prev_px == track.host_px) {
    track.row_shift = prev_row_s * velocity;
    track.host_xy = track.prev_xy = prev_shown_xy - track.row_shift;
    track.observe(track.host, track.host_xy, track.row_shift);
  }
  track.row_shift = row_s * velocity;
  track.xy -= track.row_shift;
}

void Tracker::predict_by_flow(const TrackTable& tracks) {
  for (const int index : tracks.active()) {
    const auto i = static_cast<std::size_t>(index);
    guesses_[i] = {(tracks[index].prev_px + flow_[i]).cast<float>(), 1.0F, kUnknownStdPx};
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
    Guess& guess = guesses_[static_cast<std::size_t>(index)];
    guess = {track.prev_px.cast<float>(), 1.0F, kUnknownStdPx};
    const auto host = static_cast<std::size_t>(track.host);
    const Eigen::Vector3d m = track.host_xy.homogeneous();
    const Eigen::Vector3d Y = T_cam_host[host].R * m + track.rho * T_cam_host[host].t;
    const Eigen::Vector3d Y_prev = T_prev_host[host].R * m + track.rho * T_prev_host[host].t;
    if (Y.z() < kMinDepthRatio || Y_prev.z() < kMinDepthRatio) continue;
    // Added to where the track was, the predicted motion keeps the track's own offset from its model.
    const Eigen::Vector2d now = camera_.project(Y);
    const Eigen::Vector2d before = camera_.project(Y_prev);
    const bool usable = track.rho_std < kUsableDepth * track.rho && camera_.readout_s <= 0.0;
    guess.px = (usable ? now : Eigen::Vector2d(track.prev_px + now - before)).cast<float>();
    const double flow_std = (now - before).norm() * track.rho_std / track.rho;
    guess.std_px = static_cast<float>(kMinStdPx + surprise_px_ + flow_std);
    guess.scale = std::clamp(static_cast<float>(Y_prev.z() / Y.z()), 0.5F, 2.0F);
  }
}

int Tracker::search(const Pyramid& from, const Pyramid& to, TrackTable& tracks, bool wide) {
  const int coarsest = from.num_levels() - 1;
  int num_found = 0;
  scratch_.clear();
  for (const int index : tracks.active()) {
    unsigned char& found = found_[static_cast<std::size_t>(index)];
    if (found != 0) {
      ++num_found;
      continue;
    }
    Track& track = tracks[index];
    const Guess& guess = guesses_[static_cast<std::size_t>(index)];
    const Eigen::Vector2f start = track.prev_px.cast<float>();
    int level = wide ? coarsest : 0;
    while (level < coarsest && static_cast<float>(kReachPx << level) < 2.0F * guess.std_px) ++level;
    KltMatch there = klt_search(from, start, to, guess.px, guess.scale, level);
    if (level < kRetryLevel && there.ncc < kMinSearchNcc) {
      there = klt_search(from, start, to, guess.px, guess.scale, kRetryLevel);
    }
    if (!there.ok() || there.ncc < kMinSearchNcc || !inside(there.px.cast<double>())) continue;
    if (track.rho_std >= kSettledSearchDepth * track.rho) {
      const KltMatch back = klt_search(to, there.px, from, start, 1.0F / guess.scale, 0);
      if (!back.ok() || (back.px - start).norm() > kMaxRoundTripPx) continue;
    }
    found = 1;
    ++num_found;
    place(there.px.cast<double>(), track);
    if (track.rho_std < kUsableDepth * track.rho) {
      scratch_.push_back(static_cast<double>((there.px - guess.px).norm()));
    }
  }
  if (!scratch_.empty()) surprise_px_ = upper_median(scratch_);
  return num_found;
}

void Tracker::drop_missing(TrackTable& tracks) {
  tracks.sift_active([this](int index) {
    return found_[static_cast<std::size_t>(index)] != 0 ? TrackTable::Fate::kStay
                                                        : TrackTable::Fate::kRetire;
  });
}

bool Tracker::anchor_one(const ImageView& image, Track& track, const ImageView& host_image,
                         const Se3& T_cam_host) const {
  const Eigen::Vector3d m = track.host_xy.homogeneous();
  const Eigen::Vector3d Y = T_cam_host.R * m + track.rho * T_cam_host.t;
  if (Y.z() < kMinDepthRatio) return false;
  const bool usable = track.rho_std < kUsableDepth * track.rho;
  const Eigen::Vector2f start = track.px.cast<float>();
  const Eigen::Vector2f host_px = track.host_px.cast<float>();
  Alignment best;
  bool on_road = false;
  Patch<5> patch;

  if (usable && track.host_px.y() > camera_.cy_px + kRoadBelowHorizonPx) {
    // Road: rho is proportional to the ray's y, so each neighbour has its own depth.
    const auto warp = [&](double du, double dv) {
      const Eigen::Vector3d n = camera_.unproject(track.host_px + Eigen::Vector2d(du, dv));
      return camera_.project(T_cam_host.R * n + (track.rho * n.y() / m.y()) * T_cam_host.t);
    };
    Eigen::Matrix2d B;
    B << (warp(2, 0) - warp(-2, 0)) / 4.0, (warp(0, 2) - warp(0, -2)) / 4.0;
    if (B.determinant() > 0.05 && patch.cut(host_image, host_px, inverse_of(B))) {
      best = patch.align(image, start, kAnchorLimits);
      on_road = best.ok();
    }
  }
  if (!(track.on_road && best.ncc > kRoadNcc)) {
    // Facing the camera: host offset = (Z / Z_host) R_roll^T offset.
    const double scale = usable ? Y.z() : 1.0;
    const Eigen::Matrix2f A =
        (scale * T_cam_host.R.topLeftCorner<2, 2>().transpose()).cast<float>();
    if (patch.cut(host_image, host_px, A)) {
      const Alignment facing = patch.align(image, start, kAnchorLimits);
      if (facing.ncc > best.ncc) {
        best = facing;
        on_road = false;
      }
    }
  }
  if (best.ncc < kMinAnchorNcc) return false;
  track.on_road = on_road;
  place(best.px.cast<double>(), track);
  return true;
}

int Tracker::anchor(const ImageView& image, TrackTable& tracks, const Window& window,
                    const Se3& T_cam_world) {
  std::array<Se3, kMaxFrames> T_cam_host;
  for (const int slot : window.order()) {
    T_cam_host[static_cast<std::size_t>(slot)] = T_cam_world * window[slot].T_cam_world.inverse();
  }
  tracks.sift_active([&](int index) {
    Track& track = tracks[index];
    return anchor_one(image, track, window.image(track.host),
                      T_cam_host[static_cast<std::size_t>(track.host)])
               ? TrackTable::Fate::kStay
               : TrackTable::Fate::kRetire;
  });
  return static_cast<int>(tracks.active().size());
}

}  // namespace plumb::vo
