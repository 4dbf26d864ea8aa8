#include "tools/learn/calibrate/lens_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <future>
#include <map>
#include <nlopt.hpp>

#include "core/numbers.hpp"
#include "modules/vo/vo.hpp"
#include "tools/support/stop_flag.hpp"

namespace plumb {
namespace {

constexpr double kLostResidual_px = 1.0;
constexpr std::size_t kBlockImages = 10;
constexpr double kFewestBlocks = 5.0;
// A curvature counts when its mean over the blocks is this many times its standard deviation.
constexpr double kSureCurvature = 2.0;
constexpr double kEndOfSearchSteps = 0.5;
// The surface is trusted this far outside its grid, in steps.
constexpr double kLongestMove = 1.0;
constexpr int kMostRounds = 4;

/// Mean residual of every block of images; NaN for a block without residuals.
using Blocks = std::vector<double>;

Blocks blocks_of(const std::vector<double>& residuals) {
  Blocks blocks;
  for (std::size_t begin = 0; begin < residuals.size(); begin += kBlockImages) {
    double sum = 0.0;
    int num = 0;
    for (std::size_t i = begin; i < std::min(begin + kBlockImages, residuals.size()); ++i) {
      if (std::isnan(residuals[i])) continue;
      sum += residuals[i];
      ++num;
    }
    blocks.push_back(num > 0 ? sum / num : kNan);
  }
  return blocks;
}

/// Mean over the blocks that have residuals.
double mean_of(const Blocks& blocks) {
  double sum = 0.0;
  int num = 0;
  for (const double b : blocks) {
    if (std::isnan(b)) continue;
    sum += b;
    ++num;
  }
  return num > 0 ? sum / num : kLostResidual_px;
}

class Objective {
 public:
  Objective(const std::vector<RecordedDrive>& drives, const LensFitOptions& options,
            const LensFitProgress& progress)
      : drives_(drives), options_(options), progress_(progress) {}

  /// Runs every drive through VO with a camera that is `steps` steps away from the stated one. Each
  /// camera is run only once, because search, grid and report share some of them.
  const Blocks& run(const std::vector<const CameraParameter*>& parameters,
                    const std::vector<double>& steps) {
    CameraModel camera = drives_.front().camera;
    for (std::size_t i = 0; i < parameters.size(); ++i)
      parameters[i]->set(&camera, parameters[i]->get(camera) + parameters[i]->step * steps[i]);
    std::vector<double> values;
    for (const CameraParameter& p : camera_parameters()) values.push_back(p.get(camera));
    const auto known = known_.find(values);
    if (known != known_.end()) return known->second;
    const Blocks& blocks = known_[values] = run(camera);
    std::vector<double> shown;
    for (const CameraParameter* p : parameters) shown.push_back(p->get(camera));
    progress_(num_runs(), shown, mean_of(blocks));
    return blocks;
  }

  [[nodiscard]] int num_runs() const { return static_cast<int>(known_.size()); }
  [[nodiscard]] int most_runs() const { return options_.most_runs; }

 private:
  Blocks run(const CameraModel& camera) const {
    std::vector<std::future<std::vector<double>>> runs;
    for (const RecordedDrive& drive : drives_) {
      runs.push_back(std::async(std::launch::async, [this, &drive, &camera] {
        return residuals_of(drive, camera, options_.vo, options_.seed);
      }));
    }
    Blocks all;
    for (auto& run : runs) {
      const Blocks blocks = blocks_of(run.get());
      all.insert(all.end(), blocks.begin(), blocks.end());
    }
    if (stop_requested()) throw Stopped();
    return all;
  }

