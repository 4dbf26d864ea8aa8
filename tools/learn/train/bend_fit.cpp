#include "tools/learn/train/bend_fit.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "tools/learn/train/fit.hpp"

namespace plumb {
namespace {

constexpr std::size_t kFewestFrames = 20;
constexpr double kLeastCorrelationLengthRatio = 0.1;

struct BendFrame {
  double seq = 0.0;
  double step_ratio = 0.0;
  double bend = 0.0;
  double ln_height_ratio = 0.0;
};

std::vector<BendFrame> bends_of(const DriveSamples& drive) {
  std::vector<BendFrame> frames;
  for (const Sample& s : drive.frames) {
    if (!(s.has_plane > 0.5) || !std::isfinite(s.chord_err)) continue;
    frames.push_back(
        {s.seq, s.step_ratio, s.chord_err, std::log(s.true_height_m / s.nominal_height_m)});
  }
  return frames;
}

}  // namespace

std::optional<RoadBend> fit_bend(const std::vector<DriveSamples>& drives) {
  std::size_t num = 0;
  double weights = 0.0, steps = 0.0, square_sum = 0.0, product_sum = 0.0;
  std::vector<std::vector<TimedError>> bends;
  for (const DriveSamples& drive : drives) {
    bends.emplace_back();
    const std::vector<BendFrame> frames = bends_of(drive);
    const double weight = drive_weight(frames.size());
    for (const BendFrame& frame : frames) {
      weights += weight;
      steps += frame.step_ratio;
      square_sum += weight * square(frame.bend);
      product_sum += weight * frame.bend * frame.ln_height_ratio;
      bends.back().push_back({frame.seq, frame.bend});
    }
    num += frames.size();
  }
  if (num < kFewestFrames || !(square_sum > 0.0)) return std::nullopt;
  RoadBend bend;
  bend.start_std = std::sqrt(square_sum / weights);
  bend.height_slope = product_sum / square_sum;
  for (auto& drive : bends)
    for (TimedError& frame : drive) frame.sigmas /= bend.start_std;
  bend.correlation_length_ratio = std::max(
      kLeastCorrelationLengthRatio,
      correlation_length_of(correlated_images_of(bends), steps / static_cast<double>(num)));
  return bend;
}

}  // namespace plumb
