#include "modules/ground/covariance/height_measurement.hpp"

namespace plumb {

double height_given_normal(const DenseMeasurement& dense, const Eigen::Vector3d& n) {
  return n.dot(dense.information * n) / n.dot(dense.information * dense.q);
}

void HeightMean::add(const HeightMeasurement& height) {
  information_ += 1.0 / height.var;
  sum_.ln_height += height.ln_height / height.var;
  sum_.slope += height.slope / height.var;
}

HeightMeasurement HeightMean::mean() const {
  return {sum_.ln_height / information_, 1.0 / information_, sum_.slope / information_};
}

}  // namespace plumb
