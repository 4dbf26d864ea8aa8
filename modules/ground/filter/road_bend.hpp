/// Statistics of how roads bend upwards and downwards: the plane ahead against the one under the
/// car.
///
/// The cues see the road 5 to 20 m ahead, but the scale depends on the road under the car. On a
/// road of constant vertical curvature, the angle between the two planes and the difference of
/// their heights under the camera are both proportional to that curvature.
///
/// Units:
///   Sines of angles; distance travelled in camera heights; ln h.
#pragma once

namespace plumb {

struct RoadBend {
  /// 1-sigma of n3 ahead minus n3 under the car, until the drive shows its own; 0: flat roads.
  double start_std = 0.0;
  /// Distance travelled over which a bend stays correlated (first-order Gauss-Markov).
  double correlation_length_ratio = 1.0;
  double height_slope = 0.0;  ///< d(ln h ahead) / d(bend)
};

}  // namespace plumb
