#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tools/synth/random.hpp"
#include "tools/synth/route.hpp"

namespace plumb::synth {
namespace {

constexpr double kNodeStep = 5.0;       ///< [m] between the nodes whose heights are made consistent
constexpr double kRevisitReach = 14.0;  ///< [m] passes nearer than this share a road
constexpr double kSteepest = 0.2;       ///< no street rises by more per metre
constexpr double kRevisitApart = 60.0;  ///< [m] along the route before it counts as another pass

/// KITTI world (x right, y down, z forward) to map (x forward, y left, z up).
Eigen::Vector3d to_map(const Eigen::Vector3d& p) { return {p.z(), -p.x(), -p.y()}; }

std::vector<std::array<double, 12>> read_rows(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::invalid_argument("cannot read pose file " + file.string());
  std::vector<std::array<double, 12>> rows;
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream text(line);
    std::array<double, 12> row{};
    for (double& value : row) {
      if (!(text >> value) || !std::isfinite(value)) {
        throw std::invalid_argument(file.string() + ":" + std::to_string(rows.size() + 1) +
                                    ": a pose row has 12 numbers");
      }
    }
    rows.push_back(row);
  }
  if (rows.size() < 2)
    throw std::invalid_argument(file.string() + ": a route needs at least two pose rows");
  return rows;
}

/// The rear axle of each row; the camera is `ahead_m` before it.
std::vector<Eigen::Vector3d> rear_axle(const std::vector<std::array<double, 12>>& rows,
                                       double ahead_m) {
  std::vector<Eigen::Vector3d> out;
  for (const auto& r : rows) {
    const Eigen::Vector3d camera = to_map({r[3], r[7], r[11]});
    Eigen::Vector3d forward = to_map({r[2], r[6], r[10]});
    forward.z() = 0.0;
    out.push_back(camera - ahead_m * forward.normalized());
  }
  return out;
}

/// Distance travelled in plan at each row; jitter at rest does not count.
std::vector<double> distances(const std::vector<Eigen::Vector3d>& points,
                              std::vector<Eigen::Vector3d>& moved) {
  std::vector<double> s{0.0};
  moved.assign(1, points.front());
  double last = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step = (points[i] - moved.back()).head<2>().norm();
    if (step > 0.2) {
      moved.push_back(points[i]);
      last += step;
      s.push_back(last);
    } else {
      s.push_back(last + step);
    }
  }
  for (std::size_t i = s.size() - 1; i-- > 0;) s[i] = std::min(s[i], s[i + 1]);
  return s;
}

/// Pairs of nodes of different passes over the same place.
std::vector<std::pair<std::size_t, std::size_t>> revisits(
    const std::vector<Eigen::Vector3d>& nodes) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const auto apart = static_cast<std::size_t>(kRevisitApart / kNodeStep);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = i + apart; j < nodes.size(); ++j) {
      if ((nodes[i] - nodes[j]).head<2>().squaredNorm() < kRevisitReach * kRevisitReach)
        pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

/// Gives every place one height. True heights drift by metres between passes, and the difference is
/// spread over the route.
void make_heights_consistent(std::vector<RoutePoint>& points) {
  const auto stride = static_cast<std::size_t>(kNodeStep / Route::kStep);
  std::vector<Eigen::Vector3d> nodes;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    nodes.emplace_back(points[i].p_map.x(), points[i].p_map.y(), points[i].z_m);
  }
  const auto pairs = revisits(nodes);
  if (pairs.empty()) return;
  const std::size_t n = nodes.size();
  std::vector<std::vector<std::size_t>> partners(n);
  for (const auto& [i, j] : pairs) {
    partners[i].push_back(j);
    partners[j].push_back(i);
  }
  constexpr double kStiffness = 20.0;
  std::vector<double> shift(n, 0.0);
  for (int sweep = 0; sweep < 4000; ++sweep) {
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = sweep % 2 == 0 ? k : n - 1 - k;
      double weight = 0.0;
      double sum = 0.0;
      for (const std::size_t neighbour : {i - 1, i + 1}) {
        if (neighbour >= n) continue;
        sum += kStiffness * shift[neighbour];
        weight += kStiffness;
      }
      for (const std::size_t j : partners[i]) {
        sum += nodes[j].z() + shift[j] - nodes[i].z();
        weight += 1.0;
      }
      shift[i] = sum / weight;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t a = std::min(i / stride, n - 1);
    const std::size_t b = std::min(a + 1, n - 1);
    const double f = static_cast<double>(i % stride) / static_cast<double>(stride);
    points[i].z_m += shift[a] + f * (shift[b] - shift[a]);
  }
}

