#include "modules/vo/keyframes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/percentile.hpp"
#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/projection.hpp"

namespace plumb::vo {
namespace {

// A keyframe needs this parallax even when its overlap is small.
constexpr double kMinKeyframeParallaxPx = 2.0;
// With fewer tracks than this share of the last keyframe's, a smaller parallax is enough.
constexpr double kFewTracksRatio = 0.5;
constexpr double kFewTracksParallaxPx = 1.0;
// Tracks whose standard deviation is a smaller share of the inverse depth can predict others.
constexpr double kKnownDepth = 0.2;
// The threshold for corners is lower from this distance below the optical centre downwards.
constexpr double kHorizonMarginPx = 30.0;

}  // namespace

Keyframes::Keyframes(const VoConfig& config, const CameraModel& camera, int track_capacity)
    : config_(config),
      camera_(camera),
      detector_(camera.width_px / 2, camera.height_px / 2, config.max_tracks) {
  neighbours_.reserve(static_cast<std::size_t>(track_capacity));
  scratch_.reserve(static_cast<std::size_t>(track_capacity));
}

Keyframes::Overlap Keyframes::compare(const TrackTable& tracks, const Window& window,
                                      const Se3& T_cam_world) {
  Overlap overlap;
  const int keyframe = window.newest_keyframe();
  const Eigen::Matrix3d R_cam_key = T_cam_world.R * window[keyframe].T_cam_world.R.transpose();
  scratch_.clear();
  for (const int index : tracks.active()) {
    const Track& track = tracks[index];
    ++overlap.num_tracks;
    if (!track.seen_in(keyframe)) continue;
    ++overlap.num_shared;
    const Eigen::Vector3d Y = R_cam_key * track.xy_in(keyframe).homogeneous();
    if (Y.z() > 0.1) scratch_.push_back((camera_.project(Y) - track.px).norm());
  }
  constexpr double kNothingShared = 99.0;
  overlap.median_parallax_px = kNothingShared;
  if (!scratch_.empty()) overlap.median_parallax_px = upper_median(scratch_);
  return overlap;
}

bool Keyframes::is_needed(const Overlap& overlap) const {
  if (overlap.median_parallax_px > config_.keyframe_parallax_px) return true;
  if (overlap.num_shared < config_.keyframe_overlap_ratio * num_at_keyframe_ &&
      overlap.median_parallax_px > kMinKeyframeParallaxPx) {
    return true;
  }
  return overlap.num_tracks < kFewTracksRatio * num_at_keyframe_ &&
         overlap.median_parallax_px > kFewTracksParallaxPx;
}

void Keyframes::remove_frame(int slot, TrackTable& tracks, Window& window) {
  // Returns false when the track has lost its host.
  const auto remove_from = [&](int index) {
    Track& track = tracks[index];
    if (track.host == slot) {
      if (!change_host(track, slot, window)) return false;
      track.host_px = camera_.from_normalized(track.shown_xy_in(track.host));
    }
    track.remove_observation(slot);
    return true;
  };
  tracks.sift_active([&](int index) {
    return remove_from(index) ? TrackTable::Fate::kStay : TrackTable::Fate::kFree;
  });
  tracks.sift_passive([&](int index) {
    if (!remove_from(index)) return false;
    const Track& track = tracks[index];
    return __builtin_popcount(track.seen & ~(1U << track.host)) >= 2;
  });
  window.remove(slot);
}

void Keyframes::trim_recent(TrackTable& tracks, Window& window) {
  for (int stale = window.stale_frame(); stale >= 0; stale = window.stale_frame()) {
    remove_frame(stale, tracks, window);
  }
}

void Keyframes::promote(int slot, const ImageView& image, TrackTable& tracks, Window& window) {
  window.make_keyframe(slot, image);
  while (window.num_keyframes() > kMaxKeyframes) {
    remove_frame(window.oldest_keyframe(), tracks, window);
  }
}

// Collects the active tracks with known depth, as `slot` sees them.
void Keyframes::collect_neighbours(int slot, const TrackTable& tracks, const Window& window) {
  neighbours_.clear();
  const auto T_cam_slot = window.slots_to_cam(window[slot].T_cam_world);
  for (const int index : tracks.active()) {
    const Track& track = tracks[index];
    if (track.host == slot || track.rho_std > kKnownDepth * track.rho) continue;
    const Se3& T_cam_host = T_cam_slot[static_cast<std::size_t>(track.host)];
    double rho = 0.0;
    double rho_std = 0.0;
    if (inverse_depth_in(track, T_cam_host, &rho, &rho_std)) neighbours_.push_back({track.px, rho});
  }
}

// Predicts the inverse depth of a new track as the median of its three nearest neighbours.
// Distances across rows count more, because the depth of a road changes with the row.
void Keyframes::predict_depth(Track& track) const {
  constexpr double kRowWeight = 4.0;
  std::array<std::pair<double, double>, 3> nearest;
  nearest.fill({1e300, 0.0});
  for (const Neighbour& n : neighbours_) {
    const Eigen::Vector2d e = n.px - track.px;
    const double distance2 = e.x() * e.x() + kRowWeight * e.y() * e.y();
    if (distance2 >= nearest[2].first) continue;
    nearest[2] = {distance2, n.rho};
    if (nearest[2].first < nearest[1].first) std::swap(nearest[2], nearest[1]);
    if (nearest[1].first < nearest[0].first) std::swap(nearest[1], nearest[0]);
  }
  track.rho = kTypicalRho;
  track.rho_std = kUnknownRhoStd;
  track.prior_rho = kTypicalRho;
  track.prior_std = kUnknownRhoStd;
  if (nearest[2].first > 1e299) return;
  const double a = nearest[0].second;
  const double b = nearest[1].second;
  const double c = nearest[2].second;
  track.rho = std::max(std::min(a, b), std::min(std::max(a, b), c));
  track.rho_std = std::max(0.02, 0.7 * track.rho);
  track.prior_rho = track.rho;
  track.prior_std = std::max(0.03, track.rho);
}

int Keyframes::start_tracks(int slot, const Pyramid& image, const AttachedRegions& attached,
                            TrackTable& tracks, const Window& window) {
  detector_.clear();
  for (const int index : tracks.active()) detector_.occupy(0.5 * tracks[index].px);
  attached.for_each([this](const Eigen::Vector2i& first_px) {
    detector_.exclude(first_px / 2, AttachedRegions::kCellPx / 2);
  });
  collect_neighbours(slot, tracks, window);
  // Corners are detected on level 1, whose scale suits the size of the patches. It also takes
  // only a quarter of the time.
  const CornerOptions options{config_.min_corner_grey2, 0.5 * (camera_.cy_px + kHorizonMarginPx)};
  int num_new = 0;
  for (const Eigen::Vector2d& half_px : detector_.detect(image.level(1), options)) {
    // Whole pixels, so that the host patch is not interpolated.
    const Eigen::Vector2d px = 2.0 * half_px;
    const int index = tracks.add();
    if (index < 0) break;
    Track& track = tracks[index];
    track.host = slot;
    track.px = track.prev_px = track.host_px = px;
    track.xy = track.host_xy = camera_.to_normalized(px);
    track.observe(slot, track.xy);
    track.num_images = 1;
    predict_depth(track);
    ++num_new;
  }
  num_at_keyframe_ = static_cast<int>(tracks.active().size());
  return num_new;
}

}  // namespace plumb::vo
