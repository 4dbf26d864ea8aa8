/// Numeric derivatives to check analytic ones.
#pragma once

#include <Eigen/Core>

namespace plumb::test {

/// Computes d f / d x by central differences with the same step for every component of x.
template <int kOut, int kIn, typename Function>
Eigen::Matrix<double, kOut, kIn> central_difference(const Function& f,
                                                    const Eigen::Matrix<double, kIn, 1>& x,
                                                    double step) {
  Eigen::Matrix<double, kOut, kIn> J;
  for (int i = 0; i < kIn; ++i) {
    Eigen::Matrix<double, kIn, 1> low = x, high = x;
    low(i) -= step;
    high(i) += step;
    J.col(i) = (f(high) - f(low)) / (2.0 * step);
  }
  return J;
}

}  // namespace plumb::test
