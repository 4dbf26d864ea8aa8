#include "modules/vo/two_view.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/percentile.hpp"

namespace plumb::vo {
namespace {

constexpr int kMinPairs = 20;
constexpr int kMaxSamples = 300;
constexpr double kConfidence = 0.999;  // that one of the samples has no outlier
constexpr double kInlierPx = 1.0;

struct SampsonError {
  double error = 0.0;  // normalised units
  double inv_norm = 0.0;
};

SampsonError sampson(const Eigen::Matrix3d& E, const RayPair& pair) {
  const Eigen::Vector3d a = pair.first.homogeneous();
  const Eigen::Vector3d b = pair.second.homogeneous();
  const Eigen::Vector3d Ea = E * a;
  const Eigen::Vector3d Etb = E.transpose() * b;
  const double inv_norm =
      1.0 / std::sqrt(Ea.head<2>().squaredNorm() + Etb.head<2>().squaredNorm() + 1e-18);
  return {b.dot(Ea) * inv_norm, inv_norm};
}

// Returns the sum of the squared errors, each truncated at the gate.
double msac_cost(const Eigen::Matrix3d& E, const std::vector<RayPair>& pairs, double gate,
                 int* num_inliers) {
  double sum = 0.0;
  int inliers = 0;
  for (const RayPair& pair : pairs) {
    const double e = sampson(E, pair).error;
    const double e2 = e * e;
    if (e2 < gate * gate) ++inliers;
    sum += std::min(e2, gate * gate);
  }
  *num_inliers = inliers;
  return sum;
}

// Returns the number of samples of five after which one has no outlier with kConfidence.
int samples_needed(int num_inliers, std::size_t num_pairs) {
  const double inlier_ratio = static_cast<double>(num_inliers) / static_cast<double>(num_pairs);
  const double outlier_probability = 1.0 - std::pow(inlier_ratio, 5.0);
  if (outlier_probability <= 0.0) return 1;
  const double num_samples =
      std::log(1.0 - kConfidence) / std::log(std::min(outlier_probability, 1.0 - 1e-9));
  return static_cast<int>(std::min(num_samples, 1.0 * kMaxSamples)) + 1;
}

// Draws five different pairs.
std::array<RayPair, 5> draw_sample(const std::vector<RayPair>& pairs, Random& random) {
  std::array<std::size_t, 5> chosen{};
  std::array<RayPair, 5> sample;
  for (std::size_t i = 0; i < 5; ++i) {
    do {
      chosen[i] = random.below(pairs.size());
    } while (std::find(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(i),
                       chosen[i]) != chosen.begin() + static_cast<std::ptrdiff_t>(i));
    sample[i] = pairs[chosen[i]];
  }
  return sample;
}

// Counts the inliers that lie before both cameras.
int count_in_front(const Se3& T, const std::vector<RayPair>& pairs, double gate) {
  const Eigen::Matrix3d E = hat(T.t) * T.R;
  int count = 0;
  for (const RayPair& pair : pairs) {
    const double e = sampson(E, pair).error;
    double rho = 0.0;
    if (e * e < gate * gate && triangulate(pair, T, &rho)) ++count;
  }
  return count;
}

// Returns the one of the four decompositions of E that has most inliers before both cameras.
TwoView decompose(const Eigen::Matrix3d& E, const std::vector<RayPair>& pairs, double gate) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(E, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  Eigen::Matrix3d V = svd.matrixV();
  if (U.determinant() < 0.0) U.col(2) = -U.col(2);
  if (V.determinant() < 0.0) V.col(2) = -V.col(2);
  Eigen::Matrix3d W;
  W << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  TwoView best;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix3d quarter_turn = i < 2 ? W : Eigen::Matrix3d(W.transpose());
    const Se3 T{U * quarter_turn * V.transpose(), (i % 2 == 0 ? 1.0 : -1.0) * U.col(2)};
    const int count = count_in_front(T, pairs, gate);
    if (count > best.num_inliers) best = {T, count, true};
  }
  return best;
}

// Refines the pose by Gauss-Newton on the Sampson error, over three angles and two parameters of
// the direction of t.
void refine_pose(const std::vector<RayPair>& pairs, double gate, Se3* T) {
  constexpr int kIterations = 10;
  const double kernel2 = gate * gate * 0.25;
  for (int i = 0; i < kIterations; ++i) {
    const Eigen::Matrix3d E = hat(T->t) * T->R;
    const Eigen::Vector3d helper =
        std::abs(T->t.x()) < 0.7 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    Eigen::Matrix<double, 3, 2> tangent;
    tangent.col(0) = T->t.cross(helper).normalized();
    tangent.col(1) = T->t.cross(tangent.col(0));
    Eigen::Matrix<double, 5, 5> H = Eigen::Matrix<double, 5, 5>::Zero();
    Eigen::Matrix<double, 5, 1> b = Eigen::Matrix<double, 5, 1>::Zero();
    for (const RayPair& pair : pairs) {
      const SampsonError e = sampson(E, pair);
      const Eigen::Vector3d x2 = pair.second.homogeneous();
      const Eigen::Vector3d y = T->R * pair.first.homogeneous();
      Eigen::Matrix<double, 5, 1> J;
      // x2 . (t x (w x y)) = w . ((t.y) x2 - (x2.y) t);  x2 . (dt x y) = dt . (y x x2)
      J.head<3>() = (T->t.dot(y) * x2 - x2.dot(y) * T->t) * e.inv_norm;
      J.tail<2>() = tangent.transpose() * y.cross(x2) * e.inv_norm;
      const double w = 1.0 / (1.0 + e.error * e.error / kernel2);
      H.noalias() += w * J * J.transpose();
      b.noalias() -= (w * e.error) * J;
    }
    H.diagonal() *= 1.0 + 1e-9;
    const Eigen::Matrix<double, 5, 1> step = H.ldlt().solve(b);
    if (!step.allFinite()) return;
    T->R = exp_so3(step.head<3>()) * T->R;
    T->t = (T->t + tangent * step.tail<2>()).normalized();
    T->normalize();
    if (step.norm() < 1e-9) return;
  }
}

}  // namespace