/// Leaves out what is too steep for a street, and shifts everything after it. True heights rise by
/// metres while a satellite fix settles, even when the car is at rest.
void leave_out_jumps(std::vector<RoutePoint>& points) {
  double before_m = points.front().z_m;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double step_m = (points[i].p_map - points[i - 1].p_map).norm();
    const double rise_m = points[i].z_m - before_m;
    before_m = points[i].z_m;
    const bool jump = std::abs(rise_m) > kSteepest * step_m;
    points[i].z_m = points[i - 1].z_m + (jump ? 0.0 : rise_m);
  }
}

void make_schedule(Route& route, const std::vector<double>& row_s, double source_rate_hz) {
  const double duration_s = static_cast<double>(row_s.size() - 1) / source_rate_hz;
  const double scale = (route.length_m()) / std::max(1e-9, row_s.back());
  const auto samples = static_cast<std::size_t>(duration_s / Schedule::kTimeStep) + 1;
  for (std::size_t k = 0; k < samples; ++k) {
    const double x = std::min(static_cast<double>(k) * Schedule::kTimeStep * source_rate_hz,
                              static_cast<double>(row_s.size() - 1) - 1e-9);
    const auto i = static_cast<std::size_t>(x);
    const double f = x - static_cast<double>(i);
    route.schedule.s_m.push_back(scale * (row_s[i] + f * (row_s[i + 1] - row_s[i])));
  }
  smooth_samples(route.schedule.s_m, 0.2 / Schedule::kTimeStep);
}

}  // namespace

Route make_pose_route(const std::filesystem::path& file, int first, int last, double source_rate_hz,
                      double camera_ahead_m, std::uint64_t seed) {
  std::vector<std::array<double, 12>> rows = read_rows(file);
  const int count = static_cast<int>(rows.size());
  if (last < 0) last = count - 1;
  if (first < 0 || first >= last || last >= count) {
    throw std::invalid_argument(file.string() + " has rows 0.." + std::to_string(count - 1) +
                                ": --start " + std::to_string(first) + " --end " +
                                std::to_string(last) + " is not within them");
  }
  rows = {rows.begin() + first, rows.begin() + last + 1};
  std::vector<Eigen::Vector3d> moved;
  const std::vector<double> row_s = distances(rear_axle(rows, camera_ahead_m), moved);
  if (row_s.back() < 5.0)
    throw std::invalid_argument(file.string() + ": the rows travel less than 5 m");

  Route route;
  route.name = file.stem().string();
  resample(moved, 1.5, route);
  make_schedule(route, row_s, source_rate_hz);
  const double mean_speed = row_s.back() / (static_cast<double>(rows.size() - 1) / source_rate_hz);
  if (mean_speed > 13.0) {  // a road between places rather than a street
    route.setting.house_ratio = 0.3;
    route.setting.tree_ratio = 0.6;
    route.setting.parked_ratio = 0.05;
    route.setting.left_m = 5.4;
    route.setting.edge_lines = true;
    route.setting.side_road_m = 160.0;
  }
  leave_out_jumps(route.points);
  extend(route, 80.0, 350.0);
  for (double& s : route.schedule.s_m) s += route.start_m;
  std::vector<double> z;
  for (const RoutePoint& p : route.points) z.push_back(p.z_m);
  smooth_samples(z, 6.0 / Route::kStep);  // the road, without the body's motion
  for (std::size_t i = 0; i < z.size(); ++i) route.points[i].z_m = z[i];
  make_heights_consistent(route.points);
  add_side_roads(route, seed);
  return route;
}

}  // namespace plumb::synth
