#include "modules/ground_paper/plane_kalman.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

/// Index in x = (n1, n2, n3, h) of a component of z = (n1, n3, h).
constexpr int state_index(PlaneComponent component) {
  return component == kN1 ? 0 : component == kN3 ? 2 : 3;
}

}  // namespace

void PlaneKalman::start(const Eigen::Vector3d& normal, double height, double normal_var,
                        double height_var) {
  n_ = normal;
  h_ = height;
  P_.setZero();
  P_.diagonal() << normal_var, normal_var, normal_var, height_var;
}

void PlaneKalman::predict(const Se3& T_prev_cam) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
  A.topLeftCorner<3, 3>() = T_prev_cam.R.transpose();
  A.bottomLeftCorner<1, 3>() = -T_prev_cam.t.transpose();
  h_ -= n_.dot(T_prev_cam.t);
  n_ = T_prev_cam.R.transpose() * n_;
  P_ = A * P_ * A.transpose();
  P_.diagonal().head<3>().array() += noise_.normal_std * noise_.normal_std;
  P_(3, 3) += noise_.height_std * noise_.height_std;
}

void PlaneKalman::observe(const CueFusion& fused) {
  Eigen::Vector4d x;
  x << n_, h_;
  // U is diagonal, so its components may enter one after the other.
  for (const PlaneComponent component : {kN1, kN3, kH}) {
    if (!fused.observes(component)) continue;
    const int i = state_index(component);
    const double S = P_(i, i) + fused.var(component);
    const Eigen::Vector4d K = P_.col(i) / S;
    x += K * (fused.value(component) - x(i));
    Eigen::Matrix4d IKH = Eigen::Matrix4d::Identity();
    IKH.col(i) -= K;
    P_ = IKH * P_ * IKH.transpose() + fused.var(component) * K * K.transpose();
  }
  // |n| = 1 determines n2.
  n_ = {x(0), std::sqrt(std::max(0.1, 1.0 - x(0) * x(0) - x(2) * x(2))), x(2)};
  h_ = x(3);
}

void PlaneKalman::divide_unit(double s) {
  h_ /= s;
  P_.col(3) /= s;
  P_.row(3) /= s;
}

}  // namespace plumb
