/// Compares the cues and the reported values with one frame's truth.
///
/// Frames:
///   cam of the newest image.
/// Units:
///   [vo] for the cues, metres for what is reported.
#pragma once

#include <Eigen/Core>

#include "core/se3.hpp"
#include "modules/datasets/kitti/plane_file.hpp"
#include "modules/ground/cues/cue_diagnostics.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/ground_plane_t.hpp"
#include "tools/learn/train/sample.hpp"

namespace plumb {

/// What the cues are compared with.
struct CueReference {
  double ln_height = 0.0;  ///< true, [vo]
  const TruePlane* plane = nullptr;
  Eigen::Vector3d normal_cam = Eigen::Vector3d::UnitY();  ///< the true one, else the filter's
  Eigen::Matrix2d normal_cov = Eigen::Matrix2d::Zero();   ///< of (n1, n3); zero for the true one
};

void write_dense(const CueDiagnostics& diagnostics, const CueReference& reference, Sample* sample);
void write_points(const CueDiagnostics& diagnostics, const CueReference& reference, Sample* sample);
void write_chord(const CueDiagnostics& diagnostics, const CueReference& reference, Sample* sample);
/// Writes what every cue of kCueTable reported.
void write_cues(const CueReports& reports, Sample* sample);
/// Writes nothing without a true plane.
void write_objects(const CueReport& objects, const TruePlane* truth, Sample* sample);

/// Writes the published method's cues. `truth` may be null.
void write_paper(const PlaneOutput& plane, double metres_per_vo, double true_height_m,
                 const TruePlane* truth, Sample* sample);

/// Writes height, pitch and roll. @pre plane has a true plane beside it
void write_plane_output(const ground_plane_t& plane, const TruePlane& truth, Sample* sample);
/// Writes length, translation and rotation of the frame's motion.
void write_motion_output(const ego_motion_t& ego, const Se3& T_prev_cam_true, Sample* sample);

}  // namespace plumb
