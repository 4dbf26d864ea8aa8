/// Words for the status and reason numbers of the messages, from the constants of the .lcm files;
/// "?" for a number that has no word.
#pragma once

namespace plumb {

[[nodiscard]] const char* vo_status_name(int status);
[[nodiscard]] const char* vo_reason_name(int reason);
[[nodiscard]] const char* feature_kind_name(int kind);
[[nodiscard]] const char* plane_status_name(int status);
[[nodiscard]] const char* plane_reason_name(int reason);
[[nodiscard]] const char* cue_status_name(int status);
[[nodiscard]] const char* ego_status_name(int status);
[[nodiscard]] const char* mount_status_name(int status);
[[nodiscard]] const char* mount_reason_name(int reason);
[[nodiscard]] const char* height_status_name(int status);
[[nodiscard]] const char* object_class_name(int number);
[[nodiscard]] const char* object_status_name(int status);
[[nodiscard]] const char* object_reason_name(int reason);

}  // namespace plumb
