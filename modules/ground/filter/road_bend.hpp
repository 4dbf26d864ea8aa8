/// How roads bend upwards and downwards: the plane ahead against the one under the car.
///
/// The cues see the road 5 to 20 m ahead, scale wants the one that the car stands on. On a road of constant vertical
/// curvature both the angle between them and the change of the plane's height over the camera are proportional to it.
///
/// Units  sines of angles, camera heights of way, ln h.
#pragma once

namespace plumb {

struct RoadBend {
  double start_std =
      0.0;  ///< of n3 ahead against n3 here, until the drive tells; 0: roads are flat
  double memory_ratio = 1.0;  ///< way over which a bend stays alike
  double height_slope = 0.0;  ///< d(ln h ahead) / d(bend)
};

}  // namespace plumb
