/// Tests model files (the shipped file equals the built-in model, and a file that does not fit is
/// refused), features, bounds and covariances.
#include "modules/chain/model_file_source.hpp"
#include "plumb_paths.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "modules/ground/covariance/fixed_covariance.hpp"
#include "modules/ground/covariance/learned_covariance.hpp"
#include "modules/ground/types/plane_state.hpp"
#include "platform/config.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

const std::string kShipped = std::string(PLUMB_SOURCE_DIR) + "/config/ground_model.toml";

std::map<std::string, double> numbers_of(TrainedModels models) {
  std::map<std::string, double> numbers;
  const auto add = [&](const char* key, double& value, double, double, const char*) {
    numbers[key] = value;
  };
  GroundModel::visit(models.ground, add);
  PaperModel::visit(models.paper, add);
  return numbers;
}

/// Returns what load_models() says about the shipped file with `from` replaced by `to`.
std::string refusal(const std::string& from, const std::string& to) {
  std::string text = test::read_text(kShipped);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const test::TempFolder folder;
  const auto path = folder.write("model.toml", text);
  try {
    (void)load_models(path.string());
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(GroundModel, ShippedFileIsTheBuiltInOne) {
  EXPECT_EQ(numbers_of(load_models(kShipped)), numbers_of(TrainedModels{}));
  EXPECT_EQ(numbers_of(load_models("")), numbers_of(TrainedModels{}));
  EXPECT_FALSE(load_models(kShipped).ground.origin.drives.empty());
}

TEST(GroundModel, TextComesBackAsTheSameModel) {
  const TrainedModels model = load_models(kShipped);
  const test::TempFolder folder;
  const auto path = folder.write("model.toml", models_text(model));
  EXPECT_EQ(numbers_of(load_models(path.string())), numbers_of(model));
}

TEST(GroundModel, FileThatDoesNotFitIsRefusedWithItsReason) {
  EXPECT_NE(refusal("version = 4", "version = 3").find("model.toml:"), std::string::npos);
  EXPECT_NE(refusal("version = 4", "version = 3").find("model.version = 3"), std::string::npos);
  EXPECT_NE(refusal("plumb.ground_model", "other").find("model.schema"), std::string::npos);
  EXPECT_NE(refusal("[travel]\nln_var = ", "[travel]\nln_vars = ").find("travel.ln_var is missing"),
            std::string::npos);
  EXPECT_NE(refusal("[travel]\n", "[travel]\nspeed = 1.0\n").find("not a known key"),
            std::string::npos);
  EXPECT_NE(refusal("[travel]\nln_var = -", "[travel]\nln_var = 9").find("is outside"),
            std::string::npos);
  EXPECT_NE(refusal("[travel]\nln_var = ", "[travel]\nln_var = \"x\" #").find("is not a number"),
            std::string::npos);
  EXPECT_THROW((void)load_models("/nonexistent/model.toml"), ConfigError);
}

TEST(GroundModel, VarianceStaysBetweenItsBounds) {
  const LogVariance model{std::log(1e-4), {1.0, 0.0, 0.0, 0.0}, 0.005, 0.1};
  EXPECT_NEAR(model.of({}), 1e-4, 1e-12);
  EXPECT_NEAR(model.of({std::log(4.0), 0, 0, 0}), 4e-4, 1e-12);
  EXPECT_DOUBLE_EQ(model.of({-50.0, 0, 0, 0}), 0.005 * 0.005);
  EXPECT_DOUBLE_EQ(model.of({500.0, 0, 0, 0}), 0.1 * 0.1);
}

TEST(GroundModel, FeaturesAreZeroInAUsualFrameAndFiniteInAnyOther) {
  for (const double f : dense_features(1e-6, 1.0, 0.0, 0.5)) EXPECT_NEAR(f, 0.0, 1e-12);
  for (const double f : points_features(10.0, 0.02, 0.0, 0.5)) EXPECT_NEAR(f, 0.0, 1e-12);
  for (const double f : dense_features(0.0, -1.0, 1e9, 0.0)) EXPECT_TRUE(std::isfinite(f));
  for (const double f : points_features(0.0, 0.0, 1e9, 1e9)) EXPECT_TRUE(std::isfinite(f));
  EXPECT_GT(turn_feature(0.3), turn_feature(0.1));
  EXPECT_GT(step_feature(0.1), step_feature(0.5));
}

DenseMeasurement road_seen() {
  DenseMeasurement dense;
  dense.ok = true;
  dense.q = Eigen::Vector3d(0.01, 1.0, 0.02) / 1.6;
  Eigen::Matrix3d A;
  A << 900.0, 50.0, 300.0, 50.0, 700.0, 4000.0, 300.0, 4000.0, 26000.0;
  dense.information = A;
  dense.ncc = 0.95;
  return dense;
}

TEST(LearnedCovariance, IsMadeOfTheModelsVariances) {
  const GroundModel model = built_in_ground_model();
  const DenseMeasurement dense = road_seen();
  const CueContext context{0.01, 0.6};
  const Eigen::Matrix3d cov = LearnedCovariance(model).dense(dense, context);
  const Eigen::Matrix3d pixel = state_information(dense).inverse();
  const auto var = [&](const LogVariance& v, double p) {
    return v.of(dense_features(p, dense.ncc, context.turn_ratio, context.step_ratio));
  };
  EXPECT_NEAR(cov(0, 0), var(model.dense_n1, pixel(0, 0)), 1e-15);
  EXPECT_NEAR(cov(1, 1), var(model.dense_n3, pixel(1, 1)), 1e-15);
  // Once the normal is known, the variance of ln h is the model's.
  const double given = 1.0 / cov.inverse()(2, 2);
  EXPECT_NEAR(given, var(model.dense_height, 1.0 / state_information(dense)(2, 2)), 1e-9);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cov).eigenvalues().minCoeff(), 0.0);
}

