#include "tools/synth/terrain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plumb::synth {
namespace {

constexpr double kMargin = 420.0;    ///< [m] land beyond the route
constexpr double kHeightCell = 4.0;  ///< [m]
constexpr double kEdgeCell = 1.0;    ///< [m]
constexpr int kBlock = 32;           ///< edge cells per block side
constexpr int kBlockCells = kBlock * kBlock;
constexpr double kEdgeReach = 46.0;   ///< [m] from the lane's centre
constexpr double kCornerRound = 4.0;  ///< [m] how far the edges of two roads blend

/// Weights of the uniform cubic B-spline.
std::array<double, 4> spline_weights(double f) {
  const double g = 1.0 - f;
  return {g * g * g / 6.0, (3.0 * f * f * f - 6.0 * f * f + 4.0) / 6.0,
          (3.0 * g * g * g - 6.0 * g * g + 4.0) / 6.0, f * f * f / 6.0};
}

/// Minimum with a rounded corner.
double round_min(double a, double b) {
  const double h = std::max(kCornerRound - std::abs(a - b), 0.0) / kCornerRound;
  return std::min(a, b) - 0.25 * kCornerRound * h * h;
}

}  // namespace

Terrain::Terrain(const Route& route) : route_(&route) {
  Eigen::Vector2d low = route.points.front().p_map;
  Eigen::Vector2d high = low;
  for (const RoutePoint& p : route.points) {
    low = low.cwiseMin(p.p_map);
    high = high.cwiseMax(p.p_map);
  }
  origin_ = low.array() - kMargin;
  const Eigen::Vector2d size = high - low + Eigen::Vector2d::Constant(2.0 * kMargin);
  height_nx_ = static_cast<int>(size.x() / kHeightCell) + 4;
  height_ny_ = static_cast<int>(size.y() / kHeightCell) + 4;
  block_nx_ = static_cast<int>(size.x() / (kEdgeCell * kBlock)) + 2;
  block_ny_ = static_cast<int>(size.y() / (kEdgeCell * kBlock)) + 2;
  for (const Bump& bump : route.bumps) {
    const RoutePoint p = route.at(bump.s_m);
    const Eigen::Vector2d along(std::cos(p.yaw_rad), std::sin(p.yaw_rad));
    bumps_.push_back({p.p_map, along, bump.height_m, bump.half_length_m,
                      std::max(route.setting.left_m, route.setting.right_m) + 1.0});
  }
  build_heights();
  build_edges();
}

void Terrain::build_heights() {
  heights_.assign(static_cast<std::size_t>(height_nx_) * static_cast<std::size_t>(height_ny_),
                  0.0F);
  if (route_->flat) return;
  std::vector<Eigen::Vector3d> nodes;
  for (std::size_t i = 0; i < route_->points.size(); i += 8) {
    nodes.emplace_back(route_->points[i].p_map.x(), route_->points[i].p_map.y(),
                       route_->points[i].z_m);
  }
  std::size_t k = 0;
  for (int iy = 0; iy < height_ny_; ++iy) {
    for (int ix = 0; ix < height_nx_; ++ix, ++k) {
      const Eigen::Vector2d p = origin_ + kHeightCell * Eigen::Vector2d(ix, iy);
      double weight = 0.0;
      double sum = 0.0;
      for (const Eigen::Vector3d& node : nodes) {
        const double d2 = (node.head<2>() - p).squaredNorm() + 9.0;
        const double w = 1.0 / (d2 * d2);
        weight += w;
        sum += w * node.z();
      }
      heights_[k] = static_cast<float>(sum / weight);
    }
  }
}

Terrain::Cell* Terrain::cell_at(int cx, int cy) {
  const int bx = cx / kBlock;
  const int by = cy / kBlock;
  if (cx < 0 || cy < 0 || bx >= block_nx_ || by >= block_ny_) return nullptr;
  std::int32_t& block = block_of_[static_cast<std::size_t>(by * block_nx_ + bx)];
  if (block < 0) {
    block = static_cast<std::int32_t>(cells_.size() / kBlockCells);
    cells_.resize(cells_.size() + kBlockCells);
  }
  const int inside = (cy % kBlock) * kBlock + cx % kBlock;
  return &cells_[static_cast<std::size_t>(block) * kBlockCells + static_cast<std::size_t>(inside)];
}

