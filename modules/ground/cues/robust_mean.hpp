/// Weighted mean of a few scalar votes that a minority of wrong ones cannot drag.
///
/// Memory   kMaxVotes in place.
#pragma once

#include <array>
#include <cstddef>

#include "core/fixed_vector.hpp"

namespace plumb {

struct Vote {
  double value = 0.0;
  double std = 0.0;     ///< > 0, of this vote if it is not wrong
  double weight = 0.0;  ///< result: 0 (wrong) .. 1
};

inline constexpr std::size_t kMaxVotes = 66;
using Votes = FixedVector<Vote, kMaxVotes>;

/// Weighted median of the votes, then Tukey's mean about it. Fills the weights.
/// @pre at least one vote
double robust_mean(Votes* votes);

}  // namespace plumb
