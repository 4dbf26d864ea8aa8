#include "tools/synth/ground_ray.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::synth {
namespace {

constexpr double kAzimuthStep = 0.01;  // [rad]
constexpr double kNearest = 0.8;       // [m]
constexpr double kRangeRatio = 1.035;
constexpr double kFarthest = 420.0;  // [m]

}  // namespace

void GroundRays::build(const Terrain& terrain, const Eigen::Vector3d& origin, double yaw_rad,
                       double half_view_rad) {
  terrain_ = &terrain;
  yaw_rad_ = yaw_rad;
  first_azimuth_rad_ = -half_view_rad;
  num_azimuths_ = static_cast<int>(2.0 * half_view_rad / kAzimuthStep) + 2;
  ranges_m_.clear();
  for (double r = kNearest; r < kFarthest; r *= kRangeRatio) ranges_m_.push_back(r);
  const std::size_t n = ranges_m_.size();
  steepest_.resize(static_cast<std::size_t>(num_azimuths_) * n);
  for (int a = 0; a < num_azimuths_; ++a) {
    const double yaw = yaw_rad_ + first_azimuth_rad_ + a * kAzimuthStep;
    const double c = std::cos(yaw);
    const double s = std::sin(yaw);
    float* row = steepest_.data() + static_cast<std::size_t>(a) * n;
    float highest = -1e9F;
    for (std::size_t k = 0; k < n; ++k) {
      const double r = ranges_m_[k];
      const double rise = terrain.base_height(origin.x() + r * c, origin.y() + r * s) - origin.z();
      highest = std::max(highest, static_cast<float>(rise / r));
      row[k] = highest;
    }
  }
}

bool GroundRays::intersect(const Ray& ray, GroundHit& hit) const {
  const Eigen::Vector3d& d = ray.direction;
  const double run = std::hypot(d.x(), d.y());
  if (run < 1e-9) return false;
  double azimuth = std::atan2(d.y(), d.x()) - yaw_rad_;
  azimuth = std::remainder(azimuth, 6.283185307179586);
  const int a = std::clamp(static_cast<int>((azimuth - first_azimuth_rad_) / kAzimuthStep + 0.5), 0,
                           num_azimuths_ - 1);
  const std::size_t n = ranges_m_.size();
  const float* row = steepest_.data() + static_cast<std::size_t>(a) * n;
  const auto slope = static_cast<float>(d.z() / run);
  const float* found = std::lower_bound(row, row + n, slope);
  if (found == row + n) return false;
  const auto k = static_cast<std::size_t>(found - row);

  const auto gap = [&](double t) {  // height of the ray above the surface
    return ray.origin.z() + t * d.z() -
           terrain_->height(ray.origin.x() + t * d.x(), ray.origin.y() + t * d.y());
  };
  double t0 = ranges_m_[k] / run;
  double t1 = k > 0 ? ranges_m_[k - 1] / run : 0.9 * t0;
  if (k > 0 && row[k] > row[k - 1]) {
    const double f = static_cast<double>((slope - row[k - 1]) / (row[k] - row[k - 1]));
    t0 = t1 + f * (t0 - t1);
    t1 = 0.99 * t0;
  }
  double f0 = gap(t0);
  double f1 = gap(t1);
  for (int i = 0; i < 5 && std::abs(f0) > 1e-5 && f1 != f0; ++i) {  // secant
    const double t2 = std::clamp(t0 - f0 * (t0 - t1) / (f0 - f1), 0.8 * t0, 1.25 * t0);
    t1 = t0;
    f1 = f0;
    t0 = t2;
    f0 = gap(t0);
  }
  if (t0 <= 0.0 || t0 * run > kFarthest || std::abs(f0) > 0.02) return false;
  hit.t = t0;
  hit.part = GroundPart::kRoad;
  hit.edge_m = terrain_->edge_distance(ray.origin.x() + t0 * d.x(), ray.origin.y() + t0 * d.y());
  const double closing = f1 != f0 ? std::abs((f0 - f1) / (t0 - t1)) : std::abs(d.z());
  return resolve_kerb(ray, std::max(closing, 1e-3), hit);
}

bool GroundRays::resolve_kerb(const Ray& ray, double closing, GroundHit& hit) const {
  const double kerb = terrain_->route().setting.kerb_m;
  const auto edge_at = [&](double t) {
    return terrain_->edge_distance(ray.origin.x() + t * ray.direction.x(),
                                   ray.origin.y() + t * ray.direction.y());
  };
  if (hit.edge_m > 0.0) hit.part = GroundPart::kBeside;
  if (kerb <= 0.0) return true;
  const double shift = kerb / closing;  // how much earlier the ray meets the raised level
  if (hit.edge_m < -shift) return true;
  const double raised = hit.t - shift;
  const double raised_edge = edge_at(raised);
  if (raised_edge > 0.0) {
    hit.t = raised;
    hit.edge_m = raised_edge;
    hit.part = GroundPart::kBeside;
    return true;
  }
  if (hit.edge_m <= 0.0) return true;
  double low = raised;
  double high = hit.t;
  for (int i = 0; i < 12; ++i) {
    const double middle = 0.5 * (low + high);
    (edge_at(middle) > 0.0 ? high : low) = middle;
  }
  hit.t = 0.5 * (low + high);
  hit.edge_m = 0.0;
  hit.part = GroundPart::kKerbFace;
  return true;
}

}  // namespace plumb::synth
