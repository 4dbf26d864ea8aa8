/// Lens terms that let VO explain the drives best: the mean residual of its own points, over whole runs of it, has its
/// least where the lens is right. Turns show it: there each point crosses the image.
///
/// BOBYQA (Powell 2009, by NLopt) comes near; a quadratic surface through a grid of runs, which averages what the choice
/// of features does to single runs, gives the least itself. Deviations are the sandwich H^-1 G H^-1 of the surface's
/// curvature and of the scatter of its gradient over blocks of images.
/// A parameter whose deviation is larger than it needs to be keeps what the calibration stated, and the rest is fitted
/// anew: the one that is worst off first.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "modules/vo/vo_config.hpp"
#include "tools/learn/calibrate/camera_parameters.hpp"
#include "tools/learn/calibrate/recorded_drive.hpp"

namespace plumb {

struct FittedParameter {
  const CameraParameter* parameter = nullptr;
  double stated = 0.0;
  double value = 0.0;  ///< `stated` when not observed
  double std = 0.0;    ///< NaN where the objective has no least
  bool observed = false;
};

struct LensFit {
  std::vector<FittedParameter> parameters;
  double stated_residual_px = 0.0;
  double residual_px = 0.0;
  int num_runs = 0;
};

struct LensFitOptions {
  VoConfig vo;
  std::uint64_t seed = 1;
  int most_runs = 120;
};

/// Called after every run over all drives: how many, the parameters in hand and the residual.
using LensFitProgress =
    std::function<void(int num_runs, const std::vector<double>& values, double residual_px)>;

/// @pre drives and wanted not empty, all drives of the same camera. Throws Stopped when `stop_requested()`.
[[nodiscard]] LensFit fit_lens(const std::vector<RecordedDrive>& drives,
                               const std::vector<const CameraParameter*>& wanted,
                               const LensFitOptions& options, const LensFitProgress& progress);

/// SIGINT or SIGTERM came.
class Stopped : public std::exception {};

/// Residual of every image [px]; what VO did not follow counts as 1 px, images before its start and at rest as NaN.
[[nodiscard]] std::vector<double> residuals_of(const RecordedDrive& drive,
                                               const CameraModel& camera, const VoConfig& config,
                                               std::uint64_t seed);

}  // namespace plumb
