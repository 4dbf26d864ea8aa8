/// What of a camera can be found out of drives, one number each.
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
  double step;        ///< of the search, and of the differences that tell the deviation
  double bound;       ///< largest change from the stated calibration
  double needed_std;  ///< a larger deviation counts as not observed
  double (*get)(const CameraModel& camera);
  void (*set)(CameraModel* camera, double value);
};

/// k1, k2, focal, row.
[[nodiscard]] const std::array<CameraParameter, 4>& camera_parameters();

/// Throws InputError for a name that is none of them or comes twice. `names`: "k1,k2".
[[nodiscard]] std::vector<const CameraParameter*> parse_parameters(const std::string& names);

}  // namespace plumb
