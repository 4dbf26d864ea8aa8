/// The simplex search of Nelder and Mead (1965) for a minimum, without derivatives.
///
/// Memory:
///   N + 1 points in place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plumb {

struct NelderMeadLimits {
  int max_evaluations = 200;
  double value_tolerance = 1e-6;  ///< converged when all corners' costs lie within this
  double size_tolerance = 1e-4;   ///< and all corners within this many first steps of the best
};

template <int N>
struct NelderMeadResult {
  Eigen::Matrix<double, N, 1> x;
  double value = std::numeric_limits<double>::infinity();
  int num_evaluations = 0;
  bool converged = false;
};

/// Searches from `start` with a first simplex of edges `step`; a cost of NaN counts as infinite.
/// @pre every element of step != 0, max_evaluations > N
template <int N, typename Cost>
class NelderMead {
 public:
  using Point = Eigen::Matrix<double, N, 1>;

  NelderMead(const Cost& cost, const NelderMeadLimits& limits) : cost_(cost), limits_(limits) {}

  NelderMeadResult<N> run(const Point& start, const Point& step) {
    num_evaluations_ = 0;
    corners_[0] = evaluate(start);
    for (int i = 0; i < N; ++i) {
      Point x = start;
      x(i) += step(i);
      corners_[static_cast<std::size_t>(i) + 1] = evaluate(x);
    }
    sort();
    while (!converged(step) && num_evaluations_ < limits_.max_evaluations) {
      move_worst();
      sort();
    }
    return {corners_[0].x, corners_[0].value, num_evaluations_, converged(step)};
  }

 private:
  struct Corner {
    Point x;
    double value = 0.0;
  };

  Corner evaluate(const Point& x) {
    ++num_evaluations_;
    const double value = cost_(x);
    return {x, std::isnan(value) ? std::numeric_limits<double>::infinity() : value};
  }

  void sort() {
    std::stable_sort(corners_.begin(), corners_.end(),
                     [](const Corner& a, const Corner& b) { return a.value < b.value; });
  }

  [[nodiscard]] bool converged(const Point& step) const {
    if (!(corners_[N].value - corners_[0].value <= limits_.value_tolerance)) return false;
    for (const Corner& corner : corners_) {
      const Point apart = (corner.x - corners_[0].x).cwiseQuotient(step);
      if (apart.cwiseAbs().maxCoeff() > limits_.size_tolerance) return false;
    }
    return true;
  }

  // Reflection 1, expansion 2, contraction 1/2, shrinkage 1/2, as Nelder and Mead (1965).
  void move_worst() {
    Point centre = Point::Zero();
    for (std::size_t i = 0; i < N; ++i) centre += corners_[i].x / N;
    const Point away = centre - corners_[N].x;
    const Corner reflected = evaluate(centre + away);
    if (reflected.value < corners_[0].value) {
      const Corner expanded = evaluate(centre + 2.0 * away);
      corners_[N] = expanded.value < reflected.value ? expanded : reflected;
      return;
    }
    if (reflected.value < corners_[N - 1].value) {
      corners_[N] = reflected;
      return;
    }
    const bool outside = reflected.value < corners_[N].value;
    const Corner contracted = evaluate(centre + (outside ? 0.5 : -0.5) * away);
    if (contracted.value < std::min(reflected.value, corners_[N].value)) {
      corners_[N] = contracted;
      return;
    }
    shrink();
  }

  void shrink() {
    for (std::size_t i = 1; i <= N; ++i) {
      corners_[i] = evaluate(0.5 * (corners_[0].x + corners_[i].x));
    }
  }

  const Cost& cost_;
  NelderMeadLimits limits_;
  std::array<Corner, N + 1> corners_;
  int num_evaluations_ = 0;
};

}  // namespace plumb
