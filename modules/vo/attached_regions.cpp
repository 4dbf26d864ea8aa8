#include "modules/vo/attached_regions.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace plumb::vo {
namespace {

// Standard deviation of a place in the image, and how far an attached track may seem to move: by
// noise, and when the camera shakes against the dashboard.
constexpr double kPlaceStd_px = 1.0;
constexpr double kMostMoved_px = 2.0;
constexpr double kMostShaken_px = 4.0;
// Most of what one track can say in an image, what it says when it has moved, and when it has
// stayed where no point of the world could. Images that follow each other say nearly the same.
constexpr double kMostVote = 0.5;
constexpr double kMovedVote = -0.5;
constexpr double kStayedVote = 0.5;
// The share of a vote that the neighbours of a cell get: what is attached is seldom small.
constexpr float kNeighbourShare = 0.25F;

// Sums from which on a cell is attached, and until it is no longer, and the least sum.
constexpr float kAttached = 12.0F;
constexpr float kNoLonger = 6.0F;
constexpr float kLeastSumOfCell = -8.0F;
// A cell that is not searched is tried again after a minute at the most.
constexpr double kForget_per_s = 0.3;

double vote_of(const TrackMotion& motion) {
  if (motion.must_move) {
    if (motion.moved_px > kMostShaken_px) return kMovedVote;
    // What follows the rotation drives along.
    return motion.moved_px > motion.off_px + kPlaceStd_px ? 0.0 : kStayedVote;
  }
  if (motion.moved_px > kMostMoved_px) return kMovedVote;
  const double likelihood =
      (square(motion.off_px) - square(motion.moved_px)) / (2.0 * square(kPlaceStd_px));
  return std::clamp(likelihood, -kMostVote, kMostVote);
}

}  // namespace

AttachedRegions::AttachedRegions(int width_px, int height_px)
    : num_columns_(num_cells(width_px)), num_rows_(num_cells(height_px)) {
  const auto count = static_cast<std::size_t>(num_columns_ * num_rows_);
  evidence_.resize(count);
  is_attached_.resize(count);
}

std::size_t AttachedRegions::index_of(const Eigen::Vector2d& px) const {
  const int column = std::clamp(static_cast<int>(px.x()) / kCellPx, 0, num_columns_ - 1);
  const int row = std::clamp(static_cast<int>(px.y()) / kCellPx, 0, num_rows_ - 1);
  return static_cast<std::size_t>(row * num_columns_ + column);
}

void AttachedRegions::add(const TrackMotion& motion) {
  const auto evidence = static_cast<float>(vote_of(motion));
  const auto index = static_cast<int>(index_of(motion.px));
  const int column = index % num_columns_;
  const int row = index / num_columns_;
  vote(column, row, evidence);
  for (const int step : {-1, 1}) {
    vote(column + step, row, kNeighbourShare * evidence);
    vote(column, row + step, kNeighbourShare * evidence);
  }
}

void AttachedRegions::vote(int column, int row, float evidence) {
  if (column < 0 || column >= num_columns_ || row < 0 || row >= num_rows_) return;
  float& sum = evidence_[static_cast<std::size_t>(row * num_columns_ + column)];
  sum = std::clamp(sum + evidence, kLeastSumOfCell, kMostEvidence);
}

void AttachedRegions::end_image(double dt_s) {
  const auto forgotten = static_cast<float>(kForget_per_s * dt_s);
  num_attached_ = 0;
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    if (is_attached_[i] != 0) evidence_[i] -= forgotten;
    is_attached_[i] = evidence_[i] > (is_attached_[i] != 0 ? kNoLonger : kAttached) ? 1 : 0;
    num_attached_ += is_attached_[i];
  }
}

void AttachedRegions::restore(std::span<const float> evidence) {
  num_attached_ = 0;
  for (std::size_t i = 0; i < evidence_.size(); ++i) {
    evidence_[i] = std::clamp(evidence[i], kLeastSumOfCell, kMostEvidence);
    is_attached_[i] = evidence_[i] > kAttached ? 1 : 0;
    num_attached_ += is_attached_[i];
  }
}

double AttachedRegions::share() const {
  return static_cast<double>(num_attached_) / static_cast<double>(evidence_.size());
}

}  // namespace plumb::vo