const Terrain::Cell* Terrain::find_cell(int cx, int cy) const {
  const int bx = cx / kBlock;
  const int by = cy / kBlock;
  if (cx < 0 || cy < 0 || bx >= block_nx_ || by >= block_ny_) return nullptr;
  const std::int32_t block = block_of_[static_cast<std::size_t>(by * block_nx_ + bx)];
  if (block < 0) return nullptr;
  const int inside = (cy % kBlock) * kBlock + cx % kBlock;
  return &cells_[static_cast<std::size_t>(block) * kBlockCells + static_cast<std::size_t>(inside)];
}

void Terrain::stamp_point(std::size_t index) {
  const RoutePoint& point = route_->points[index];
  const Setting& setting = route_->setting;
  const Eigen::Vector2d along(std::cos(point.yaw_rad), std::sin(point.yaw_rad));
  const Eigen::Vector2d left(-along.y(), along.x());
  const Eigen::Vector2d centre = (point.p_map - origin_) / kEdgeCell;
  const int reach = static_cast<int>(kEdgeReach / kEdgeCell);
  const int x0 = static_cast<int>(centre.x());
  const int y0 = static_cast<int>(centre.y());
  for (int cy = y0 - reach; cy <= y0 + reach; ++cy) {
    for (int cx = x0 - reach; cx <= x0 + reach; ++cx) {
      const Eigen::Vector2d d = kEdgeCell * (Eigen::Vector2d(cx, cy) - centre);
      const double a = std::abs(d.dot(along));
      const double l = d.dot(left);
      if (a > 0.6 + std::abs(l * point.curvature) || a > 6.0) continue;
      Cell* cell = cell_at(cx, cy);
      if (cell == nullptr) continue;
      const auto edge = static_cast<float>(std::max(l - setting.left_m, -setting.right_m - l));
      const bool nearer = edge < cell->edge_main - 0.3F;
      if (nearer || (edge < cell->edge_main + 0.3F && a < static_cast<double>(cell->along))) {
        cell->nearest = static_cast<std::int32_t>(index);
        cell->along = static_cast<float>(a);
      }
      cell->edge_main = std::min(cell->edge_main, edge);
    }
  }
}

void Terrain::stamp_side_road(const SideRoad& road) {
  const Eigen::Vector2d span = road.to - road.from;
  const double length = span.norm();
  const Eigen::Vector2d along = span / length;
  const double reach = 30.0;
  const Eigen::Vector2d low = (road.from.cwiseMin(road.to) - origin_).array() - reach;
  const Eigen::Vector2d high = (road.from.cwiseMax(road.to) - origin_).array() + reach;
  for (int cy = static_cast<int>(low.y()); cy <= static_cast<int>(high.y()); ++cy) {
    for (int cx = static_cast<int>(low.x()); cx <= static_cast<int>(high.x()); ++cx) {
      const Eigen::Vector2d d = origin_ + kEdgeCell * Eigen::Vector2d(cx, cy) - road.from;
      const double a = d.dot(along);
      const double across = std::abs(along.x() * d.y() - along.y() * d.x());
      if (a < -road.half_width_m || a > length || across > reach) continue;
      Cell* cell = cell_at(cx, cy);
      if (cell != nullptr)
        cell->edge_side = std::min(cell->edge_side, static_cast<float>(across - road.half_width_m));
    }
  }
}

void Terrain::build_edges() {
  block_of_.assign(static_cast<std::size_t>(block_nx_) * static_cast<std::size_t>(block_ny_), -1);
  for (std::size_t i = 0; i < route_->points.size(); i += 2) stamp_point(i);
  for (const SideRoad& road : route_->side_roads) stamp_side_road(road);
}

double Terrain::base_height(double x, double y) const {
  const double gx = std::clamp((x - origin_.x()) / kHeightCell, 1.0, height_nx_ - 3.0);
  const double gy = std::clamp((y - origin_.y()) / kHeightCell, 1.0, height_ny_ - 3.0);
  const int ix = static_cast<int>(gx);
  const int iy = static_cast<int>(gy);
  const auto wx = spline_weights(gx - ix);
  const auto wy = spline_weights(gy - iy);
  const float* row = heights_.data() + static_cast<std::ptrdiff_t>(iy - 1) * height_nx_ + (ix - 1);
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j, row += height_nx_) {
    sum += wy[j] * (wx[0] * static_cast<double>(row[0]) + wx[1] * static_cast<double>(row[1]) +
                    wx[2] * static_cast<double>(row[2]) + wx[3] * static_cast<double>(row[3]));
  }
  return sum;
}

