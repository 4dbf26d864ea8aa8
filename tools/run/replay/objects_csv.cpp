#include "tools/run/replay/objects_csv.hpp"

#include "tools/run/replay/csv_row.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

std::string row_of(const objects_t& objects, const object_t& object, bool names_only) {
  CsvRow row(names_only);
  const bool holds = object.status != object_t::STATUS_NOT_LOCALISED;
  row.add("seq", objects.seq);
  row.add("utime", objects.utime);
  row.add("track_id", static_cast<std::int64_t>(object.track_id));
  row.add("class", object_class_name(object.class_id));
  row.add("status", object_status_name(object.status));
  row.add("reason", object_reason_name(object.reason));
  row.add("age_s", object.age_s);
  const char* axes[] = {"x", "y"};
  for (int i = 0; i < 2; ++i) {
    const std::string axis = axes[i];
    row.add(axis + "_m", object.position_ground_m[i], holds);
    row.add(axis + "_std_m", deviation(object.position_cov_m2[i][i]), holds);
    row.add("v" + axis + "_m_s", object.velocity_ground_m_s[i], holds);
    row.add("v" + axis + "_std_m_s", deviation(object.velocity_cov_m2_s2[i][i]), holds);
  }
  row.add("xy_cov_m2", object.position_cov_m2[0][1], holds);
  row.add("yaw_rad", object.yaw_rad, holds);
  row.add("yaw_std_rad", object.yaw_std_rad, holds);
  const char* sizes[] = {"length", "width", "height"};
  for (int i = 0; i < 3; ++i) {
    row.add(std::string(sizes[i]) + "_m", object.size_m[i], holds);
    row.add(std::string(sizes[i]) + "_std_m", object.size_std_m[i], holds);
  }
  row.add("time_to_collision_s", object.time_to_collision_s, holds);
  return row.text();
}

}  // namespace

std::string objects_csv_header() { return row_of({}, {}, true); }

std::string objects_csv_row(const objects_t& objects, const object_t& object) {
  return row_of(objects, object, false);
}

}  // namespace plumb