bool triangulate(const RayPair& pair, const Se3& T_second_first, double* rho) {
  // z2 y2 = z1 y1 + t with y1 = R x1. The cross product with y2 eliminates z2:
  // a + rho c = 0 with a = y2 x y1, c = y2 x t and rho = 1 / z1.
  const Eigen::Vector3d y1 = T_second_first.R * pair.first.homogeneous();
  const Eigen::Vector3d y2 = pair.second.homogeneous();
  const Eigen::Vector3d a = y2.cross(y1);
  const Eigen::Vector3d c = y2.cross(T_second_first.t);
  const double cc = c.squaredNorm();
  if (cc < 1e-18) return false;
  *rho = -a.dot(c) / cc;
  return *rho > 0.0 && y1.z() + *rho * T_second_first.t.z() > 0.0;
}

TwoView solve_two_view(const std::vector<RayPair>& pairs, double focal_px, const Se3& guess,
                       Random& random) {
  TwoView result;
  if (pairs.size() < kMinPairs) return result;
  const double gate = kInlierPx / focal_px;
  Eigen::Matrix3d best = Eigen::Matrix3d::Zero();
  int inliers = 0;
  double lowest = 1e300;
  if (guess.t.squaredNorm() > 0.0) {
    best = hat(guess.t.normalized()) * guess.R;
    lowest = msac_cost(best, pairs, gate, &inliers);
  }
  int num_samples = kMaxSamples;
  EssentialSolutions solutions;
  for (int i = 0; i < num_samples; ++i) {
    solve_five_point(draw_sample(pairs, random), &solutions);
    for (const Eigen::Matrix3d& E : solutions) {
      int count = 0;
      const double cost = msac_cost(E, pairs, gate, &count);
      if (cost >= lowest) continue;
      lowest = cost;
      best = E;
      num_samples = std::min(num_samples, samples_needed(count, pairs.size()));
    }
  }
  result = decompose(best, pairs, gate);
  if (!result.ok) return result;
  refine_pose(pairs, gate, &result.T_second_first);
  result.num_inliers = count_in_front(result.T_second_first, pairs, gate);
  result.ok = result.num_inliers >= kMinPairs;
  return result;
}

RotationFit fit_rotation(const std::vector<RayPair>& pairs, double focal_px,
                         std::vector<double>& scratch) {
  constexpr int kIterations = 8;
  RotationFit fit;
  if (pairs.empty()) return fit;
  for (int i = 0; i <= kIterations; ++i) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity() * 1e-12;
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    // The kernel narrows from 16 to 1 px, so that parallax and moving objects lose their weight.
    const double kernel = std::max(1.0, 16.0 / (1 << i));
    scratch.clear();
    for (const RayPair& pair : pairs) {
      const Eigen::Vector3d y = fit.R_second_first * pair.first.homogeneous();
      if (y.z() < 0.1) continue;
      const double inv_z = 1.0 / y.z();
      const double X = y.x() * inv_z;
      const double Y = y.y() * inv_z;
      const Eigen::Vector2d r = focal_px * (pair.second - Eigen::Vector2d(X, Y));
      Eigen::Matrix<double, 2, 3> J;  // d(x, y)/dw at R <- exp(w) R
      J << -X * Y, 1.0 + X * X, -Y, -(1.0 + Y * Y), X * Y, X;
      J *= focal_px;
      const double w = 1.0 / (1.0 + r.squaredNorm() / (kernel * kernel));
      H.noalias() += w * J.transpose() * J;
      b.noalias() += w * J.transpose() * r;
      scratch.push_back(r.norm());
    }
    if (i == kIterations) break;
    const Eigen::Vector3d step = H.ldlt().solve(b);
    if (!step.allFinite()) break;
    fit.R_second_first = exp_so3(step) * fit.R_second_first;
  }
  if (!scratch.empty()) fit.median_px = upper_median(scratch);
  return fit;
}

}  // namespace plumb::vo
