/// Tests the whole fit: cues, correlation lengths, bends, standard deviations of a drive, the
/// published method's lines, and the scores of drives that are held out.
#include "tools/learn/train/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/ground/covariance/learned_covariance.hpp"
#include "tests/train/drawn.hpp"

namespace plumb {
namespace {

std::vector<DriveSamples> three_drives(double ln_height_std = 0.01, double correlation = 0.0) {
  return {test::draw_drive("a", 300, 1, ln_height_std, correlation),
          test::draw_drive("b", 300, 2, ln_height_std, correlation),
          test::draw_drive("c", 300, 3, ln_height_std, correlation)};
}

double std_of(const LogVariance& model) { return std::sqrt(model.of({})); }

TEST(Fit, FindsTheDeviationsOfEveryCue) {
  const GroundModel model = fit_targets(three_drives(), built_in_ground_model());
  EXPECT_NEAR(std_of(model.dense_height), 0.01, 0.0015);
  EXPECT_NEAR(std_of(model.dense_n1), 0.005, 0.0008);
  EXPECT_NEAR(std_of(model.dense_n3), 0.004, 0.0006);
  EXPECT_NEAR(std_of(model.points), 0.02, 0.003);
  EXPECT_NEAR(std_of(model.chord), 0.005, 0.0008);
}

TEST(Fit, FindsHowLongErrorsStayAlike) {
  const double correlation = 0.8;
  const GroundModel model = fit_targets(three_drives(0.01, correlation), built_in_ground_model());
  // In a first-order process, (1 + r) / (1 - r) = 9 images share one error. The sum is cut off at
  // 15 images.
  EXPECT_NEAR(correlated_images(model.dense_correlation_length_ratio, 0.5), 9.0, 2.5);
  EXPECT_LT(correlated_images(model.points_correlation_length_ratio, 0.5), 2.0);
}

TEST(Fit, TurnsCorrelatedImagesIntoACorrelationLengthAndBack) {
  for (const double num_images : {1.5, 4.0, 20.0})
    EXPECT_NEAR(correlated_images(correlation_length_of(num_images, 0.6), 0.6), num_images, 1e-9);
  EXPECT_EQ(correlation_length_of(1.0, 0.6), 0.0);
  EXPECT_NEAR(correlated_images(0.0, 0.6), 1.0, 1e-12);
}

TEST(Fit, WidensWhereDrivesDifferMoreThanTheirFrames) {
  auto drives = three_drives();
  for (Sample& s : drives[1].frames) s.points_err += 0.05;  // this drive's points are all 5 % off
  const double with = std_of(fit_targets(drives, built_in_ground_model()).points);
  const double without = std_of(fit_targets(three_drives(), built_in_ground_model()).points);
  EXPECT_GT(with, 1.7 * without);
}

TEST(Fit, LeavesWhatSamplesSayNothingAboutAsItWas) {
  auto drives = three_drives();
  for (DriveSamples& drive : drives)
    for (Sample& s : drive.frames) s.points_err = Sample::kNone;
  GroundModel start = built_in_ground_model();
  start.points.ln_var = -3.25;
  EXPECT_EQ(fit_targets(drives, start).points.ln_var, -3.25);
}

TEST(Fit, TellsTiltFromHeightWhereThereIsNoTruePlane) {
  auto drives = three_drives();
  for (DriveSamples& drive : drives) {
    for (Sample& s : drive.frames) {
      s.has_plane = 0.0;
      s.dense_err_n1 = s.dense_err_n3 = s.chord_err = Sample::kNone;
      s.chord_ref = 0.0;
    }
  }
  GroundModel start = built_in_ground_model();
  EXPECT_NEAR(std_of(fit_targets(drives, start).dense_n3), 0.004, 0.0008);
}

TEST(Fit, ChoosesTheDriveDeviationOfTheScaleThatMakesReportedOnesTrue) {
  auto drives = three_drives();
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  for (DriveSamples& drive : drives) {
    drive.algorithm = "learned";
    for (Sample& s : drive.frames) {
      s.out_scale_err = 0.05 * normal(random);
      s.out_scale_var = 0.03 * 0.03 + 1e-4;  // 1e-4 of it comes from the model of that run
      s.out_scale_bias_var = 1e-4;
    }
  }
  GroundModel model;
  fit_scale_bias(drives, &model);
  EXPECT_NEAR(model.ln_scale_bias_std, 0.04, 0.004);
}

/// Draws three drives in which the filter states 0.002 rad for the plane. The plane's errors grow
/// with the dense cue's residuals.
std::vector<DriveSamples> three_planes(double added_var_of_that_run) {
  auto drives = three_drives();
  std::mt19937_64 random(10);
  std::normal_distribution<double> normal;
  for (DriveSamples& drive : drives) {
    drive.algorithm = "learned";
    for (Sample& s : drive.frames) {
      const double apart = std::abs(0.01 * normal(random));
      const double filter_var = 0.002 * 0.002;
      s.out_dense_n1_square = s.out_dense_n3_square = apart * apart;
      s.out_chord_square = 0.0;
      s.out_pitch_added_var = s.out_roll_added_var = s.out_height_added_var = added_var_of_that_run;
      s.out_pitch_var = s.out_roll_var = s.out_height_var = filter_var + added_var_of_that_run;
      const double std = std::sqrt(filter_var + 1e-6 * (1.0 + apart * apart / 9e-6));
      s.out_pitch_err = std * normal(random);
      s.out_roll_err = std * normal(random);
      s.out_height_err = std * normal(random);
    }
  }
  return drives;
}

TEST(Fit, FindsWhatTheReportedPlaneErrsBesideItsFilter) {
  const GroundModel model = fit_targets(three_planes(0.0), built_in_ground_model(), kPlaneTargets);
  const CueFeatures agree = plane_features(0.0, 0.0, 0.0, 0.5);
  const CueFeatures dispute = plane_features(1e-4, 0.0, 0.0, 0.5);
  for (const LogVariance* v : {&model.plane_pitch, &model.plane_roll, &model.plane_height}) {
    EXPECT_NEAR(std::sqrt(v->of(agree)), 0.001, 0.0006);
    EXPECT_NEAR(std::sqrt(v->of(dispute)), std::sqrt(1e-6 * (1.0 + 1e-4 / 9e-6)), 0.001);
  }
  EXPECT_EQ(model.points.ln_var, built_in_ground_model().points.ln_var);
}

TEST(Fit, FindsTheSameModelOfThePlaneWhateverTheRunAdded) {
  const GroundModel start = built_in_ground_model();
  const GroundModel none = fit_targets(three_planes(0.0), start, kPlaneTargets);
  const GroundModel much = fit_targets(three_planes(1e-4), start, kPlaneTargets);
  EXPECT_NEAR(much.plane_pitch.ln_var, none.plane_pitch.ln_var, 1e-6);
  EXPECT_NEAR(much.plane_roll.slopes[kPlaneDense], none.plane_roll.slopes[kPlaneDense], 1e-6);
}

TEST(Fit, LeavesThePlaneToRunsWithALearnedModel) {
  auto drives = three_planes(0.0);
  for (DriveSamples& drive : drives) drive.algorithm = "fixed";
  const GroundModel start = built_in_ground_model();
  EXPECT_EQ(fit_targets(drives, start).plane_pitch.ln_var, start.plane_pitch.ln_var);
}

TEST(Fit, FindsHowObjectsErrByTheirOwnVarianceAndHowLong) {
  auto drives = three_drives();
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (DriveSamples& drive : drives) {
    double memory = normal(random);
    for (std::size_t i = 0; i < drive.frames.size(); ++i) {
      memory = 0.6 * memory + 0.8 * normal(random);
      const double confidence = 1e-5 * (1.0 + 3.0 * static_cast<double>(i % 50) / 50.0);
      drive.frames[i].objects_confidence = confidence;
      drive.frames[i].objects_err_n3 = std::sqrt(2.0 * confidence) * memory;
    }
  }
  GroundModel model = built_in_ground_model();
  const auto fit = fit_objects(drives, &model);
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(model.objects_n3.slope, 2.0, 0.5);
  EXPECT_NEAR(model.objects_n3.of(2e-5), 4e-5, 5e-6);
  EXPECT_NEAR(model.objects_correlated_images, (1.0 + 0.6) / (1.0 - 0.6), 1.2);
}

TEST(Fit, WithoutObjectsTheirModelStays) {
  GroundModel model = built_in_ground_model();
  model.objects_correlated_images = 7.5;
  EXPECT_FALSE(fit_objects(three_drives(), &model).has_value());
  EXPECT_EQ(model.objects_correlated_images, 7.5);
}

TEST(Fit, ScoresADriveWithAModelThatDidNotSeeIt) {
  auto drives = three_drives();
  for (Sample& s : drives[2].frames) s.points_err *= 3.0;
  const auto scores = leave_one_out(drives, built_in_ground_model());
  ASSERT_EQ(scores.size(), 3U * (kTargets.size() - kPlaneTargets.size()));
  for (const HeldOutScore& s : scores) {
    // The direction of translation is compared with itself five frames before.
    EXPECT_EQ(s.learned.num, s.target == Target::kChord ? 295 : 300) << s.drive;
    if (s.target != Target::kPoints) continue;
    if (s.drive == "c") {
      EXPECT_NEAR(s.learned.nees, 9.0, 2.5);  // The other drives do not show this error.
    }
    if (s.drive == "a") {
      EXPECT_LT(s.learned.nees, 1.0);  // c widens the model
    }
    double square = 0.0;
    const DriveSamples& drive = drives[static_cast<std::size_t>(s.drive[0] - 'a')];
    for (const Sample& sample : drive.frames) square += sample.points_err * sample.points_err;
    EXPECT_NEAR(s.hand.nees, square / 300.0 / 3.2e-3, 1e-9);
  }
}

TEST(ConfidenceLine, HasBinsOfEqualCount) {
  std::vector<Confidence> confidences;
  for (int i = 0; i < 1000; ++i) confidences.push_back({(7 * i % 1000) * 0.01, 1.0});
  const auto bins = bin_confidences(confidences, kNumConfidenceBins);
  ASSERT_EQ(bins.size(), 100U);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    EXPECT_EQ(bins[i].num, 10);
    EXPECT_NEAR(bins[i].centre, 0.1 * static_cast<double>(i) + 0.045, 1e-9);
  }
  EXPECT_EQ(bin_confidences({{1.0, 1.0}, {2.0, 1.0}, {3.0, 1.0}}, 100).size(), 1U);
}

TEST(ConfidenceLine, FindsTheLineThatErrorsWereDrawnFrom) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::vector<Confidence> confidences;
  for (int i = 0; i < 20000; ++i) {
    const double confidence = 0.02 + 0.2 * i / 20000.0;
    confidences.push_back({confidence, normal(random) * std::sqrt(0.002 + 0.02 * confidence)});
  }
  const LinearVariance line = fit_line(bin_confidences(confidences, kNumConfidenceBins));
  EXPECT_NEAR(line.offset, 0.002, 3e-4);
  EXPECT_NEAR(line.slope, 0.02, 0.003);
  EXPECT_GT(line.most, line.mean);
  EXPECT_LT(line.least, line.mean);
}

}  // namespace
}  // namespace plumb
