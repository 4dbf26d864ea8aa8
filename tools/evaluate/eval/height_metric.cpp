#include "tools/evaluate/eval/height_metric.hpp"

#include <algorithm>
#include <cmath>

#include "core/input_error.hpp"
#include "core/numbers.hpp"
#include "tools/support/csv_table.hpp"
#include "tools/support/statistics.hpp"

namespace plumb {
namespace {

constexpr int kReachFrames = 2;

std::optional<double> used_height(const CsvTable& table, std::size_t row, const std::string& cue) {
  if (table.text(row, cue + "_status") != "used") return {};
  return table.number(row, cue + "_height_vo");
}

HeightRow row_of(const CsvTable& table, std::size_t row) {
  HeightRow result;
  const std::optional<double> seq = table.number(row, "seq");
  if (!seq) throw InputError(table.at(row) + "seq is empty");
  result.seq = static_cast<std::int64_t>(*seq);
  result.vo_ok = table.text(row, "vo_status") == "ok";
  result.scale_epoch = static_cast<std::int64_t>(table.number(row, "scale_epoch").value_or(0.0));
  result.step_vo = std::hypot(table.number(row, "vo_t_x").value_or(0.0),
                              table.number(row, "vo_t_y").value_or(0.0),
                              table.number(row, "vo_t_z").value_or(0.0));
  const auto status = table.text(row, "plane_status");
  if (status == "ok" || status == "held") result.log_scale = table.number(row, "log_scale");
  result.dense_vo = used_height(table, row, "dense");
  result.points_vo = used_height(table, row, "points");
  return result;
}

/// True path over VO's path around frame `k`; empty where VO has none. Some images to either side
/// take the jitter out of the truth's single steps.
std::optional<double> metres_per_vo(const std::vector<PoseMatrix>& poses,
                                    const std::vector<HeightRow>& rows, int k) {
  const auto at = static_cast<std::size_t>(k);
  if (!rows[at].vo_ok) return {};
  double path_m = 0.0;
  double path_vo = 0.0;
  const int last = std::min(static_cast<int>(rows.size()) - 1, k + kReachFrames);
  for (int j = std::max(1, k - kReachFrames); j <= last; ++j) {
    const auto near = static_cast<std::size_t>(j);
    if (!rows[near].vo_ok || rows[near].scale_epoch != rows[at].scale_epoch) continue;
    path_vo += rows[near].step_vo;
    path_m += (poses[near] - poses[near - 1]).topRightCorner<3, 1>().norm();
  }
  if (path_vo <= 0.0 || path_m <= 0.0) return {};
  return path_m / path_vo;
}

}  // namespace

std::vector<HeightRow> read_height_rows(const std::filesystem::path& path) {
  const CsvTable table(path);
  table.require({"seq", "vo_status", "scale_epoch", "vo_t_x", "vo_t_y", "vo_t_z", "plane_status",
                 "log_scale", "dense_status", "dense_height_vo", "points_status",
                 "points_height_vo"});
  std::vector<HeightRow> rows;
  for (std::size_t row = 0; row < table.num_rows(); ++row) rows.push_back(row_of(table, row));
  return rows;
}

HeightErrors height_by_true_step(const std::vector<PoseMatrix>& poses,
                                 const std::vector<HeightRow>& rows,
                                 const std::map<std::int64_t, TruePlane>& truth, double height_m) {
  if (poses.size() != rows.size()) {
    throw InputError("the table has " + std::to_string(rows.size()) + " rows, the truth " +
                     std::to_string(poses.size()) + " poses");
  }
  HeightErrors errors{{"fused", {}}, {"dense", {}}, {"points", {}}, {"constant", {}}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const HeightRow& row = rows[k];
    const std::optional<double> ratio = metres_per_vo(poses, rows, static_cast<int>(k));
    if (!ratio) continue;
    const auto plane = truth.find(row.seq);
    const double true_m = plane == truth.end() ? height_m : plane->second.height_m;
    const auto add = [&](const char* name, double estimated_m) {
      errors[name].push_back({row.seq, 100.0 * (estimated_m / true_m - 1.0)});
    };
    if (row.dense_vo) add("dense", *row.dense_vo * *ratio);
    if (row.points_vo) add("points", *row.points_vo * *ratio);
    if (!row.log_scale) continue;
    add("fused", height_m * std::exp(-*row.log_scale) * *ratio);
    add("constant", height_m);
  }
  return errors;
}

HeightSummary summarize_heights(const std::vector<HeightError>& errors) {
  std::vector<double> sizes;
  std::vector<double> signed_errors;
  int within = 0;
  for (const HeightError& error : errors) {
    signed_errors.push_back(error.error_percent);
    sizes.push_back(std::abs(error.error_percent));
    if (sizes.back() <= 7.0) ++within;
  }
  const auto num = static_cast<int>(errors.size());
  return {num, mean(sizes), mean(signed_errors),
          num > 0 ? within / static_cast<double>(num) : kNan};
}

}  // namespace plumb
