/// The models C of Song and Chandraker (CVPR 2014, Algorithm 1): variances of the cues' errors by
/// their confidences.
///
/// Units:
///   Heights and widths in metres; confidences as the cues give them.
#pragma once

#include "modules/ground/covariance/built_in_numbers.hpp"
#include "modules/ground/types/linear_variance.hpp"

namespace plumb {

struct PaperModel {
  LinearVariance dense_n1;
  LinearVariance dense_n3;
  LinearVariance dense_h;   ///< [m^2]
  LinearVariance points_h;  ///< [m^2]
  LinearVariance objects_n3;

  /// Visits the numbers under the names of the model file's sections.
  template <typename Model, typename Visit>
  static void visit(Model& m, Visit&& field) {
    LinearVariance::visit("paper_dense_n1", m.dense_n1, field);
    LinearVariance::visit("paper_dense_n3", m.dense_n3, field);
    LinearVariance::visit("paper_dense_h", m.dense_h, field);
    LinearVariance::visit("paper_points_h", m.points_h, field);
    LinearVariance::visit("paper_objects_n3", m.objects_n3, field);
  }
};

/// The numbers of config/ground_model.toml as they were when the program was built.
[[nodiscard]] inline PaperModel built_in_paper_model() {
  PaperModel model;
  PaperModel::visit(model, [](const char* key, double& value, double, double, const char*) {
    take_built_in_number(key, &value);
  });
  return model;
}

}  // namespace plumb
