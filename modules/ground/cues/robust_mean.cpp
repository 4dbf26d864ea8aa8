#include "modules/ground/cues/robust_mean.hpp"

#include <algorithm>

namespace plumb {
namespace {

constexpr double kTukeySigmas = 4.0;
constexpr int kIterations = 8;

double weighted_median(const Votes& votes) {
  std::array<std::size_t, kMaxVotes> order{};
  double total = 0.0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    order[i] = i;
    total += 1.0 / votes[i].std;
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(votes.size()),
            [&](std::size_t a, std::size_t b) {
              return votes[a].value < votes[b].value || (votes[a].value == votes[b].value && a < b);
            });
  double below = 0.0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    below += 1.0 / votes[order[i]].std;
    if (below >= 0.5 * total) return votes[order[i]].value;
  }
  return votes[order[votes.size() - 1]].value;
}

}  // namespace

double robust_mean(Votes* votes) {
  double centre = weighted_median(*votes);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    double sum = 0.0;
    double information = 0.0;
    for (Vote& vote : *votes) {
      const double e = (vote.value - centre) / (kTukeySigmas * vote.std);
      vote.weight = e * e < 1.0 ? (1.0 - e * e) * (1.0 - e * e) : 0.0;
      sum += vote.weight * vote.value / (vote.std * vote.std);
      information += vote.weight / (vote.std * vote.std);
    }
    if (!(information > 0.0)) break;
    centre = sum / information;
  }
  return centre;
}

}  // namespace plumb
