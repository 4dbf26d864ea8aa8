#include "tools/run/replay/names.hpp"

#include <array>
#include <cstddef>

#include "plumb/status_names.hpp"

namespace plumb {
namespace {

template <std::size_t kSize>
const char* name_in(const std::array<const char*, kSize>& names, int number) {
  return number >= 0 && static_cast<std::size_t>(number) < kSize
             ? names[static_cast<std::size_t>(number)]
             : "?";
}

}  // namespace

const char* vo_status_name(int status) { return name_in(kVoMotionStatusNames, status); }
const char* vo_reason_name(int reason) { return name_in(kVoMotionReasonNames, reason); }
const char* feature_kind_name(int kind) { return name_in(kVoMotionFeatureNames, kind); }
const char* plane_status_name(int status) { return name_in(kGroundPlaneStatusNames, status); }
const char* plane_reason_name(int reason) { return name_in(kGroundPlaneReasonNames, reason); }
const char* cue_status_name(int status) { return name_in(kGroundCueStatusNames, status); }
const char* ego_status_name(int status) { return name_in(kEgoMotionStatusNames, status); }
const char* height_status_name(int status) { return name_in(kMountHeightNames, status); }
const char* mount_status_name(int status) { return name_in(kMountStatusNames, status); }
const char* mount_reason_name(int reason) { return name_in(kMountReasonNames, reason); }
const char* object_class_name(int number) { return name_in(kDetectionClassNames, number); }
const char* object_status_name(int status) { return name_in(kObjectStatusNames, status); }
const char* object_reason_name(int reason) { return name_in(kObjectReasonNames, reason); }

}  // namespace plumb
