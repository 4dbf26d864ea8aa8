/// Draws samples from known models.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tools/learn/train/sample_file.hpp"
#include "tools/learn/train/variance_fit.hpp"

namespace plumb::test {

/// Draws features uniformly from the range of real ones. A share of `outliers` of the errors is
/// fifty times too large.
inline std::vector<VarianceRow> draw_rows(const LogVariance& model, int num, std::uint64_t seed,
                                          double extra_var, double outliers) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<VarianceRow> rows;
  for (int i = 0; i < num; ++i) {
    VarianceRow row;
    row.features = {2.0 * uniform(random) - 1.0, uniform(random), 2.0 * uniform(random),
                    2.0 * uniform(random) - 1.0};
    row.extra_var = extra_var;
    row.error = normal(random) * std::sqrt(model.of(row.features) + extra_var);
    if (uniform(random) < outliers) row.error *= 50.0;
    rows.push_back(row);
  }
  return rows;
}

/// Draws a straight drive with true planes. The dense cue has these standard deviations, the points
/// scatter by 2 % and the direction of translation by 0.3 degrees. The errors of neighbouring
/// frames are correlated by `correlation`.
inline DriveSamples draw_drive(const std::string& name, int num, std::uint64_t seed,
                               double ln_height_std, double correlation = 0.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  DriveSamples drive{name, "fixed", {}};
  double memory = normal(random);
  for (int i = 0; i < num; ++i) {
    memory = correlation * memory + std::sqrt(1.0 - correlation * correlation) * normal(random);
    Sample s;
    s.seq = i;
    s.has_plane = 1.0;
    s.true_height_m = s.nominal_height_m = 1.65;
    s.truth_ln_std = 0.0;
    s.turn_ratio = 0.0;
    s.step_ratio = 0.5;
    s.dense_used = 1.0;
    s.dense_ncc = 1.0;
    s.dense_pixel_var_n1 = s.dense_pixel_var_n3 = s.dense_pixel_var_given = 1e-6;
    s.dense_slope_n3 = 5.0;
    s.dense_err_n1 = 0.005 * normal(random);
    s.dense_err_n3 = 0.004 * normal(random);
    s.dense_err_given = ln_height_std * memory;
    s.dense_err_height = s.dense_err_given + 5.0 * s.dense_err_n3;
    s.dense_given_ref_var = 0.0;
    s.dense_hand_var_n1 = s.dense_hand_var_n3 = 4.9e-5;
    s.dense_hand_var_given = 9e-4;
    s.points_used = 1.0;
    s.points_num_inliers = 10.0;
    s.points_spread = 0.02;
    s.points_err = 0.02 * normal(random);
    s.points_ref_var = 0.0;
    s.points_hand_var = 3.2e-3;
    s.chord_err = s.chord_ref = 0.005 * normal(random);
    s.chord_num_frames = 5.0;
    s.chord_hand_var = 2.7e-5;
    drive.frames.push_back(s);
  }
  return drive;
}

}  // namespace plumb::test
