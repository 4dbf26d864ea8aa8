#include "tools/synth/ground_ray.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::synth {
namespace {

constexpr double kStep = 0.012;   ///< between columns, in tangents of the angle to the side
constexpr double kNearest = 0.8;  // [m]
constexpr double kRangeRatio = 1.035;
constexpr double kFarthest = 420.0;  // [m]

}  // namespace

void GroundRays::build(const Terrain& terrain, const Eigen::Vector3d& origin, double yaw_rad,
                       double half_view_rad) {
  terrain_ = &terrain;
  c_ = std::cos(yaw_rad);
  s_ = std::sin(yaw_rad);
  half_width_ = std::tan(std::min(half_view_rad, 1.4));
  num_columns_ = static_cast<int>(2.0 * half_width_ / kStep) + 2;
  ranges_m_.clear();
  for (double r = kNearest; r < kFarthest; r *= kRangeRatio) ranges_m_.push_back(r);
  const std::size_t n = ranges_m_.size();
  steepest_.resize(static_cast<std::size_t>(num_columns_) * n);
  for (int a = 0; a < num_columns_; ++a) {
    const double across = a * kStep - half_width_;
    const double norm = 1.0 / std::sqrt(1.0 + across * across);
    const double dx = (c_ - s_ * across) * norm;
    const double dy = (s_ + c_ * across) * norm;
    float* row = steepest_.data() + static_cast<std::size_t>(a) * n;
    float highest = -1e9F;
    for (std::size_t k = 0; k < n; ++k) {
      const double r = ranges_m_[k];
      const double rise =
          terrain.base_height(origin.x() + r * dx, origin.y() + r * dy) - origin.z();
      highest = std::max(highest, static_cast<float>(rise / r));
      row[k] = highest;
    }
  }
}

bool GroundRays::intersect(const Ray& ray, GroundHit& hit) const {
  const Eigen::Vector3d& d = ray.direction;
  const double ahead = c_ * d.x() + s_ * d.y();
  const double run = std::sqrt(d.x() * d.x() + d.y() * d.y());
  if (ahead < 1e-6) return false;
  const double across = (c_ * d.y() - s_ * d.x()) / ahead;
  const int a =
      std::clamp(static_cast<int>((across + half_width_) / kStep + 0.5), 0, num_columns_ - 1);
  const std::size_t n = ranges_m_.size();
  const float* row = steepest_.data() + static_cast<std::size_t>(a) * n;
  const auto slope = static_cast<float>(d.z() / run);
  const float* found = std::lower_bound(row, row + n, slope);
  if (found == row + n) return false;
  const auto k = static_cast<std::size_t>(found - row);
  double t0 = ranges_m_[k] / run;
  double t1 = k > 0 ? ranges_m_[k - 1] / run : 0.9 * t0;
  if (k > 0 && row[k] > row[k - 1]) {
    const double f = static_cast<double>((slope - row[k - 1]) / (row[k] - row[k - 1]));
    t0 = t1 + f * (t0 - t1);
    t1 = 0.99 * t0;
  }
  double relief = 0.0;
  const auto gap =
      [&](double t) {  // height of the ray above the smooth land and the relief found so far
        return ray.origin.z() + t * d.z() -
               terrain_->base_height(ray.origin.x() + t * d.x(), ray.origin.y() + t * d.y()) -
               relief;
      };
  const double g1 = gap(t1);
  const double closing = std::max(1e-4, std::abs((gap(t0) - g1) / (t0 - t1)));
  double g0 = 0.0;
  for (int i = 0; i < 4; ++i) {  // Newton on the land with the relief of the last place
    const double x = ray.origin.x() + t0 * d.x();
    const double y = ray.origin.y() + t0 * d.y();
    hit.edge_m = terrain_->edge_distance(x, y);
    relief = terrain_->relief(x, y, hit.edge_m);
    g0 = gap(t0);
    if (std::abs(g0) < 2e-5) break;
    t0 = std::clamp(t0 + g0 / closing, 0.8 * t0, 1.25 * t0);
  }
  if (t0 <= 0.0 || t0 * run > kFarthest || std::abs(g0) > 0.02) return false;
  hit.t = t0;
  hit.part = GroundPart::kRoad;
  return resolve_kerb(ray, closing, hit);
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
