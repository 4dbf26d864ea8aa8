/// The one list of a model file's numbers: key, member, range and meaning. Part of
/// ground_model.hpp.
///
/// The keys are an interface and older than the names of the members: [travel] is the direction of
/// translation over a chord, [memory] holds correlation lengths.
#pragma once

#include <string>

#include "modules/ground/covariance/ground_model.hpp"

namespace plumb {

namespace detail {

struct SlopeField {
  const char* name;
  const char* meaning;
};

template <typename Model, typename Visit>
void visit_log_variance(const char* section, const char* what,
                        const std::array<SlopeField, kNumCueFeatures>& slopes, Model& m,
                        Visit&& field) {
  const std::string prefix = std::string(section) + ".";
  field((prefix + "ln_var").c_str(), m.ln_var, -30.0, 5.0, what);
  for (std::size_t i = 0; i < kNumCueFeatures; ++i) {
    if (slopes[i].name == nullptr) continue;
    field((prefix + slopes[i].name).c_str(), m.slopes[i], -10.0, 20.0, slopes[i].meaning);
  }
  field((prefix + "low_std").c_str(), m.low_std, 1e-6, 10.0, "least 1-sigma");
  field((prefix + "high_std").c_str(), m.high_std, 1e-6, 10.0, "largest 1-sigma");
}

inline constexpr std::array<SlopeField, kNumCueFeatures> kDenseSlopes{
    {{"pixel", "per ln of the pixels' own variance over 1e-6"},
     {"doubt", "per -ln of the images' correlation"},
     {"turn", "per ln(1 + curvature times camera height / 0.02)"},
     {"step", "per -ln(step / half a camera height)"}}};
inline constexpr std::array<SlopeField, kNumCueFeatures> kPointsSlopes{
    {{"few", "per ln(10 / agreeing points)"},
     {"spread", "per ln(spread of the agreeing points / 0.02)"},
     {"turn", "as above"},
     {"step", "as above"}}};
inline constexpr std::array<SlopeField, kNumCueFeatures> kChordSlopes{
    {{nullptr, nullptr}, {nullptr, nullptr}, {"turn", "as above"}, {"step", "as above"}}};
inline constexpr std::array<SlopeField, kNumCueFeatures> kPlaneSlopes{
    {{"dense", "per ln(1 + (tilt of dense cue against fused normal / 0.003)^2)"},
     {"travel", "per ln(1 + (direction of translation against fused normal / 0.003)^2)"},
     {"turn", "as above"},
     {"step", "as above"}}};
inline constexpr std::array<SlopeField, kNumCueFeatures> kRollSlopes{
    {{"dense", "as above, sideways"},
     {nullptr, nullptr},
     {"turn", "as above"},
     {"step", "as above"}}};

}  // namespace detail

template <typename Model, typename Visit>
void GroundModel::visit(Model& m, Visit&& field) {
  using namespace detail;
  visit_log_variance("dense_n1", "ln variance of the normal's sideways part, usual frame",
                     kDenseSlopes, m.dense_n1, field);
  visit_log_variance("dense_n3", "ln variance of the normal's forward part, usual frame",
                     kDenseSlopes, m.dense_n3, field);
  visit_log_variance("dense_height", "ln variance of ln h, the normal known, usual frame",
                     kDenseSlopes, m.dense_height, field);
  visit_log_variance("points", "ln variance of ln h, the normal known, usual frame", kPointsSlopes,
                     m.points, field);
  visit_log_variance("travel",
                     "ln variance of normal . direction of translation under the car, usual frame",
                     kChordSlopes, m.chord, field);
  field("bend.start_std", m.bend.start_std, 0.0, 0.2,
        "1-sigma of the angle between the road ahead and the one under the car, at the start of a "
        "drive");
  field("bend.memory_ratio", m.bend.correlation_length_ratio, 0.1, 1000.0,
        "camera heights travelled over which a bend stays correlated");
  field("bend.height_slope", m.bend.height_slope, 0.0, 10.0,
        "ln height of the plane ahead per unit of that angle");
  field("memory.dense_ratio", m.dense_correlation_length_ratio, 0.0, 1000.0,
        "camera heights travelled over which the dense cue's errors stay correlated");
  field("memory.points_ratio", m.points_correlation_length_ratio, 0.0, 1000.0,
        "the same for the points cue");
  field("memory.objects_images", m.objects_correlated_images, 1.0, 1000.0,
        "images that share one error of the detected objects' pitch");
  visit_log_variance("plane_pitch",
                     "ln variance of reported pitch on top of the filter's, usual frame",
                     kPlaneSlopes, m.plane_pitch, field);
  visit_log_variance("plane_roll",
                     "ln variance of reported roll on top of the filter's, usual frame",
                     kRollSlopes, m.plane_roll, field);
  visit_log_variance("plane_height",
                     "ln variance of reported ln h on top of the filter's, usual frame",
                     kPlaneSlopes, m.plane_height, field);
  field("bias.ln_scale_std", m.ln_scale_bias_std, 0.0, 0.5,
        "1-sigma of the part of ln scale that is the same in a whole drive");
  LinearVariance::visit("objects_n3", m.objects_n3, field);
}

}  // namespace plumb