  const std::vector<RecordedDrive>& drives_;
  const LensFitOptions& options_;
  const LensFitProgress& progress_;
  std::map<std::vector<double>, Blocks> known_;  ///< by the values of all parameters
};

struct Search {
  Objective* objective;
  const std::vector<const CameraParameter*>* parameters;
};

double value_for_nlopt(const std::vector<double>& x, std::vector<double>& /*gradient*/,
                       void* search) {
  const auto* s = static_cast<const Search*>(search);
  return mean_of(s->objective->run(*s->parameters, x));
}

/// The minimum of the objective, in steps from the stated calibration.
std::vector<double> search_least(Objective* objective,
                                 const std::vector<const CameraParameter*>& parameters) {
  std::vector<double> x(parameters.size(), 0.0);
  Search search{objective, &parameters};
  // BOBYQA needs at least two parameters.
  nlopt::opt optimiser(parameters.size() > 1 ? nlopt::LN_BOBYQA : nlopt::LN_SBPLX,
                       static_cast<unsigned>(parameters.size()));
  std::vector<double> bound;
  for (const CameraParameter* p : parameters) bound.push_back(p->bound / p->step);
  optimiser.set_upper_bounds(bound);
  for (double& b : bound) b = -b;
  optimiser.set_lower_bounds(bound);
  optimiser.set_min_objective(value_for_nlopt, &search);
  optimiser.set_initial_step(1.0);
  optimiser.set_xtol_abs(kEndOfSearchSteps);
  optimiser.set_maxeval(std::max(1, objective->most_runs() - objective->num_runs()));
  double least = 0.0;
  (void)optimiser.optimize(x, least);
  return x;
}

/// The objective around a point, c + g x + x^T H x / 2, fitted by least squares to a grid of runs
/// for every block and for their mean.
struct Surface {
  Eigen::MatrixXd block_gradients;  ///< one row per block, at the point
  std::vector<Eigen::MatrixXd> block_hessians;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

/// Offsets in steps: none, one parameter at a time, and every pair of parameters.
std::vector<Eigen::VectorXd> grid_offsets(Eigen::Index n) {
  std::vector<Eigen::VectorXd> offsets{Eigen::VectorXd::Zero(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const double di : {-1.0, 1.0}) {
      offsets.push_back(di * Eigen::VectorXd::Unit(n, i));
      for (Eigen::Index j = 0; j < i; ++j)
        for (const double dj : {-1.0, 1.0})
          offsets.push_back(di * Eigen::VectorXd::Unit(n, i) + dj * Eigen::VectorXd::Unit(n, j));
    }
  }
  return offsets;
}

/// The monomials 1, x_i, then x_i x_j for j <= i.
Eigen::RowVectorXd terms_of(const Eigen::VectorXd& x) {
  const Eigen::Index n = x.size();
  Eigen::RowVectorXd row(1 + n + n * (n + 1) / 2);
  row(0) = 1.0;
  row.segment(1, n) = x.transpose();
  Eigen::Index k = 1 + n;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) row(k++) = x(i) * x(j);
  return row;
}

Eigen::MatrixXd hessian_of(const Eigen::VectorXd& coefficients, Eigen::Index n) {
  Eigen::MatrixXd H(n, n);
  Eigen::Index k = 1 + n;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j, ++k)
      H(i, j) = H(j, i) = i == j ? 2.0 * coefficients(k) : coefficients(k);
  }
  return H;
}

Surface surface_around(Objective* objective, const std::vector<const CameraParameter*>& parameters,
                       const std::vector<double>& x) {
  const auto n = static_cast<Eigen::Index>(parameters.size());
  const std::vector<Eigen::VectorXd> offsets = grid_offsets(n);
  Eigen::MatrixXd design(static_cast<Eigen::Index>(offsets.size()), 1 + n + n * (n + 1) / 2);
  std::vector<Blocks> runs;
  for (std::size_t r = 0; r < offsets.size(); ++r) {
    std::vector<double> at = x;
    for (Eigen::Index i = 0; i < n; ++i) at[static_cast<std::size_t>(i)] += offsets[r](i);
    runs.push_back(objective->run(parameters, at));
    design.row(static_cast<Eigen::Index>(r)) = terms_of(offsets[r]);
  }
  const Eigen::MatrixXd solve = (design.transpose() * design).ldlt().solve(design.transpose());
  Surface surface;
  surface.block_gradients.resize(static_cast<Eigen::Index>(runs.front().size()), n);
  for (std::size_t b = 0; b < runs.front().size(); ++b) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(runs.size()));
    for (std::size_t r = 0; r < runs.size(); ++r) values(static_cast<Eigen::Index>(r)) = runs[r][b];
    if (!values.allFinite()) continue;
    const Eigen::VectorXd coefficients = solve * values;
    surface.block_gradients.row(static_cast<Eigen::Index>(surface.block_hessians.size())) =
        coefficients.segment(1, n).transpose();
    surface.block_hessians.push_back(hessian_of(coefficients, n));
  }
  const auto num = static_cast<Eigen::Index>(surface.block_hessians.size());
  surface.block_gradients.conservativeResize(num, n);
  surface.gradient = Eigen::VectorXd::Zero(n);
  surface.hessian = Eigen::MatrixXd::Zero(n, n);
  if (num == 0) return surface;
  surface.gradient = surface.block_gradients.colwise().mean().transpose();
  for (const Eigen::MatrixXd& H : surface.block_hessians)
    surface.hessian += H / static_cast<double>(num);
  return surface;
}

/// Whether the surface is convex, and the blocks agree about its flattest direction.
bool has_least(const Surface& surface) {
  const auto num = static_cast<double>(surface.block_hessians.size());
  if (num < kFewestBlocks) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(surface.hessian);
  const Eigen::VectorXd flattest = eigen.eigenvectors().col(0);
  const double mean = eigen.eigenvalues()(0);
  double square = 0.0;
  for (const Eigen::MatrixXd& H : surface.block_hessians) {
    const double rest = flattest.dot(H * flattest) - mean;
    square += rest * rest;
  }
  return mean > kSureCurvature * std::sqrt(square / (num * (num - 1.0)));
}

