#include "modules/ground/cues/candidate_mixture.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr double kStartWidth = 1.0 / 8.0;  ///< 1-sigma at the start, shares of the box
constexpr double kLeastAmplitude = 0.05;
constexpr double kScoreStd = 0.02;  ///< 1-sigma of a sample's score
// Standard deviations of the prior: ln A, mean (in units of the start's), log-diagonal,
// off-diagonal.
constexpr double kPriorLogAmplitude = 1.0;
constexpr double kPriorMean = 2.0;
constexpr double kPriorLogDiagonal = 1.5;
constexpr double kPriorOffDiagonal = 2.0;
constexpr double kMostLogDiagonal = 6.0;
constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e8;
constexpr double kSmallDecrease = 1e-7;

/// Index of (row, column) of the lower factor, row >= column, among a component's parameters.
constexpr int factor_index(int row, int column) { return 5 + row * (row + 1) / 2 + column; }

double prior_std(int parameter) {
  if (parameter == 0) return kPriorLogAmplitude;
  if (parameter < 5) return kPriorMean;
  for (int i = 0; i < 4; ++i) {
    if (parameter == factor_index(i, i)) return kPriorLogDiagonal;
  }
  return kPriorOffDiagonal;
}

template <typename Segment>
Eigen::Matrix4d factor_of(const Segment& p) {
  Eigen::Matrix4d L = Eigen::Matrix4d::Zero();
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < row; ++column) L(row, column) = p(factor_index(row, column));
    L(row, row) =
        std::exp(std::clamp(p(factor_index(row, row)), -kMostLogDiagonal, kMostLogDiagonal));
  }
  return L;
}

bool usable(const Box& box, double score) {
  return std::isfinite(box.left_px) && std::isfinite(box.top_px) && std::isfinite(box.right_px) &&
         std::isfinite(box.bottom_px) && std::isfinite(score) && box.width_px() > 0.0 &&
         box.height_px() > 0.0;
}

}  // namespace

Eigen::Vector4d box_vector(const Box& box) {
  return {box.centre_u_px(), box.bottom_px, box.width_px(), box.height_px()};
}

double placement_confidence_px2(const MixtureComponent& component) {
  const double foot = component.cov(1, 1);
  const double height = component.cov(3, 3);
  return foot * height / (foot + height);
}

void CandidateMixture::clear() {
  samples_.clear();
  starts_.clear();
  rms_residual_ = 0.0;
}

bool CandidateMixture::add_sample(const Box& box, double score) {
  return usable(box, score) && samples_.push_back({box_vector(box), score});
}

bool CandidateMixture::add_component(const Box& box, double score) {
  return usable(box, score) && starts_.push_back({box_vector(box), score});
}

Eigen::Vector4d CandidateMixture::scale_px(std::size_t component) const {
  const Eigen::Vector4d& b = starts_[component].b;
  return kStartWidth * Eigen::Vector4d(b(2), b(3), b(2), b(3));
}

CandidateMixture::Parameters CandidateMixture::start_parameters() const {
  // Coordinates are offsets from the start in units of its 1-sigma: the start is mean 0, factor 1.
  Parameters start = Parameters::Zero(num_parameters());
  for (std::size_t m = 0; m < starts_.size(); ++m) {
    start(kPerComponent * static_cast<Eigen::Index>(m)) =
        std::log(std::max(starts_[m].score, kLeastAmplitude));
  }
  return start;
}

double CandidateMixture::evaluate(const Parameters& parameters, Eigen::VectorXd::Index sample,
                                  Parameters* gradient) const {
  const Sample& s = samples_[static_cast<std::size_t>(sample)];
  double sum = 0.0;
  for (std::size_t m = 0; m < starts_.size(); ++m) {
    const Eigen::Index at = kPerComponent * static_cast<Eigen::Index>(m);
    const auto p = parameters.segment<kPerComponent>(at);
    const Eigen::Vector4d offset =
        (s.b - starts_[m].b).cwiseQuotient(scale_px(m)) - p.segment<4>(1);
    const Eigen::Matrix4d L = factor_of(p);
    const Eigen::Vector4d q = L.transpose() * offset;
    const double g = std::exp(p(0) - 0.5 * q.squaredNorm());
    sum += g;
    if (gradient == nullptr) continue;
    auto d = gradient->segment<kPerComponent>(at);
    d(0) = g;
    d.segment<4>(1) = g * (L * q);
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < row; ++column) {
        d(factor_index(row, column)) = -g * q(column) * offset(row);
      }
      d(factor_index(row, row)) = -g * q(row) * offset(row) * L(row, row);
    }
  }
  return sum;
}

