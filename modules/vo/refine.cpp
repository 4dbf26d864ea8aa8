#include "modules/vo/refine.hpp"

#include <algorithm>
#include <cmath>

#include "modules/vo/pose.hpp"

namespace plumb::vo {
namespace {

constexpr double kRefineCauchy2 = 1.0;  // [px^2] c^2 of the kernel
constexpr double kStartDamping = 1e-5;
constexpr double kDampingUp = 20.0;
constexpr double kMaxDamping = 1.0;
// Relative decrease of the cost below which the refinement has converged.
constexpr double kConverged = 1e-4;
constexpr double kDiagonalFloor = 1e-6;
// Prior of every inverse depth, for rho_std only: it bounds the standard deviation by 0.3.
constexpr double kRhoPriorInformation = 1.0 / 0.09;

// Solves A x = b in place by A = U^T U, for a symmetric positive definite A whose upper triangle is
// given in row-major order. Returns false when A is not positive definite.
bool solve_cholesky(double* A, double* b, int n) {
  for (int j = 0; j < n; ++j) {
    double* row = A + static_cast<std::ptrdiff_t>(j) * n;
    if (!(row[j] > 0.0)) return false;
    const double inv = 1.0 / std::sqrt(row[j]);
    for (int k = j; k < n; ++k) row[k] *= inv;
    for (int i = j + 1; i < n; ++i) {
      const double f = row[i];
      double* below = A + static_cast<std::ptrdiff_t>(i) * n;
      for (int k = i; k < n; ++k) below[k] -= f * row[k];
    }
  }
  for (int i = 0; i < n; ++i) {  // forward substitution, U^T y = b
    b[i] /= A[i * n + i];
    for (int k = i + 1; k < n; ++k) b[k] -= A[i * n + k] * b[i];
  }
  for (int i = n - 1; i >= 0; --i) {  // backward substitution, U x = y
    double sum = b[i];
    for (int k = i + 1; k < n; ++k) sum -= A[i * n + k] * b[k];
    b[i] = sum / A[i * n + i];
  }
  return true;
}

}  // namespace

WindowRefiner::WindowRefiner(int track_capacity)
    : structures_(static_cast<std::size_t>(track_capacity)) {}

// Chooses the frames that are free and the tracks that connect frames. A passive track needs two
// frames besides its host, because its inverse depth takes up what one of them says.
void WindowRefiner::choose(const Window& window, const TrackTable& tracks, int fixed_keyframes) {
  const int num_keyframes = window.num_keyframes();
  const int num_fixed =
      std::clamp(std::min(fixed_keyframes, num_keyframes / 2), 1, std::max(1, num_keyframes - 1));
  free_of_slot_.fill(-1);
  free_slots_.clear();
  std::uint32_t in_window = 0;
  int position = 0;
  for (const int slot : window.order()) {
    in_window |= 1U << slot;
    if (position++ < num_fixed) continue;
    free_of_slot_[static_cast<std::size_t>(slot)] = static_cast<int>(free_slots_.size());
    static_cast<void>(free_slots_.push_back(slot));
  }
  num_structures_ = 0;
  const auto take = [&](int index, int least) {
    const Track& track = tracks[index];
    const std::uint32_t others = track.seen & in_window & ~(1U << track.host);
    if (__builtin_popcount(others) >= least) structures_[num_structures_++].track = index;
  };
  for (const int index : tracks.active()) take(index, 1);
  for (const int index : tracks.passive()) take(index, 2);
}

// Adds one track to the normal equations of the frames, and fills its own part.
void WindowRefiner::add_track(const Window& window, const TrackTable& tracks,
                              const Eigen::Vector2d& focal_px, Structure* s) {
  const Track& track = tracks[s->track];
  const int host_free = free_of_slot_[static_cast<std::size_t>(track.host)];
  const Se3& T_world_host = T_world_cam_[static_cast<std::size_t>(track.host)];
  s->hrr = 1e-8;
  s->br = 0.0;
  s->num_couplings = 0;
  Vector6d host_w = Vector6d::Zero();
  for (const int slot : window.order()) {
    if (slot == track.host || !track.seen_in(slot)) continue;
    const Se3 T_frame_host = window[slot].T_cam_world * T_world_host;
    const PointInFrame p =
        transfer(T_frame_host, track.host_xy, track.rho, track.xy_in(slot), focal_px);
    if (!p.in_front) continue;
    const double e2 = p.residual_px.squaredNorm();
    const double weight = 1.0 / (1.0 + e2 / kRefineCauchy2);
    cost_ += kRefineCauchy2 * std::log(1.0 + e2 / kRefineCauchy2);
    const Matrix23d D = projection_jacobian(p.Y, focal_px);
    const Eigen::Vector2d d = D * T_frame_host.t;
    s->hrr += weight * d.squaredNorm();
    s->br += weight * d.dot(p.residual_px);
    const int frame_free = free_of_slot_[static_cast<std::size_t>(slot)];
    Matrix26d J_frame;
    if (frame_free >= 0) {
      J_frame = frame_jacobian(D, p.Y, track.rho);
      const Matrix26d WJ = weight * J_frame;
      block(frame_free, frame_free).noalias() += WJ.transpose() * J_frame;
      gradient_[static_cast<std::size_t>(frame_free)].noalias() += WJ.transpose() * p.residual_px;
      Coupling& c = s->couplings[static_cast<std::size_t>(s->num_couplings++)];
      c.free = frame_free;
      c.w.noalias() = WJ.transpose() * d;
    }
    if (host_free >= 0) {
      const Matrix26d J_host = host_jacobian(D, T_frame_host.R, track.host_xy, track.rho);
      const Matrix26d WJ = weight * J_host;
      block(host_free, host_free).noalias() += WJ.transpose() * J_host;
      gradient_[static_cast<std::size_t>(host_free)].noalias() += WJ.transpose() * p.residual_px;
      host_w.noalias() += WJ.transpose() * d;
      if (frame_free > host_free) {
        block(host_free, frame_free).noalias() += WJ.transpose() * J_frame;
      } else if (frame_free >= 0) {
        block(frame_free, host_free).noalias() += J_frame.transpose() * WJ;
      }
    }
  }
  if (host_free >= 0) {
    Coupling& c = s->couplings[static_cast<std::size_t>(s->num_couplings++)];
    c.free = host_free;
    c.w = host_w;
  }
}

// Eliminates the inverse depth of one track: H_ff -= w w^T / hrr, b_f -= w br / hrr.
void WindowRefiner::eliminate(Structure& s) {
  s.hrr *= 1.0 + damping_;
  const double inv = 1.0 / s.hrr;
  for (int i = 0; i < s.num_couplings; ++i) {
    const Coupling& a = s.couplings[static_cast<std::size_t>(i)];
    gradient_[static_cast<std::size_t>(a.free)] -= a.w * (s.br * inv);
    const Vector6d scaled = a.w * inv;
    for (int j = 0; j < s.num_couplings; ++j) {
      const Coupling& b = s.couplings[static_cast<std::size_t>(j)];
      if (b.free < a.free) continue;
      block(a.free, b.free).noalias() -= scaled * b.w.transpose();
    }
  }
}

// Builds the reduced normal equations of the frames, and computes the cost.
void WindowRefiner::build(const Window& window, const TrackTable& tracks,
                          const Eigen::Vector2d& focal_px) {
  for (const int slot : window.order()) {
    T_world_cam_[static_cast<std::size_t>(slot)] = window[slot].T_cam_world.inverse();
  }
  for (Matrix6d& b : blocks_) b.setZero();
  for (Vector6d& g : gradient_) g.setZero();
  cost_ = 0.0;
  for (std::size_t i = 0; i < num_structures_; ++i) {
    add_track(window, tracks, focal_px, &structures_[i]);
    eliminate(structures_[i]);
  }
}

// Solves the reduced normal equations for the step of the frames. Returns false when they are not
// positive definite.
bool WindowRefiner::solve() {
  const auto num_free = static_cast<int>(free_slots_.size());
  const int n = 6 * num_free;
  for (int r = 0; r < num_free; ++r) {
    for (int c = r; c < num_free; ++c) {
      const Matrix6d& B = block(r, c);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
          const int at = (6 * r + i) * n + 6 * c + j;
          dense_[static_cast<std::size_t>(at)] = B(i, j);
        }
      }
    }
    for (int i = 0; i < 6; ++i) {
      const int row = 6 * r + i;
      const int at = row * (n + 1);
      double& diagonal = dense_[static_cast<std::size_t>(at)];
      diagonal = diagonal * (1.0 + damping_) + kDiagonalFloor;
      rhs_[static_cast<std::size_t>(row)] = gradient_[static_cast<std::size_t>(r)][i];
    }
  }
  if (!solve_cholesky(dense_.data(), rhs_.data(), n)) return false;
  for (int r = 0; r < num_free; ++r) {
    for (int i = 0; i < 6; ++i) {
      const int row = 6 * r + i;
      step_[static_cast<std::size_t>(r)][i] = rhs_[static_cast<std::size_t>(row)];
    }
    if (!step_[static_cast<std::size_t>(r)].allFinite()) return false;
  }
  return true;
}

