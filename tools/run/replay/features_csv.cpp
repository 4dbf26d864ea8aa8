#include "tools/run/replay/features_csv.hpp"

#include "tools/run/replay/csv_row.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

std::string feature_row_of(const vo_motion_t& vo, int index, bool names_only) {
  CsvRow row(names_only);
  row.add("seq", vo.seq);
  row.add("utime", vo.utime);
  row.add("u_px", static_cast<double>(vo.features_px[index][0]));
  row.add("v_px", static_cast<double>(vo.features_px[index][1]));
  row.add("kind", feature_kind_name(vo.features_kind[index]));
  return row.text();
}

}  // namespace

std::string features_csv_header() { return feature_row_of({}, 0, true); }

std::string features_csv_row(const vo_motion_t& vo, int index) {
  return feature_row_of(vo, index, false);
}

}  // namespace plumb
