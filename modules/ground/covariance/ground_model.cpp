#include "modules/ground/covariance/ground_model.hpp"

#include <algorithm>
#include <cmath>

#include "modules/ground/covariance/built_in_numbers.hpp"

namespace plumb {
namespace {

constexpr double kUsualPixelVar = 1e-6;
constexpr double kUsualTurnRatio = 0.02;
constexpr double kUsualStepRatio = 0.5;
constexpr double kUsualPoints = 10.0;
constexpr double kUsualSpread = 0.02;
constexpr double kLeastNcc = 0.1;
constexpr double kUsualResidual = 0.003;

}  // namespace

double turn_feature(double turn_ratio) {
  return std::log1p(std::min(turn_ratio, 1.0) / kUsualTurnRatio);
}

double step_feature(double step_ratio) {
  return -std::log(std::clamp(step_ratio, 0.02, 5.0) / kUsualStepRatio);
}

CueFeatures dense_features(double pixel_var, double ncc, double turn_ratio, double step_ratio) {
  return {std::log(std::clamp(pixel_var, 1e-10, 1.0) / kUsualPixelVar),
          -std::log(std::clamp(ncc, kLeastNcc, 1.0)), turn_feature(turn_ratio),
          step_feature(step_ratio)};
}

CueFeatures points_features(double num_inliers, double spread, double turn_ratio,
                            double step_ratio) {
  return {std::log(kUsualPoints / std::clamp(num_inliers, 1.0, 200.0)),
          std::log(std::clamp(spread, 0.002, 0.2) / kUsualSpread), turn_feature(turn_ratio),
          step_feature(step_ratio)};
}

CueFeatures chord_features(double turn_ratio, double step_ratio) {
  return {0.0, 0.0, turn_feature(turn_ratio), step_feature(step_ratio)};
}

CueFeatures plane_features(double dense_square, double chord_square, double turn_ratio,
                           double step_ratio) {
  const auto residual = [](double square) {
    return std::log1p(std::min(square, 1.0) / (kUsualResidual * kUsualResidual));
  };
  return {residual(dense_square), residual(chord_square), turn_feature(turn_ratio),
          step_feature(step_ratio)};
}

double LogVariance::of(const CueFeatures& features) const {
  double ln = ln_var;
  for (std::size_t i = 0; i < kNumCueFeatures; ++i) ln += slopes[i] * features[i];
  return std::clamp(std::exp(std::min(ln, 10.0)), low_std * low_std, high_std * high_std);
}

GroundModel built_in_ground_model() {
  GroundModel model;
  GroundModel::visit(model, [](const char* key, double& value, double, double, const char*) {
    take_built_in_number(key, &value);
  });
  return model;
}

}  // namespace plumb
