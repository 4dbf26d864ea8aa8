#include "modules/ground_paper/height_vote.hpp"

#include <cmath>

namespace plumb {
namespace {

double score_of(std::span<const double> heights, std::size_t i, double mu) {
  double score = 0.0;
  for (std::size_t j = 0; j < heights.size(); ++j) {
    if (j == i) continue;
    const double apart = heights[i] - heights[j];
    score += std::exp(-mu * apart * apart);
  }
  return score;
}

}  // namespace

HeightVote vote_height(std::span<const double> heights, double mu) {
  HeightVote vote;
  if (heights.size() < 2) return vote;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double score = score_of(heights, i, mu);
    if (vote.ok && score <= vote.score) continue;
    vote = {true, heights[i], score};
  }
  return vote;
}

HeightVote vote_height_any_unit(std::span<const double> heights, double mu, double true_height) {
  HeightVote vote;
  if (heights.size() < 2) return vote;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (!(heights[i] > 0.0)) continue;
    const double per_unit = true_height / heights[i];
    const double score = score_of(heights, i, mu * per_unit * per_unit);
    if (vote.ok && score <= vote.score) continue;
    vote = {true, heights[i], score};
  }
  return vote;
}

}  // namespace plumb
