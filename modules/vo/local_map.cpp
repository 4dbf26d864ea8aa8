#include "modules/vo/local_map.hpp"

#include "modules/vo/inverse_depth.hpp"
#include "modules/vo/motion_predictor.hpp"

namespace plumb::vo {
namespace {

constexpr int kNumLevels = 4;
// Residuals that make an outlier: in the newest frame before and after refinement, and in the
// frames before.
constexpr double kGrossOutlierPx = 4.0;
constexpr double kNewestOutlierPx = 3.0;
constexpr double kOutlierPx = 2.0;
// Below this standard deviation, as a share of the inverse depth, a track needs no refinement of
// its own.
constexpr double kConvergedDepth = 0.02;
constexpr double kMinRefineParallaxPx = 0.3;
constexpr int kDepthIterations = 4;
constexpr int kKeyframeIterations = 3;
constexpr int kFrameIterations = 1;

}  // namespace

LocalMap::LocalMap(const VoConfig& config, const CameraModel& camera)
    : tracks(track_capacity(config)),
      window(camera.width_px, camera.height_px),
      tracker(camera, track_capacity(config)),
      keyframes(config, camera, track_capacity(config)),
      attached(camera.width_px, camera.height_px),
      config_(config),
      focal_px_(camera.fx_px, camera.fy_px),
      refiner_(track_capacity(config)),
      pyramids_{Pyramid(camera.width_px, camera.height_px, kNumLevels),
                Pyramid(camera.width_px, camera.height_px, kNumLevels)} {}

void LocalMap::keep_image(const Se3& T_cam_world) {
  newest_ = 1 - newest_;
  has_image_ = true;
  T_last_image_newest_ = T_cam_world * window[window.newest()].T_cam_world.inverse();
}

Se3 LocalMap::last_image_pose() const {
  return T_last_image_newest_ * window[window.newest()].T_cam_world;
}

Matrix6d LocalMap::place_previous(const Se3& T_placed_world, const FrameTime& time) {
  if (window.num_history() < 2) return Matrix6d::Zero();
  const Se3 T_placed_now = T_placed_world * window[window.newest()].T_cam_world.inverse();
  const double share = time.unplaced_s / (time.unplaced_s + time.dt_s);
  const Se3 T_placed_previous{exp_so3(share * log_so3(T_placed_now.R)), share * T_placed_now.t};
  window.move_previous(T_placed_previous.inverse() * T_placed_world);
  return MotionPredictor::interpolation_cov(time.unplaced_s, time.dt_s);
}

int LocalMap::start_reference(std::int64_t seq, const Se3& T_cam_world, const Pyramid& image) {
  window.clear();
  tracks.clear();
  const int slot = window.add(seq, T_cam_world);
  keyframes.promote(slot, image.level(0), tracks, window);
  return keyframes.start_tracks(slot, image, attached, tracks, window);
}

int LocalMap::add_frame(std::int64_t seq, const Se3& T_cam_world) {
  const int slot = window.add(seq, T_cam_world);
  for (const int index : tracks.active()) {
    Track& track = tracks[index];
    track.observe(slot, track.xy, track.row_shift);
    ++track.num_images;
  }
  return slot;
}

Insertion LocalMap::insert(std::int64_t seq, const Se3& T_cam_world, bool refine_window,
                           StageProbe& probe) {
  const int slot = add_frame(seq, T_cam_world);
  if (refine_window) {
    for (const int index : tracks.active()) {
      Track& track = tracks[index];
      if (track.rho_std > kConvergedDepth * track.rho) {
        refine_inverse_depth(track, window, focal_px_, kDepthIterations);
      }
    }
  }
  retire_gross_outliers(slot);
  const Keyframes::Overlap overlap = keyframes.compare(tracks, window, T_cam_world);
  Insertion done{!refine_window || keyframes.is_needed(overlap), 0, overlap.median_parallax_px};
  keyframes.trim_recent(tracks, window);
  if (done.is_keyframe) keyframes.promote(slot, newest_image().level(0), tracks, window);
  if (refine_window && overlap.median_parallax_px > kMinRefineParallaxPx) {
    refine(done.is_keyframe ? kKeyframeIterations : kFrameIterations);
    free_outliers();
  }
  probe.mark("refine");
  if (done.is_keyframe) {
    done.num_new = keyframes.start_tracks(slot, newest_image(), attached, tracks, window);
    probe.mark("detect");
  }
  return done;
}

PoseFit LocalMap::fit(const Se3& start, int max_iterations) const {
  return fit_pose(start, tracks, window, focal_px_, {max_iterations, 1.0, false});
}

void LocalMap::refine(int max_iterations) {
  refiner_.refine(window, tracks, focal_px_, config_.fixed_keyframes, max_iterations);
}

void LocalMap::retire_gross_outliers(int slot) {
  tracks.sift_active([&](int index) {
    Track& track = tracks[index];
    if (track.host == slot ||
        check_track(track, window, focal_px_, kOutlierPx).newest_px <= kGrossOutlierPx) {
      return TrackTable::Fate::kStay;
    }
    track.remove_observation(slot);
    return TrackTable::Fate::kRetire;
  });
}

void LocalMap::free_outliers() {
  const auto good = [this](int index) {
    const TrackFit f = check_track(tracks[index], window, focal_px_, kOutlierPx);
    return f.newest_px <= kNewestOutlierPx && !(f.num >= 3 && 2 * f.num_bad > f.num);
  };
  tracks.sift_active(
      [&](int index) { return good(index) ? TrackTable::Fate::kStay : TrackTable::Fate::kFree; });
  tracks.sift_passive(good);
}

}  // namespace plumb::vo
