/// The vote of the paper, equation (8): the height of the point on which most other points agree.
///
/// Units:
///   The caller's unit of length.
#pragma once

#include <cstddef>
#include <span>

namespace plumb {

struct HeightVote {
  bool ok = false;      ///< at least two heights took part
  double height = 0.0;  ///< of the winner
  double score = 0.0;   ///< q = max_i sum_{j != i} exp(-mu (h_i - h_j)^2)
};

/// @param mu  [1 / unit of height^2]
[[nodiscard]] HeightVote vote_height(std::span<const double> heights, double mu);

/// The same vote in an unknown unit: each candidate is scored in the unit in which its own height
/// is `true_height`. Heights <= 0 do not take part.
[[nodiscard]] HeightVote vote_height_any_unit(std::span<const double> heights, double mu,
                                              double true_height);

}  // namespace plumb
