#include "modules/ground_paper/paper_cues.hpp"

#include <algorithm>
#include <cmath>

namespace plumb {

CueReport report_of(const PaperDenseMeasurement& dense, const PaperVariances& variances,
                    double metres_per_vo) {
  CueReport report;
  report.status = dense.ok ? CueStatus::kUsed : CueStatus::kFailed;
  if (!dense.ok) return report;
  const PaperModel& model = variances.model;
  report.n1 = dense.z(kN1);
  report.n3 = dense.z(kN3);
  report.height = dense.z(kH) / metres_per_vo;
  report.n1_var = variances.of(model.dense_n1, dense.width(kN1));
  report.n3_var = variances.of(model.dense_n3, dense.width(kN3));
  const double height_var = variances.of(model.dense_h, dense.width(kH));
  report.height_var = height_var / (metres_per_vo * metres_per_vo);
  report.quality = std::min(1.0, model.dense_h.least / height_var);
  report.features = {dense.width(kH), dense.width(kN1), dense.width(kN3)};
  report.num_features = 3;
  return report;
}

CueReport report_of(const PaperPointsMeasurement& points, const PaperVariances& variances,
                    double metres_per_vo) {
  CueReport report;
  if (points.num_matches == 0) return report;
  report.status = points.ok ? CueStatus::kUsed : CueStatus::kFailed;
  if (!points.ok) return report;
  const LinearVariance& line = variances.model.points_h;
  const double height_var = variances.of(line, points.score);
  report.height = points.height / metres_per_vo;
  report.height_var = height_var / (metres_per_vo * metres_per_vo);
  report.quality = std::min(1.0, line.least / height_var);
  report.features = {points.score};
  report.num_features = 1;
  return report;
}

CueReport add_objects(const PaperObjects& objects, const Eigen::Matrix3d& R_newest_due,
                      const PaperVariances& variances, CueFusion* fused) {
  CueReport report;
  const LinearVariance& line = variances.model.objects_n3;
  CueFusion together;
  for (const PaperObject& object : objects) {
    const Eigen::Vector3d normal = {0.0, std::sqrt(1.0 - object.n3 * object.n3), object.n3};
    const double n3 = (R_newest_due * normal).z();
    const double var = std::isfinite(object.confidence_px2)
                           ? variances.of(line, object.confidence_px2)
                           : line.mean;
    together.add(kN3, n3, var);
    fused->add(kN3, n3, var);
  }
  if (!together.observes(kN3)) return report;
  report.status = CueStatus::kUsed;
  report.n3 = together.value(kN3);
  report.n3_var = together.var(kN3);
  report.quality = std::min(1.0, line.least / report.n3_var);
  return report;
}

void add_report(const CueReport& report, double metres_per_vo, CueFusion* fused) {
  if (report.status != CueStatus::kUsed) return;
  if (std::isfinite(report.n1)) fused->add(kN1, report.n1, report.n1_var);
  if (std::isfinite(report.n3)) fused->add(kN3, report.n3, report.n3_var);
  fused->add(kH, metres_per_vo * report.height, metres_per_vo * metres_per_vo * report.height_var);
}

}  // namespace plumb