double CandidateMixture::cost(const Parameters& parameters, const Parameters& start) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const double r =
        (evaluate(parameters, static_cast<Eigen::Index>(n), nullptr) - samples_[n].score) /
        kScoreStd;
    sum += r * r;
  }
  for (int i = 0; i < parameters.size(); ++i) {
    const double r = (parameters(i) - start(i)) / prior_std(i % kPerComponent);
    sum += r * r;
  }
  return sum;
}

void CandidateMixture::accumulate(const Parameters& parameters, const Parameters& start) {
  normal_.setZero(parameters.size(), parameters.size());
  gradient_.setZero(parameters.size());
  Parameters row = Parameters::Zero(parameters.size());
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const double r = evaluate(parameters, static_cast<Eigen::Index>(n), &row) - samples_[n].score;
    const double weight = 1.0 / (kScoreStd * kScoreStd);
    normal_.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    gradient_ += weight * r * row;
  }
  for (int i = 0; i < parameters.size(); ++i) {
    const double information = 1.0 / (prior_std(i % kPerComponent) * prior_std(i % kPerComponent));
    normal_(i, i) += information;
    gradient_(i) += information * (parameters(i) - start(i));
  }
}

bool CandidateMixture::fit(int max_iterations) {
  const Parameters start = start_parameters();
  parameters_ = start;
  double best = cost(parameters_, start);
  double damping = kFirstDamping;
  bool settled = false;
  for (int iteration = 0; iteration < max_iterations && !settled; ++iteration) {
    accumulate(parameters_, start);
    bool lowered = false;
    while (!lowered && damping < kMostDamping) {
      damped_ = normal_;
      damped_.diagonal() *= 1.0 + damping;
      const Eigen::LLT<Eigen::Ref<Normal>> solver(damped_);
      Parameters candidate = gradient_;
      solver.solveInPlace(candidate);
      candidate = parameters_ - candidate;
      const double candidate_cost = cost(candidate, start);
      lowered = candidate_cost < best;
      settled = lowered && best - candidate_cost < kSmallDecrease * best;
      if (lowered) {
        parameters_ = candidate;
        best = candidate_cost;
      }
      damping *= lowered ? 0.2 : 10.0;
    }
    settled = settled || !lowered;
  }
  double sum = 0.0;
  for (std::size_t n = 0; n < samples_.size(); ++n) {
    const double r =
        evaluate(parameters_, static_cast<Eigen::Index>(n), nullptr) - samples_[n].score;
    sum += r * r;
  }
  rms_residual_ = std::sqrt(sum / static_cast<double>(samples_.size()));
  return std::isfinite(best);
}

MixtureComponent CandidateMixture::component(std::size_t i) const {
  const auto p = parameters_.segment<kPerComponent>(kPerComponent * static_cast<Eigen::Index>(i));
  const Eigen::Vector4d scale = scale_px(i);
  const Eigen::Matrix4d L = factor_of(p);
  MixtureComponent result;
  result.amplitude = std::exp(p(0));
  result.mean = starts_[i].b + scale.cwiseProduct(p.segment<4>(1));
  result.cov = scale.asDiagonal() * (L * L.transpose()).inverse() * scale.asDiagonal();
  return result;
}

std::size_t CandidateMixture::nearest_component(const Box& box) const {
  const Eigen::Vector4d b = box_vector(box);
  std::size_t nearest = 0;
  double least = 0.0;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const double distance = (component(i).mean - b).squaredNorm();
    if (i > 0 && distance >= least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

}  // namespace plumb
