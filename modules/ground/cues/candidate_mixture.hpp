/// How accurately a detector has placed a box, from the scores of the raw boxes around it.
///
/// Model:
///   score(b) = sum_m A_m exp(-1/2 (b - mean_m)^T cov_m^-1 (b - mean_m)), fitted to candidate boxes
///   by least squares.
/// Source:
///   Song and Chandraker, CVPR 2014, equation (10).
/// Frames:
///   b = (u of the middle, v of the lower edge, width, height) [px] in img.
/// Memory:
///   kMaxSamples samples, kMaxComponents Gaussians and the normal equations in place, 35 kB.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "core/fixed_vector.hpp"
#include "modules/detections/detection.hpp"

namespace plumb {

struct MixtureComponent {
  double amplitude = 0.0;                          ///< > 0
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();  ///< [px]
  Eigen::Matrix4d cov = Eigen::Matrix4d::Zero();   ///< [px^2]
};

/// (u of the middle, v of the lower edge, width, height).
[[nodiscard]] Eigen::Vector4d box_vector(const Box& box);

/// Add samples and components, fit, read the result; clear() for the next fit. Deterministic in the
/// order of its inputs.
class CandidateMixture {
 public:
  static constexpr std::size_t kMaxSamples = 128;
  static constexpr std::size_t kMaxComponents = 4;

  void clear();
  /// Adds one raw box. False when full, or when box or score are not usable (empty, not finite).
  bool add_sample(const Box& box, double score);
  /// Adds a Gaussian that starts at `box`, which suppression kept. False when full or unusable.
  bool add_component(const Box& box, double score);

  /// Fits by Levenberg-Marquardt from the starting boxes; a wide prior about the start determines
  /// what the samples do not. False when the numbers overflow; components are then at the start.
  /// @pre at least one component and one sample
  bool fit(int max_iterations);

  [[nodiscard]] std::size_t num_samples() const { return samples_.size(); }
  [[nodiscard]] std::size_t num_components() const { return starts_.size(); }
  [[nodiscard]] MixtureComponent component(std::size_t i) const;
  /// Index of the Gaussian whose mean is nearest to `box`. @pre num_components() > 0
  [[nodiscard]] std::size_t nearest_component(const Box& box) const;
  /// Root mean square residual of the samples, in units of score; after fit().
  [[nodiscard]] double rms_residual() const { return rms_residual_; }

 private:
  static constexpr int kPerComponent = 15;  ///< ln A, 4 of the mean, 10 of the factor
  static constexpr int kMaxParameters = kPerComponent * static_cast<int>(kMaxComponents);
  using Parameters = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxParameters, 1>;
  using Normal =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxParameters, kMaxParameters>;

  struct Sample {
    Eigen::Vector4d b;
    double score;
  };

  [[nodiscard]] int num_parameters() const {
    return kPerComponent * static_cast<int>(starts_.size());
  }
  [[nodiscard]] Eigen::Vector4d scale_px(std::size_t component) const;
  [[nodiscard]] Parameters start_parameters() const;
  double evaluate(const Parameters& parameters, Eigen::VectorXd::Index sample,
                  Parameters* gradient) const;
  [[nodiscard]] double cost(const Parameters& parameters, const Parameters& start) const;
  void accumulate(const Parameters& parameters, const Parameters& start);

  FixedVector<Sample, kMaxSamples> samples_;
  FixedVector<Sample, kMaxComponents> starts_;
  Parameters parameters_;
  Parameters gradient_;
  Normal normal_;
  Normal damped_;
  double rms_residual_ = 0.0;
};

/// The paper's a_d [px^2]: one over the sum of the inverse variances of lower edge and height.
[[nodiscard]] double placement_confidence_px2(const MixtureComponent& component);

}  // namespace plumb
