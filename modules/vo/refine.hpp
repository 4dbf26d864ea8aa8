/// Bundle adjustment of the window: all free frames and all inverse depths together.
///
/// Cost:
///   sum C(|r|^2) over every track and every frame other than its host that saw it. r is the
///   residual in pixels and C the Cauchy kernel.
/// Method:
///   Levenberg-Marquardt. The inverse depths are eliminated by the Schur complement (Triggs et al.,
///   "Bundle Adjustment - A Modern Synthesis", 2000), and the reduced system of the frames is
///   solved by a dense Cholesky decomposition.
/// Gauge:
///   The oldest keyframes are constant. They keep the unit of length and the world frame.
/// Frames:
///   world: cam of the first image.
/// Memory:
///   Normal equations for the largest window in place; one Structure per track, allocated by the
///   constructor.
/// Errors:
///   A step that increases the cost is undone, and the next one has more damping. The last step is
///   not checked.
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

  /// Refines poses and inverse depths in place. The `fixed_keyframes` oldest keyframes are
  /// constant, or half of the keyframes while there are few; at least one.
  void refine(Window& window, TrackTable& tracks, const Eigen::Vector2d& focal_px,
              int fixed_keyframes, int max_iterations);

 private:
  static constexpr int kMaxFree = kMaxFrames - 1;
  static constexpr std::size_t kNumBlocks = std::size_t{kMaxFree} * kMaxFree;
  // A block of the normal equations between a track's inverse depth and a free frame.
  struct Coupling {
    int free = 0;  // index of the free frame
    Vector6d w;    // sum of weight J_pose^T d with d = dr/drho
  };
  // The part of the normal equations that concerns one track's inverse depth.
  struct Structure {
    int track = 0;     // index of the track
    double hrr = 0.0;  // sum of weight d^T d
    double br = 0.0;   // sum of weight d^T r
    int num_couplings = 0;
    std::array<Coupling, kMaxFrames> couplings;
    double rho_before = 0.0;  // before the last step
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

  // The block of the frames' normal equations in `row` and `col`, row <= col.
  Matrix6d& block(int row, int col) {
    return blocks_[static_cast<std::size_t>(row) * kMaxFree + static_cast<std::size_t>(col)];
  }

  std::vector<Structure> structures_;
  std::size_t num_structures_ = 0;
  std::array<int, kMaxFrames> free_of_slot_{};  // -1 for a constant frame or an unused slot
  FixedVector<int, kMaxFrames> free_slots_;     // slots of the free frames
  std::array<Se3, kMaxFrames> T_world_cam_;     // by slot
  std::array<Matrix6d, kNumBlocks> blocks_;     // upper triangle of the frames' normal equations
  std::array<Vector6d, kMaxFree> gradient_;
  std::array<Vector6d, kMaxFree> step_;
  std::array<double, 36 * kNumBlocks> dense_{};  // the same, row by row
  std::array<double, std::size_t{6} * kMaxFree> rhs_{};
  std::array<Se3, kMaxFrames> saved_poses_;
  double damping_ = 0.0;
  double cost_ = 0.0;
};

/// Residuals of one track in the frames of the window.
struct TrackFit {
  int num = 0;             ///< number of observations outside the host
  int num_bad = 0;         ///< number of those with a residual above `bad_px`
  double newest_px = 0.0;  ///< residual in the newest frame that saw it; 99 when it is behind it
};
[[nodiscard]] TrackFit check_track(const Track& track, const Window& window,
                                   const Eigen::Vector2d& focal_px, double bad_px);

}  // namespace plumb::vo
