/// Models C of the paper: how far a cue's error scatters, by the belief in it.
///
/// Units  heights and widths in metres, beliefs as the cues give them.
#pragma once

#include "modules/ground/types/linear_variance.hpp"

namespace plumb {

struct PaperModel {
  LinearVariance dense_n1;
  LinearVariance dense_n3;
  LinearVariance dense_h;   ///< [m^2]
  LinearVariance points_h;  ///< [m^2]
};

}  // namespace plumb