struct Least {
  std::vector<double> x;    ///< in steps from the stated calibration
  std::vector<double> std;  ///< in steps; NaN where the objective has no minimum
};

/// Moves to the minimum of the surface until it lies inside the grid, then finds its standard
/// deviations.
Least refine(Objective* objective, const std::vector<const CameraParameter*>& parameters,
             std::vector<double> x) {
  const std::size_t n = parameters.size();
  Least least{x, std::vector<double>(n, kNan)};
  for (int round = 0; round < kMostRounds; ++round) {
    const Surface surface = surface_around(objective, parameters, least.x);
    if (!has_least(surface)) return least;
    const auto num = static_cast<double>(surface.block_hessians.size());
    const Eigen::MatrixXd inverse = surface.hessian.inverse();
    Eigen::VectorXd move = -inverse * surface.gradient;
    const double length = move.cwiseAbs().maxCoeff();
    if (length > kLongestMove) move *= kLongestMove / length;
    for (std::size_t i = 0; i < n; ++i) {
      const double bound = parameters[i]->bound / parameters[i]->step;
      least.x[i] = std::clamp(least.x[i] + move(static_cast<Eigen::Index>(i)), -bound, bound);
    }
    if (length > kLongestMove && round + 1 < kMostRounds) continue;
    Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(move.size(), move.size());
    for (std::size_t b = 0; b < surface.block_hessians.size(); ++b) {
      const Eigen::VectorXd g =
          surface.block_gradients.row(static_cast<Eigen::Index>(b)).transpose() +
          surface.block_hessians[b] * move;
      scatter += g * g.transpose() / (num * (num - 1.0));
    }
    const Eigen::MatrixXd cov = inverse * scatter * inverse;
    for (std::size_t i = 0; i < n; ++i)
      least.std[i] = std::sqrt(cov(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)));
    return least;
  }
  return least;
}

/// Standard deviation over the needed one; a parameter without a minimum is worst.
double excess(const CameraParameter& parameter, double std_steps) {
  return std::isnan(std_steps) ? kInf : std_steps * parameter.step / parameter.needed_std;
}

}  // namespace

std::vector<double> residuals_of(const RecordedDrive& drive, const CameraModel& camera,
                                 const VoConfig& config, std::uint64_t seed) {
  VisualOdometry vo(config, camera, seed);
  NullProbe probe;
  std::vector<double> residuals;
  for (std::size_t i = 0; i < drive.images.size() && !stop_requested(); ++i) {
    const RecordedImage& image = drive.images[i];
    const VoOutput& out = vo.update({image.capture_us, image.seq, drive.view(i)}, probe);
    const bool followed = out.status == VoStatus::kOk && out.rms_residual_px > 0.0;
    const bool lost = out.status == VoStatus::kLost || out.status == VoStatus::kCoasting;
    residuals.push_back(followed ? std::min(out.rms_residual_px, kLostResidual_px)
                        : lost   ? kLostResidual_px
                                 : kNan);
  }
  return residuals;
}

LensFit fit_lens(const std::vector<RecordedDrive>& drives,
                 const std::vector<const CameraParameter*>& wanted, const LensFitOptions& options,
                 const LensFitProgress& progress) {
  Objective objective(drives, options, progress);
  LensFit fit;
  const CameraModel& stated = drives.front().camera;
  for (const CameraParameter* p : wanted)
    fit.parameters.push_back({p, p->get(stated), p->get(stated), kNan, false});
  fit.stated_residual_px = fit.residual_px =
      mean_of(objective.run(wanted, std::vector<double>(wanted.size(), 0.0)));

  std::vector<std::size_t> left(wanted.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  while (!left.empty()) {
    std::vector<const CameraParameter*> parameters;
    for (const std::size_t i : left) parameters.push_back(wanted[i]);
    const auto [x, stds] = refine(&objective, parameters, search_least(&objective, parameters));
    std::size_t worst = 0;
    for (std::size_t k = 0; k < left.size(); ++k) {
      fit.parameters[left[k]].std = stds[k] * parameters[k]->step;
      if (excess(*parameters[k], stds[k]) >= excess(*parameters[worst], stds[worst])) worst = k;
    }
    if (excess(*parameters[worst], stds[worst]) <= 1.0) {
      for (std::size_t k = 0; k < left.size(); ++k) {
        FittedParameter& p = fit.parameters[left[k]];
        p.observed = true;
        p.value = p.stated + x[k] * parameters[k]->step;
      }
      fit.residual_px = mean_of(objective.run(parameters, x));
      break;
    }
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  fit.num_runs = objective.num_runs();
  return fit;
}

}  // namespace plumb
