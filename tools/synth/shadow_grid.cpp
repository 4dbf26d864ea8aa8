#include "tools/synth/shadow_grid.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::synth {

void ShadowGrid::build(const std::vector<Primitive>& solids, const Eigen::Vector3d& to_light,
                       double cell_m) {
  solids_ = &solids;
  to_light_ = to_light;
  cell_m_ = cell_m;
  axis_u_ = to_light.unitOrthogonal();
  axis_v_ = to_light.cross(axis_u_);
  struct Range {
    int u0, u1, v0, v1;
  };
  std::vector<Range> ranges;
  ranges.reserve(solids.size());
  int u1 = -1'000'000;
  int v1 = -1'000'000;
  u0_ = 1'000'000;
  v0_ = 1'000'000;
  for (const Primitive& s : solids) {
    // The box's half extents as seen from the light.
    const Eigen::Vector3d lu = (s.R_map_local.transpose() * axis_u_).cwiseAbs();
    const Eigen::Vector3d lv = (s.R_map_local.transpose() * axis_v_).cwiseAbs();
    const double u = s.centre.dot(axis_u_);
    const double v = s.centre.dot(axis_v_);
    const auto cell = [this](double x) { return static_cast<int>(std::floor(x / cell_m_)); };
    ranges.push_back({cell(u - lu.dot(s.half)), cell(u + lu.dot(s.half)), cell(v - lv.dot(s.half)),
                      cell(v + lv.dot(s.half))});
    u0_ = std::min(u0_, ranges.back().u0);
    v0_ = std::min(v0_, ranges.back().v0);
    u1 = std::max(u1, ranges.back().u1);
    v1 = std::max(v1, ranges.back().v1);
  }
  nu_ = solids.empty() ? 0 : u1 - u0_ + 1;
  nv_ = solids.empty() ? 0 : v1 - v0_ + 1;
  first_.assign(static_cast<std::size_t>(nu_) * static_cast<std::size_t>(nv_) + 1, 0);
  const auto for_cells = [&](const Range& r, auto&& visit) {
    for (int v = r.v0; v <= r.v1; ++v) {
      for (int u = r.u0; u <= r.u1; ++u)
        visit(static_cast<std::size_t>((v - v0_) * nu_ + (u - u0_)));
    }
  };
  for (const Range& r : ranges) for_cells(r, [&](std::size_t k) { ++first_[k + 1]; });
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  entries_.assign(static_cast<std::size_t>(first_.back()), 0);
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    for_cells(ranges[i], [&](std::size_t k) {
      entries_[static_cast<std::size_t>(next[k]++)] = static_cast<std::int32_t>(i);
    });
  }
}

bool ShadowGrid::hidden(const Eigen::Vector3d& p_map, double softness_rad,
                        const VolumeNoise& noise) const {
  if (nu_ == 0) return false;
  const int u = static_cast<int>(std::floor(p_map.dot(axis_u_) / cell_m_)) - u0_;
  const int v = static_cast<int>(std::floor(p_map.dot(axis_v_) / cell_m_)) - v0_;
  if (u < 0 || v < 0 || u >= nu_ || v >= nv_) return false;
  const auto k = static_cast<std::size_t>(v * nu_ + u);
  const Ray ray{p_map, to_light_};
  for (std::int32_t i = first_[k]; i < first_[k + 1]; ++i) {
    Hit hit;
    if (intersect((*solids_)[static_cast<std::size_t>(entries_[static_cast<std::size_t>(i)])], ray,
                  softness_rad, noise, hit))
      return true;
  }
  return false;
}

}  // namespace plumb::synth
