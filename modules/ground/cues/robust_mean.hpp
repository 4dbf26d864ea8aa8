/// Robust weighted mean of a few scalar votes: a minority of outliers has no influence.
///
/// Memory:
///   kMaxVotes in place.
#pragma once

#include <array>
#include <cstddef>

#include "core/fixed_vector.hpp"

namespace plumb {

struct Vote {
  double value = 0.0;
  double std = 0.0;     ///< > 0, of this vote if it is an inlier
  double weight = 0.0;  ///< result: 0 (outlier) .. 1
};

inline constexpr std::size_t kMaxVotes = 66;
using Votes = FixedVector<Vote, kMaxVotes>;

/// Takes the weighted median of the votes, then the mean with Tukey's biweight about it. Fills the
/// weights.
/// @pre at least one vote
double robust_mean(Votes* votes);

}  // namespace plumb
