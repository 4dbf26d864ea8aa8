/// A corner followed through the window, with its inverse depth in its host keyframe.
///
/// Frames   img for px; xy are undistorted normalised coordinates (X/Z, Y/Z) in cam, as seen at the image's own time:
///          under a rolling shutter px is where the row was exposed, and lies off xy by `row_shift`.
/// Units    rho in 1/[vo]: 1/Z in the host keyframe.
/// Memory   a table of fixed capacity; tracks never move, lists hold their indices.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace plumb::vo {

inline constexpr int kMaxFrames = 12;  ///< slots of the window
inline constexpr double kMinRho = 1e-5;
inline constexpr double kUnknownRhoStd = 0.3;  ///< of a depth that nothing has shown yet [1/vo]

struct Track {
  int host = -1;  ///< window slot of the host keyframe
  Eigen::Vector2d host_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d host_xy = Eigen::Vector2d::Zero();
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< newest position
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  Eigen::Vector2d prev_px = Eigen::Vector2d::Zero();  ///< the one before
  Eigen::Vector2d prev_xy = Eigen::Vector2d::Zero();
  Eigen::Vector2d row_shift = Eigen::Vector2d::Zero();  ///< of xy, by its row's time

  double rho = 0.0;
  double rho_std = 0.0;
  double prior_rho = 0.0;
  double prior_std = 0.0;

  std::uint32_t seen = 0;  ///< bit per window slot
  std::array<Eigen::Vector2d, kMaxFrames> obs_xy{};
  std::array<Eigen::Vector2f, kMaxFrames> obs_row_shift{};

  int num_images = 0;    ///< that saw it, the host's included
  bool on_road = false;  ///< its patch moves like the road's

  [[nodiscard]] bool seen_in(int slot) const { return (seen >> slot & 1U) != 0; }
  void observe(int slot, const Eigen::Vector2d& where_xy,
               const Eigen::Vector2d& where_row_shift = Eigen::Vector2d::Zero()) {
    seen |= 1U << slot;
    obs_xy[static_cast<std::size_t>(slot)] = where_xy;
    obs_row_shift[static_cast<std::size_t>(slot)] = where_row_shift.cast<float>();
  }
  void forget(int slot) { seen &= ~(1U << slot); }
  [[nodiscard]] const Eigen::Vector2d& xy_in(int slot) const {
    return obs_xy[static_cast<std::size_t>(slot)];
  }
  /// Where the image of `slot` shows it, in normalised coordinates.
  [[nodiscard]] Eigen::Vector2d shown_xy_in(int slot) const {
    return xy_in(slot) + obs_row_shift[static_cast<std::size_t>(slot)].cast<double>();
  }
};

/// Pool of tracks. `active` ones are in the newest image; `passive` ones have left it but still tie frames.
class TrackTable {
 public:
  explicit TrackTable(int capacity);

  [[nodiscard]] Track& operator[](int index) { return tracks_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Track& operator[](int index) const {
    return tracks_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const std::vector<int>& active() const { return active_; }
  [[nodiscard]] const std::vector<int>& passive() const { return passive_; }

  /// Index of a fresh active track, -1 when the pool is empty.
  int add();
  void clear();

  /// Sorts active tracks by `fate(index)`: they stay, become passive or are freed.
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

  /// Frees the passive tracks for which `keep(index)` is false.
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
