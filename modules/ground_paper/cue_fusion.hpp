/// The fusion of the paper, equation (5): U = (sum U_i^-1)^-1 and z = U sum U_i^-1 z_i, in
/// information form.
///
/// The paper takes the components of a cue as uncorrelated, so that every U_i is diagonal. A
/// component that a cue does not observe adds no information.
#pragma once

#include <Eigen/Core>

#include "modules/ground_paper/plane_vector.hpp"

namespace plumb {

class CueFusion {
 public:
  /// @pre var > 0
  void add(PlaneComponent component, double value, double var) {
    information_(component) += 1.0 / var;
    weighted_(component) += value / var;
  }

  [[nodiscard]] bool observes(PlaneComponent component) const {
    return information_(component) > 0.0;
  }
  /// @pre observes(component), like var()
  [[nodiscard]] double value(PlaneComponent component) const {
    return weighted_(component) / information_(component);
  }
  [[nodiscard]] double var(PlaneComponent component) const { return 1.0 / information_(component); }

 private:
  Eigen::Vector3d information_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d weighted_ = Eigen::Vector3d::Zero();
};

}  // namespace plumb
