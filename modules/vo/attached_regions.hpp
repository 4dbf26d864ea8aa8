/// Learns which parts of the image show what is attached to the camera: a dashboard, a bonnet,
/// dirt, reflections of the cabin, a time stamp in the picture.
///
/// A track there keeps its place in the image. So does a far point of the world, but only until the
/// camera turns: then a far point moves with the rotation, and what is attached does not. And below
/// the horizon nothing of the world is far. Each track speaks for or against its place by how well
/// both explanations fit; the sum over the images decides for each cell of a grid. Cells that are
/// attached are not searched for features any more. They are tried again after some time.
///
/// While everything that VO tracks is attached, VO sees no rotation, and nothing can be learned
/// from it; then only the road below, when it is seen to pass, can tell.
///
/// Frames:
///   img.
/// Units:
///   Pixels, seconds.
/// Memory:
///   Two numbers per cell, allocated by the constructor.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace plumb::vo {

/// How a track moved up to the newest image.
struct TrackMotion {
  Eigen::Vector2d px;      ///< position
  double moved_px = 0.0;   ///< from its position in an earlier image
  double off_px = 0.0;     ///< from the nearest place where a point of the world could be now
  bool must_move = false;  ///< a point of the world at this place would have moved by far more
};

class AttachedRegions {
 public:
  static constexpr int kCellPx = 16;
  static constexpr float kMostEvidence = 24.0F;  ///< that a cell can have

  /// Number of cells along a side of an image.
  [[nodiscard]] static constexpr int num_cells(int side_px) {
    return (side_px + kCellPx - 1) / kCellPx;
  }

  AttachedRegions(int width_px, int height_px);

  /// Takes one track of an image in which the camera moved.
  void add(const TrackMotion& motion);
  /// Ends the image, `dt_s` after the one before.
  void end_image(double dt_s);

  /// Whether a feature at `px` would be one of what is attached. @pre px is inside the image
  [[nodiscard]] bool covers(const Eigen::Vector2d& px) const {
    return is_attached_[index_of(px)] != 0;
  }
  /// Calls `visit` with the first pixel of every attached cell.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; num_attached_ > 0 && i < is_attached_.size(); ++i) {
      const auto cell = static_cast<int>(i);
      if (is_attached_[i] != 0)
        visit(Eigen::Vector2i(cell % num_columns_ * kCellPx, cell / num_columns_ * kCellPx));
    }
  }
  /// What speaks for each cell, row by row: logarithms of the odds that it is attached.
  [[nodiscard]] std::span<const float> evidence() const { return evidence_; }
  /// Begins with what was known before. @pre evidence.size() is that of evidence()
  void restore(std::span<const float> evidence);
  /// Share of the image that is attached.
  [[nodiscard]] double share() const;

 private:
  [[nodiscard]] std::size_t index_of(const Eigen::Vector2d& px) const;
  void vote(int column, int row, float evidence);

  int num_columns_;
  int num_rows_;
  std::size_t num_attached_ = 0;
  std::vector<float> evidence_;
  std::vector<unsigned char> is_attached_;  // one per cell
};

}  // namespace plumb::vo
