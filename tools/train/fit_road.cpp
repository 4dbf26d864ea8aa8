#include <algorithm>
#include <cmath>

#include "tools/train/fit.hpp"

namespace plumb {
namespace {

constexpr int kMostLag = 15;
// The slope that the geometry of a parabola gives between 5.5 and 20 m, and how far a fit may leave it: a flat drive
// says nothing.
constexpr double kPriorSlope = 2.5;
constexpr double kPriorWeight =
    2e-5;  // that many squared radians of bend weigh as much as the prior

struct BendRow {
  double seq = 0.0;
  double angle = 0.0;
  double ln_ratio = 0.0;
  double step_ratio = 0.0;
};

std::vector<BendRow> bend_rows(const DriveSamples& drive) {
  std::vector<BendRow> rows;
  for (const Sample& s : drive.frames) {
    const BendRow row{s.seq, s.travel_err, std::log(s.true_height_m / s.nominal_height_m),
                      s.step_ratio};
    if (s.has_plane > 0.5 && std::isfinite(row.angle) && std::isfinite(row.step_ratio))
      rows.push_back(row);
  }
  return rows;
}

}  // namespace

void fit_road(const std::vector<DriveSamples>& drives, GroundModel* model) {
  double xx = kPriorWeight;
  double xy = kPriorWeight * kPriorSlope;
  double num_drives = 0.0;
  std::vector<std::vector<BendRow>> all;
  for (const DriveSamples& drive : drives) {
    all.push_back(bend_rows(drive));
    const auto n = static_cast<double>(all.back().size());
    if (n < 2.0) continue;
    num_drives += 1.0;
    for (const BendRow& row : all.back()) {
      xx += row.angle * row.angle / n;
      xy += row.angle * row.ln_ratio / n;
    }
  }
  if (num_drives < 1.0) return;
  model->road_bend_slope = xy / xx;

  double square = 0.0, product = 0.0, step = 0.0, mean_square = 0.0;
  for (const auto& rows : all) {
    if (rows.size() < 2) continue;
    const auto n = static_cast<double>(rows.size());
    const auto rest = [&](const BendRow& r) {
      return r.ln_ratio - model->road_bend_slope * r.angle;
    };
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double e = rest(rows[i]);
      mean_square += e * e / n / num_drives;
      step += rows[i].step_ratio / n / num_drives;
      square += e * e;
      for (std::size_t k = i + 1; k < rows.size() && rows[k].seq - rows[i].seq <= kMostLag; ++k)
        product += 2.0 * e * rest(rows[k]);
    }
  }
  model->road_ln_height_std = std::sqrt(mean_square);
  const double repetition = square > 0.0 ? std::max(1.0, 1.0 + product / square) : 1.0;
  model->road_memory_ratio = memory_of_repetition(repetition, step);
}

}  // namespace plumb
