#include "tools/learn/calibrate/camera_parameters.hpp"

#include <algorithm>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"
#include "platform/nearest_word.hpp"

namespace plumb {
namespace {

std::vector<std::string> keys_of(const std::array<CameraParameter, 4>& parameters) {
  std::vector<std::string> keys;
  for (const CameraParameter& parameter : parameters) keys.emplace_back(parameter.key);
  return keys;
}

}  // namespace

const std::array<CameraParameter, 4>& camera_parameters() {
  static constexpr std::array<CameraParameter, 4> kParameters{{
      {"k1", "", "radial term of r^2 that rectification left", 0.016, 0.1, 0.006,
       [](const CameraModel& c) { return c.residual_k1; },
       [](CameraModel* c, double v) { c->residual_k1 = v; }},
      {"k2", "", "radial term of r^4 that rectification left", 0.016, 0.1, 0.006,
       [](const CameraModel& c) { return c.residual_k2; },
       [](CameraModel* c, double v) { c->residual_k2 = v; }},
      {"focal", " px", "focal length", 4.0, 40.0, 3.0, [](const CameraModel& c) { return c.fx_px; },
       [](CameraModel* c, double v) {
         c->fy_px *= v / c->fx_px;
         c->fx_px = v;
       }},
      {"row", " px", "principal row", 3.0, 30.0, 2.0, [](const CameraModel& c) { return c.cy_px; },
       [](CameraModel* c, double v) { c->cy_px = v; }},
  }};
  return kParameters;
}

std::vector<const CameraParameter*> parse_parameters(const std::string& names) {
  std::vector<const CameraParameter*> found;
  for (const std::string_view name : split_cells(names)) {
    const auto& all = camera_parameters();
    const auto it = std::find_if(all.begin(), all.end(),
                                 [name](const CameraParameter& p) { return name == p.key; });
    if (it == all.end()) {
      const std::vector<std::string> known = keys_of(all);
      throw InputError("--parameters: '" + std::string(name) + "' is none of " + word_list(known) +
                       did_you_mean(name, known));
    }
    if (std::find(found.begin(), found.end(), &*it) != found.end())
      throw InputError("--parameters: " + std::string(name) + " comes twice");
    found.push_back(&*it);
  }
  return found;
}

}  // namespace plumb