void WindowRefiner::save(const Window& window, const TrackTable& tracks) {
  for (const int slot : free_slots_) {
    saved_poses_[static_cast<std::size_t>(slot)] = window[slot].T_cam_world;
  }
  for (std::size_t i = 0; i < num_structures_; ++i) {
    structures_[i].rho_before = tracks[structures_[i].track].rho;
  }
}

void WindowRefiner::restore(Window& window, TrackTable& tracks) const {
  for (const int slot : free_slots_) {
    window[slot].T_cam_world = saved_poses_[static_cast<std::size_t>(slot)];
  }
  for (std::size_t i = 0; i < num_structures_; ++i) {
    tracks[structures_[i].track].rho = structures_[i].rho_before;
  }
}

// Applies the step to the frames and computes the steps of the inverse depths from it. A step is
// limited so that an inverse depth stays positive and grows at most about threefold.
void WindowRefiner::apply(Window& window, TrackTable& tracks) {
  for (std::size_t i = 0; i < free_slots_.size(); ++i) {
    perturb(window[free_slots_[i]].T_cam_world, step_[i]);
  }
  for (std::size_t i = 0; i < num_structures_; ++i) {
    Structure& s = structures_[i];
    double b = s.br;
    for (int k = 0; k < s.num_couplings; ++k) {
      const Coupling& c = s.couplings[static_cast<std::size_t>(k)];
      b -= c.w.dot(step_[static_cast<std::size_t>(c.free)]);
    }
    Track& track = tracks[s.track];
    track.rho += std::clamp(b / s.hrr, -0.7 * track.rho, 2.0 * track.rho + 0.05);
    track.rho = std::max(track.rho, kMinRho);
    track.rho_std = 1.0 / std::sqrt(s.hrr / (kPixelStd * kPixelStd) + kRhoPriorInformation);
  }
}