TEST(LearnedCovariance, TrustsACueLessInATurnAndWithDoubt) {
  const LearnedCovariance learned(built_in_ground_model());
  DenseMeasurement dense = road_seen();
  const double straight = learned.dense(dense, {0.0, 0.6})(2, 2);
  EXPECT_GT(learned.dense(dense, {0.2, 0.6})(2, 2), 2.0 * straight);
  dense.ncc = 0.6;
  EXPECT_GT(learned.dense(dense, {0.0, 0.6})(2, 2), 1.5 * straight);
}

TEST(LearnedCovariance, DoubtsAPlaneWithLargeResiduals) {
  GroundModel model = built_in_ground_model();
  for (LogVariance* v : {&model.plane_pitch, &model.plane_roll, &model.plane_height})
    *v = {std::log(1e-6), {1.0, 0.5, 0.0, 0.0}, 1e-5, 0.1};
  const LearnedCovariance learned(model);
  PlaneContext context;
  context.cue = {0.0, 0.5};
  const PlaneVariance agree = learned.plane(context);
  EXPECT_NEAR(agree.pitch_rad2, 1e-6, 1e-12);
  EXPECT_NEAR(agree.roll_rad2, 1e-6, 1e-12);
  EXPECT_NEAR(agree.ln_height, 1e-6, 1e-12);
  context.dense_n3_square = 8.0 * 9e-6;  // ln(1 + 8) at a slope of one is a factor of nine
  EXPECT_NEAR(learned.plane(context).pitch_rad2, 9e-6, 1e-11);
  EXPECT_NEAR(learned.plane(context).ln_height, 9e-6, 1e-11);
  EXPECT_EQ(learned.plane(context).roll_rad2, agree.roll_rad2);
  context.chord_square = 8.0 * 9e-6;
  EXPECT_NEAR(learned.plane(context).pitch_rad2, 27e-6, 1e-11);
  context.dense_n1_square = 8.0 * 9e-6;
  EXPECT_NEAR(learned.plane(context).roll_rad2, 9e-6, 1e-11);
  EXPECT_EQ(FixedCovariance().plane(context).pitch_rad2, 0.0);
}

TEST(LearnedCovariance, CountsImagesOfTheSameRoadOnce) {
  const LearnedCovariance learned(built_in_ground_model());
  const double at_10_hz = learned.dense_correlated_images({0.0, 0.6});
  const double at_60_hz = learned.dense_correlated_images({0.0, 0.1});
  EXPECT_GE(at_10_hz, 1.0);
  // Six times as many images say as much as one did.
  EXPECT_NEAR(at_60_hz / at_10_hz, 6.0, 1.5);
}

TEST(WithCorrelatedHeight, GrowsTheHeightOnceTheNormalIsKnownAndLeavesTheTilt) {
  const LearnedCovariance learned(built_in_ground_model());
  const Eigen::Matrix3d once = learned.dense(road_seen(), {0.0, 0.6});
  const Eigen::Matrix3d thrice = with_correlated_height(once, 3.0);
  EXPECT_NEAR(once.inverse()(2, 2) / thrice.inverse()(2, 2), 3.0, 1e-9);
  EXPECT_EQ((thrice.topLeftCorner<2, 3>()), (once.topLeftCorner<2, 3>()));
}

}  // namespace
}  // namespace plumb
