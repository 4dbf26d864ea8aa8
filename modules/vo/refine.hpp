/// Windowed refinement: all free frames and all inverse depths at once, by Gauss-Newton with a Schur complement.
///
/// Cost    sum rho_cauchy(|r|^2), r in pixels, host -> every other frame that saw the track.
/// Gauge   the oldest keyframes are held, which carries the unit of length and the past.
/// Memory  normal equations for the largest window and every track, in place.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "modules/vo/projection.hpp"
#include "modules/vo/track.hpp"
#include "modules/vo/window.hpp"

namespace plumb::vo {

class WindowRefiner {
 public:
  explicit WindowRefiner(int track_capacity);

  /// Refines in place; `fixed_keyframes` of the oldest stay (fewer while the window is young).
  void refine(Window& window, TrackTable& tracks, const Eigen::Vector2d& focal_px,
              int fixed_keyframes, int max_iterations);

 private:
  static constexpr int kMaxFree = kMaxFrames - 1;
  static constexpr std::size_t kNumBlocks = std::size_t{kMaxFree} * kMaxFree;
  struct Coupling {
    int free = 0;  // index of the free frame
    Vector6d w;    // sum weight J_pose^T d, d = dr/drho
  };
  struct Structure {  // one track's part of the normal equations
    int track = 0;
    double hrr = 0.0;
    double br = 0.0;
    int num_couplings = 0;
    std::array<Coupling, kMaxFrames> couplings;
    double rho_before = 0.0;
  };

  void choose(const Window& window, const TrackTable& tracks, int fixed_keyframes);
  void build(const Window& window, const TrackTable& tracks, const Eigen::Vector2d& focal_px);
  void add_track(const Window& window, const TrackTable& tracks, const Eigen::Vector2d& focal_px,
                 Structure* s);
  void eliminate(Structure& s);
  [[nodiscard]] bool solve();
  void save(const Window& window, const TrackTable& tracks);
  void restore(Window& window, TrackTable& tracks) const;
  void apply(Window& window, TrackTable& tracks);

  Matrix6d& block(int row, int col) {
    return blocks_[static_cast<std::size_t>(row) * kMaxFree + static_cast<std::size_t>(col)];
  }

  std::vector<Structure> structures_;
  std::size_t num_structures_ = 0;
  std::array<int, kMaxFrames> free_of_slot_{};  // -1: fixed or not in the window
  FixedVector<int, kMaxFrames> free_slots_;
  std::array<Se3, kMaxFrames> T_world_cam_;
  std::array<Matrix6d, kNumBlocks> blocks_;  // upper triangle
  std::array<Vector6d, kMaxFree> gradient_;
  std::array<Vector6d, kMaxFree> step_;
  std::array<double, 36 * kNumBlocks> dense_{};
  std::array<double, std::size_t{6} * kMaxFree> rhs_{};
  std::array<Se3, kMaxFrames> saved_poses_;
  double damping_ = 0.0;
  double cost_ = 0.0;
};

/// How well one track fits the window as it stands.
struct TrackFit {
  int num = 0;
  int num_bad = 0;
  double newest_px = 0.0;  ///< residual in the newest frame of the window that saw it
};
[[nodiscard]] TrackFit check_track(const Track& track, const Window& window,
                                   const Eigen::Vector2d& focal_px, double bad_px);

}  // namespace plumb::vo