void WindowRefiner::refine(Window& window, TrackTable& tracks, const Eigen::Vector2d& focal_px,
                           int fixed_keyframes, int max_iterations) {
  choose(window, tracks, fixed_keyframes);
  if (free_slots_.empty() || num_structures_ == 0) return;
  damping_ = kStartDamping;
  double best = -1.0;  // cost at the saved state; negative when none is saved
  for (int i = 0; i < max_iterations; ++i) {
    build(window, tracks, focal_px);
    if (best >= 0.0 && cost_ > best * (1.0 + 1e-9)) {
      restore(window, tracks);
      damping_ *= kDampingUp;
      best = -1.0;
      if (damping_ > kMaxDamping) break;
      continue;
    }
    const bool converged = best >= 0.0 && best - cost_ < kConverged * cost_;
    best = cost_;
    save(window, tracks);
    if (converged || !solve()) break;
    apply(window, tracks);
  }
}

TrackFit check_track(const Track& track, const Window& window, const Eigen::Vector2d& focal_px,
                     double bad_px) {
  constexpr double kBehind = 99.0;
  TrackFit fit;
  const Se3 T_world_host = window[track.host].T_cam_world.inverse();
  for (const int slot : window.order()) {
    if (slot == track.host || !track.seen_in(slot)) continue;
    const Se3 T_frame_host = window[slot].T_cam_world * T_world_host;
    const PointInFrame p =
        transfer(T_frame_host, track.host_xy, track.rho, track.xy_in(slot), focal_px);
    fit.newest_px = p.in_front ? p.residual_px.norm() : kBehind;
    ++fit.num;
    if (fit.newest_px > bad_px) ++fit.num_bad;
  }
  return fit;
}

}  // namespace plumb::vo
