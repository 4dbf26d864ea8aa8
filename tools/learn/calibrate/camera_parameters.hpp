/// The parameters of a camera that can be found from drives, one number each.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/camera_model.hpp"

namespace plumb {

struct CameraParameter {
  const char* key;  ///< on the command line and in the report
  const char* unit;
  const char* meaning;
  double step;        ///< of the search, and of the differences for the standard deviation
  double bound;       ///< largest change from the stated calibration
  double needed_std;  ///< with a larger standard deviation it counts as not observed
  double (*get)(const CameraModel& camera);
  void (*set)(CameraModel* camera, double value);
};

/// k1, k2, focal, row.
[[nodiscard]] const std::array<CameraParameter, 4>& camera_parameters();

/// Parses names with commas between them ("k1,k2"). Throws InputError for an unknown name and for
/// one that comes twice.
[[nodiscard]] std::vector<const CameraParameter*> parse_parameters(const std::string& names);

}  // namespace plumb
