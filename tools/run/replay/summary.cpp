#include "tools/run/replay/summary.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "modules/datasets/text.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

std::string line(const char* what, const std::map<int, int>& counts, const char* (*name_of)(int)) {
  std::string text = format("  %-7s", what);
  bool first = true;
  for (const auto& [status, count] : counts) {
    text += format("%s%d %s", first ? "" : ", ", count, name_of(status));
    first = false;
  }
  return text + "\n";
}

std::string stage_row(const char* name, const StageStats& stage) {
  return format("  %-24s%8lld%10.2f%10.2f%10.2f\n", name, static_cast<long long>(stage.num_samples),
                1e-3 * stage.median_us, 1e-3 * stage.p99_us, 1e-3 * stage.max_us);
}

}  // namespace

void StatusCount::add(const FrameRecord& record) {
  if (record.refused != nullptr) ++num_refused_;
  if (record.vo != nullptr) ++vo_[record.vo->status];
  if (record.plane != nullptr) ++plane_[record.plane->status];
  if (record.ego != nullptr) ++ego_[record.ego->status];
}

std::string StatusCount::text() const {
  std::string text = "frames by status\n" + line("vo", vo_, vo_status_name) +
                     line("plane", plane_, plane_status_name) + line("ego", ego_, ego_status_name);
  if (num_refused_ > 0) text += format("  refused %d\n", num_refused_);
  return text;
}

std::string mount_text(const MountReport& report) {
  const auto angles = [](const Eigen::Vector3d& rad) {
    return format("pitch %+.2f, roll %+.2f, yaw %+.2f deg", degrees(rad.x()), degrees(rad.y()),
                  degrees(rad.z()));
  };
  std::string text = format("mount   %s", mount_status_name(static_cast<int>(report.status)));
  if (report.reference) text += ", reference " + angles(report.reference->mean_rad);
  if (!report.reference) text += format(", %.0f %% of a reference", 100.0 * report.progress);
  if (report.recent_rad.allFinite()) text += "; now " + angles(report.recent_rad);
  return text + "\n";
}

std::string height_text(const HeightReport& report) {
  if (report.num_stretches == 0) return "";
  std::string text =
      format("height  %s, %d stretches", height_status_name(static_cast<int>(report.status)),
             report.num_stretches);
  if (std::isfinite(report.by_vehicle.height_m)) {
    text += format("; by the vehicle's speed %.4f +- %.4f m, used %.4f +- %.4f m",
                   report.by_vehicle.height_m, report.by_vehicle.std_m, report.used.height_m,
                   report.used.std_m);
  }
  return text + "\n";
}

std::string stage_table(const std::string& program, const StageTimer& timer) {
  std::string text = format("%-26s%8s%10s%10s%10s\n", (program + " stages [ms]").c_str(), "frames",
                            "median", "p99", "max");
  for (std::size_t i = 0; i < timer.num_stages(); ++i) {
    const StageStats stage = timer.stats(i);
    text += stage_row(stage.name, stage);
  }
  return text;
}

}  // namespace plumb
