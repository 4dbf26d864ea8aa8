#include "modules/ground_paper/gaussian_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

// Offset, depth, centre, width; x scaled to [-1, 1].
using Parameters = Eigen::Vector4d;

constexpr int kIterations = 40;
constexpr double kEnough = 1e-9;
// Slices are centred on the minimum: a dip near their ends is another one, or a slope.
constexpr double kFarthestCentre = 0.5;
// A dip narrower than a third of the spacing falls between the samples; one wider than the slice is
// no dip.
constexpr double kNarrowest = 0.3 * 2.0 / (kSliceSamples - 1);
constexpr double kWidest = 2.0;

struct Scaled {
  std::array<double, kSliceSamples> x{};
  const std::array<double, kSliceSamples>* f = nullptr;
};

double square_sum(const Scaled& s, const Parameters& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSliceSamples; ++i) {
    const double u = (s.x[i] - p(2)) / p(3);
    const double r = (*s.f)[i] - p(0) + p(1) * std::exp(-0.5 * u * u);
    sum += r * r;
  }
  return sum;
}

void normal_equations(const Scaled& s, const Parameters& p, Eigen::Matrix4d* H,
                      Eigen::Vector4d* b) {
  H->setZero();
  b->setZero();
  for (std::size_t i = 0; i < kSliceSamples; ++i) {
    const double u = (s.x[i] - p(2)) / p(3);
    const double dip = std::exp(-0.5 * u * u);
    const double r = (*s.f)[i] - p(0) + p(1) * dip;
    // d(model) / d(offset, depth, centre, width)
    const Eigen::Vector4d J(1.0, -dip, -p(1) * dip * u / p(3), -p(1) * dip * u * u / p(3));
    *H += J * J.transpose();
    *b += J * r;
  }
}

/// Takes the lowest sample, and the distance over which the cost rises by half of its range.
Parameters first_guess(const Scaled& s) {
  const auto [low, high] = std::minmax_element(s.f->begin(), s.f->end());
  const auto bottom = static_cast<std::size_t>(low - s.f->begin());
  const double half = 0.5 * (*low + *high);
  std::size_t left = bottom, right = bottom;
  while (left > 0 && (*s.f)[left] < half) --left;
  while (right + 1 < kSliceSamples && (*s.f)[right] < half) ++right;
  constexpr double kHalfWidthOverSigma = 1.1774;  // sqrt(2 ln 2)
  const double width = 0.5 * (s.x[right] - s.x[left]) / kHalfWidthOverSigma;
  return {*high, *high - *low, s.x[bottom], std::max(width, kNarrowest)};
}

}  // namespace

GaussianDip fit_gaussian(const Slice& slice) {
  const double middle = 0.5 * (slice.x.front() + slice.x.back());
  const double half_range = 0.5 * (slice.x.back() - slice.x.front());
  Scaled s;
  for (std::size_t i = 0; i < kSliceSamples; ++i) s.x[i] = (slice.x[i] - middle) / half_range;
  s.f = &slice.f;
  Parameters p = first_guess(s);
  double cost = square_sum(s, p);
  double damping = 1e-3;
  // Levenberg-Marquardt.
  for (int k = 0; k < kIterations; ++k) {
    Eigen::Matrix4d H;
    Eigen::Vector4d b;
    normal_equations(s, p, &H, &b);
    H.diagonal() *= 1.0 + damping;
    H.diagonal().array() += 1e-15;
    Parameters next = p + H.ldlt().solve(b);
    next(3) = std::clamp(std::abs(next(3)), 0.2 * kNarrowest, 4.0 * kWidest);
    const double next_cost = square_sum(s, next);
    if (next_cost <= cost) {  // false for NaN
      const bool settled = cost - next_cost <= kEnough * cost;
      p = next;
      cost = next_cost;
      damping *= 0.2;
      if (settled) break;
    } else {
      damping *= 8.0;
    }
  }
  GaussianDip dip{false, middle + half_range * p(2), half_range * p(3), p(1), p(0)};
  dip.ok = std::isfinite(cost) && p(1) > 0.0 && std::abs(p(2)) <= kFarthestCentre &&
           p(3) >= kNarrowest && p(3) <= kWidest;
  return dip;
}

}  // namespace plumb
