/// Fits lens terms to drives by minimising the residuals of visual odometry.
///
/// Objective:
///   The mean residual of VO's points over whole runs is least for the right lens. Turns make
///   it observable, because each point then crosses the image.
/// Method:
///   BOBYQA (Powell 2009, from NLopt) comes close to the minimum. A quadratic surface through
///   a grid of runs then gives the minimum itself; it averages out the effect that the choice
///   of features has on single runs.
/// Variance:
///   Standard deviations come from the sandwich H^-1 G H^-1 with the curvature H of the
///   surface and the scatter G of its gradient over blocks of images.
/// A parameter whose standard deviation is too large keeps its stated value, and the others are
/// fitted again. The worst parameter is dropped first.
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
  double std = 0.0;    ///< NaN where the objective has no minimum
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

/// Called after every run over all drives with the number of runs, the parameters and the residual.
using LensFitProgress =
    std::function<void(int num_runs, const std::vector<double>& values, double residual_px)>;

/// Throws Stopped when `stop_requested()`.
/// @pre `drives` and `wanted` are not empty, and all drives have the same camera.
[[nodiscard]] LensFit fit_lens(const std::vector<RecordedDrive>& drives,
                               const std::vector<const CameraParameter*>& wanted,
                               const LensFitOptions& options, const LensFitProgress& progress);

/// Thrown when SIGINT or SIGTERM stops a fit.
class Stopped : public std::exception {};

/// Residual of every image [px]. A lost track counts as 1 px; images before initialisation and
/// images at rest are NaN.
[[nodiscard]] std::vector<double> residuals_of(const RecordedDrive& drive,
                                               const CameraModel& camera, const VoConfig& config,
                                               std::uint64_t seed);

}  // namespace plumb
