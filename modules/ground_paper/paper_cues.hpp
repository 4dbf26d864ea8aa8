/// What the published method's cues say about one frame: as reports, and as the observations that
/// its fusion (5) takes.
///
/// Units:
///   Reports in [vo], the fusion in metres.
#pragma once

#include "modules/ground/types/ground_types.hpp"
#include "modules/ground_paper/cue_fusion.hpp"
#include "modules/ground_paper/paper_dense_cue.hpp"
#include "modules/ground_paper/paper_model.hpp"
#include "modules/ground_paper/paper_objects_cue.hpp"
#include "modules/ground_paper/paper_points_cue.hpp"

namespace plumb {

/// Which variance a line gives: that of the confidence, or the mean one for all frames.
struct PaperVariances {
  PaperModel model;
  bool fixed = false;

  [[nodiscard]] double of(const LinearVariance& line, double confidence) const {
    return fixed ? line.mean : line.of(confidence);
  }
};

[[nodiscard]] CueReport report_of(const PaperDenseMeasurement& dense,
                                  const PaperVariances& variances, double metres_per_vo);
[[nodiscard]] CueReport report_of(const PaperPointsMeasurement& points,
                                  const PaperVariances& variances, double metres_per_vo);

/// Adds every object to `fused` as an observation of n3 of its own, brought to the newest image by
/// `R_newest_due`, and reports all of them as one. An object without a_d has the mean variance.
[[nodiscard]] CueReport add_objects(const PaperObjects& objects,
                                    const Eigen::Matrix3d& R_newest_due,
                                    const PaperVariances& variances, CueFusion* fused);

/// Adds a used cue's components to `fused`; another cue adds nothing.
void add_report(const CueReport& report, double metres_per_vo, CueFusion* fused);

}  // namespace plumb
