/// A corner that is tracked through the window, and its inverse depth in its host keyframe.
///
/// Frames:
///   img for px. xy are undistorted normalised coordinates (X/Z, Y/Z) in cam at the image's time
///   stamp. With a rolling shutter, the row of px is exposed at another time, and the corner is
///   shown at xy + row_shift.
/// Units:
///   rho = 1/Z in the host keyframe, in 1/[vo].
/// Memory:
///   A pool of fixed capacity, allocated by TrackTable's constructor. Tracks never move; lists have
///   their indices.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace plumb::vo {

inline constexpr int kMaxFrames = 12;  ///< number of slots in the window
inline constexpr double kMinRho = 1e-5;
/// Standard deviation of an inverse depth that is not measured yet [1/vo].
inline constexpr double kUnknownRhoStd = 0.3;

struct Track {
  int host = -1;                                      ///< window slot of the host keyframe
  Eigen::Vector2d host_px = Eigen::Vector2d::Zero();  ///< position in the host's image
  Eigen::Vector2d host_xy = Eigen::Vector2d::Zero();
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< position in the newest image
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  Eigen::Vector2d prev_px = Eigen::Vector2d::Zero();  ///< position in the previous image
  /// Motion of xy between the image's time stamp and the exposure of its row; 0 for a global
  /// shutter.
  Eigen::Vector2d row_shift = Eigen::Vector2d::Zero();

  double rho = 0.0;
  double rho_std = 0.0;
  double prior_rho = 0.0;  ///< estimate of rho before the observations
  double prior_std = 0.0;

  std::uint32_t seen = 0;  ///< one bit per slot of the window
  std::array<Eigen::Vector2d, kMaxFrames> obs_xy{};
  std::array<Eigen::Vector2f, kMaxFrames> obs_row_shift{};

  int num_images = 0;    ///< number of images that saw it, including the host's
  bool on_road = false;  ///< its patch is warped like a part of the road

  [[nodiscard]] bool seen_in(int slot) const { return (seen >> slot & 1U) != 0; }
  void observe(int slot, const Eigen::Vector2d& where_xy,
               const Eigen::Vector2d& where_row_shift = Eigen::Vector2d::Zero()) {
    seen |= 1U << slot;
    obs_xy[static_cast<std::size_t>(slot)] = where_xy;
    obs_row_shift[static_cast<std::size_t>(slot)] = where_row_shift.cast<float>();
  }
  void remove_observation(int slot) { seen &= ~(1U << slot); }
  [[nodiscard]] const Eigen::Vector2d& xy_in(int slot) const {
    return obs_xy[static_cast<std::size_t>(slot)];
  }
  /// Returns the normalised coordinates at which the image of `slot` shows it.
  [[nodiscard]] Eigen::Vector2d shown_xy_in(int slot) const {
    return xy_in(slot) + obs_row_shift[static_cast<std::size_t>(slot)].cast<double>();
  }
};

/// A pool of tracks. The active ones are seen in the newest image. The passive ones are no longer
/// seen, but still connect frames of the window.
class TrackTable {
 public:
  explicit TrackTable(int capacity);

  [[nodiscard]] Track& operator[](int index) { return tracks_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Track& operator[](int index) const {
    return tracks_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const std::vector<int>& active() const { return active_; }
  [[nodiscard]] const std::vector<int>& passive() const { return passive_; }

  /// Adds an active track and returns its index, or -1 when the pool is exhausted.
  int add();
  void clear();

  /// Calls `fate(index)` for every active track, which then stays, becomes passive or is freed.
  enum class Fate { kStay, kRetire, kFree };
  template <typename Decide>
  void sift_active(const Decide& fate) {
    std::size_t kept = 0;
    for (const int index : active_) {
      const Fate f = fate(index);
      if (f == Fate::kStay) active_[kept++] = index;
      if (f == Fate::kRetire) passive_.push_back(index);
      if (f == Fate::kFree) free_.push_back(index);
    }
    active_.resize(kept);
  }

  /// Frees the passive tracks for which `keep(index)` returns false.
  template <typename Keep>
  void sift_passive(const Keep& keep) {
    std::size_t kept = 0;
    for (const int index : passive_) {
      if (keep(index)) {
        passive_[kept++] = index;
      } else {
        free_.push_back(index);
      }
    }
    passive_.resize(kept);
  }

 private:
  std::vector<Track> tracks_;
  std::vector<int> active_;
  std::vector<int> passive_;
  std::vector<int> free_;
};

}  // namespace plumb::vo