double Terrain::edge_distance(double x, double y) const {
  const double gx = (x - origin_.x()) / kEdgeCell;
  const double gy = (y - origin_.y()) / kEdgeCell;
  if (gx < 0.0 || gy < 0.0) return static_cast<double>(kFar);
  const int ix = static_cast<int>(gx);
  const int iy = static_cast<int>(gy);
  static constexpr Cell kNone{};
  std::array<const Cell*, 4> c{};
  c[0] = find_cell(ix, iy);
  if (ix % kBlock != kBlock - 1 && iy % kBlock != kBlock - 1) {  // all four in one block
    if (c[0] == nullptr) return static_cast<double>(kFar);
    c = {c[0], c[0] + 1, c[0] + kBlock, c[0] + kBlock + 1};
  } else {
    c = {c[0], find_cell(ix + 1, iy), find_cell(ix, iy + 1), find_cell(ix + 1, iy + 1)};
    for (const Cell*& cell : c) cell = cell != nullptr ? cell : &kNone;
  }
  const auto fx = static_cast<float>(gx - ix);
  const auto fy = static_cast<float>(gy - iy);
  const auto mixed = [&](float Cell::*field) {
    const float low = c[0]->*field + fx * (c[1]->*field - c[0]->*field);
    const float high = c[2]->*field + fx * (c[3]->*field - c[2]->*field);
    return static_cast<double>(low + fy * (high - low));
  };
  const double main = mixed(&Cell::edge_main);
  const double side = mixed(&Cell::edge_side);
  return side - main < kCornerRound ? round_min(main, side) : main;
}

RoadCoordinate Terrain::road_coordinate(double x, double y) const {
  const Cell* cell = find_cell(static_cast<int>((x - origin_.x()) / kEdgeCell + 0.5),
                               static_cast<int>((y - origin_.y()) / kEdgeCell + 0.5));
  if (cell == nullptr || cell->nearest < 0) return {};
  auto i = static_cast<std::size_t>(cell->nearest);
  RoadCoordinate out;
  for (int round = 0; round < 2; ++round) {
    const RoutePoint& p = route_->points[i];
    const double c = p.along.x();
    const double s = p.along.y();
    const double dx = x - p.p_map.x();
    const double dy = y - p.p_map.y();
    const double d = c * dy - s * dx;
    const double along = (c * dx + s * dy) / std::max(0.2, 1.0 - p.curvature * d);
    out = {true, static_cast<double>(i) * Route::kStep + along, d, p.along};
    const auto moved =
        static_cast<std::ptrdiff_t>(i) + std::lround(std::clamp(along, -2.0, 2.0) / Route::kStep);
    i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        moved, 0, static_cast<std::ptrdiff_t>(route_->points.size()) - 1));
  }
  return out;
}

double Terrain::bump_height(double x, double y) const {
  double sum = 0.0;
  for (const PlacedBump& bump : bumps_) {
    const Eigen::Vector2d d = Eigen::Vector2d(x, y) - bump.centre;
    const double along = d.dot(bump.along) / bump.half_length_m;
    const double across = std::abs(bump.along.x() * d.y() - bump.along.y() * d.x());
    if (std::abs(along) >= 1.0 || across > bump.half_width_m) continue;
    sum += bump.height_m * 0.5 * (1.0 + std::cos(3.14159265358979 * along));
  }
  return sum;
}

double Terrain::relief(double x, double y, double edge_m) const {
  if (route_->flat) return 0.0;
  const double half_width = 0.5 * (route_->setting.left_m + route_->setting.right_m);
  const double inward = std::clamp(-edge_m / half_width, 0.0, 1.0);
  return kCrown * (1.0 - (1.0 - inward) * (1.0 - inward)) +
         (bumps_.empty() ? 0.0 : bump_height(x, y));
}

double Terrain::height(double x, double y) const {
  const double base = base_height(x, y);
  if (route_->flat) return base;
  const double half_width = 0.5 * (route_->setting.left_m + route_->setting.right_m);
  const double inward = std::clamp(-edge_distance(x, y) / half_width, 0.0, 1.0);
  return base + kCrown * (1.0 - (1.0 - inward) * (1.0 - inward)) +
         (bumps_.empty() ? 0.0 : bump_height(x, y));
}

Eigen::Vector3d Terrain::normal(double x, double y) const {
  constexpr double kStep = 0.3;
  const double dx = (height(x + kStep, y) - height(x - kStep, y)) / (2.0 * kStep);
  const double dy = (height(x, y + kStep) - height(x, y - kStep)) / (2.0 * kStep);
  return Eigen::Vector3d(-dx, -dy, 1.0).normalized();
}

}  // namespace plumb::synth
