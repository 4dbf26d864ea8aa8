#include "tools/run/export/foxglove_types.hpp"

#include <glib.h>

#include <initializer_list>
#include <memory>
#include <utility>

namespace plumb::foxglove {
namespace {

using Field = std::pair<const char*, Json>;

/// A schema of an object all of whose fields are required.
Json object_schema(std::initializer_list<Field> fields, const char* title = nullptr) {
  Json schema = {{"type", "object"}, {"properties", Json::object()}, {"required", Json::array()}};
  if (title != nullptr) schema["title"] = title;
  for (const auto& [name, field] : fields) {
    schema["properties"][name] = field;
    schema["required"].push_back(name);
  }
  return schema;
}

Json named(const char* name, std::initializer_list<Field> fields) {
  Json schema = object_schema(fields, name);
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  return schema;
}

Json string_schema() { return {{"type", "string"}}; }
Json number_schema() { return {{"type", "number"}}; }
Json boolean_schema() { return {{"type", "boolean"}}; }
Json integer_schema() { return {{"type", "integer"}}; }
Json list_schema(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }
Json numbers_schema(int count) {
  Json schema = list_schema(number_schema());
  schema["minItems"] = schema["maxItems"] = count;
  return schema;
}
Json time_schema() {
  return object_schema({{"sec", integer_schema()}, {"nsec", integer_schema()}}, "time");
}
Json duration_schema() {
  return object_schema({{"sec", integer_schema()}, {"nsec", integer_schema()}}, "duration");
}
Json vector3_schema() {
  return object_schema({{"x", number_schema()}, {"y", number_schema()}, {"z", number_schema()}},
                       "foxglove.Vector3");
}
Json quaternion_schema() {
  return object_schema({{"x", number_schema()},
                        {"y", number_schema()},
                        {"z", number_schema()},
                        {"w", number_schema()}},
                       "foxglove.Quaternion");
}
Json pose_schema() {
  return object_schema({{"position", vector3_schema()}, {"orientation", quaternion_schema()}},
                       "foxglove.Pose");
}
Json colour_schema() {
  return object_schema({{"r", number_schema()},
                        {"g", number_schema()},
                        {"b", number_schema()},
                        {"a", number_schema()}},
                       "foxglove.Color");
}

Json entity_schema() {
  const Json lines = object_schema({{"type", integer_schema()},
                                    {"pose", pose_schema()},
                                    {"thickness", number_schema()},
                                    {"scale_invariant", boolean_schema()},
                                    {"points", list_schema(vector3_schema())},
                                    {"color", colour_schema()},
                                    {"colors", list_schema(colour_schema())},
                                    {"indices", list_schema(integer_schema())}});
  const Json cubes = object_schema(
      {{"pose", pose_schema()}, {"size", vector3_schema()}, {"color", colour_schema()}});
  const Json texts = object_schema({{"pose", pose_schema()},
                                    {"billboard", boolean_schema()},
                                    {"font_size", number_schema()},
                                    {"scale_invariant", boolean_schema()},
                                    {"color", colour_schema()},
                                    {"text", string_schema()}});
  const Json pair = object_schema({{"key", string_schema()}, {"value", string_schema()}});
  // The primitives that are never used have the empty list as their only value.
  const Json none = list_schema(object_schema({}));
  return object_schema({{"timestamp", time_schema()},
                        {"frame_id", string_schema()},
                        {"id", string_schema()},
                        {"lifetime", duration_schema()},
                        {"frame_locked", boolean_schema()},
                        {"metadata", list_schema(pair)},
                        {"arrows", none},
                        {"cubes", list_schema(cubes)},
                        {"spheres", none},
                        {"cylinders", none},
                        {"lines", list_schema(lines)},
                        {"triangles", none},
                        {"texts", list_schema(texts)},
                        {"models", none}});
}

}  // namespace

Json compressed_image_schema() {
  return named("foxglove.CompressedImage",
               {{"timestamp", time_schema()},
                {"frame_id", string_schema()},
                {"data", {{"type", "string"}, {"contentEncoding", "base64"}}},
                {"format", string_schema()}});
}

Json camera_calibration_schema() {
  return named("foxglove.CameraCalibration", {{"timestamp", time_schema()},
                                              {"frame_id", string_schema()},
                                              {"width", integer_schema()},
                                              {"height", integer_schema()},
                                              {"distortion_model", string_schema()},
                                              {"D", list_schema(number_schema())},
                                              {"K", numbers_schema(9)},
                                              {"R", numbers_schema(9)},
                                              {"P", numbers_schema(12)}});
}

Json frame_transforms_schema() {
  const Json transform = object_schema({{"timestamp", time_schema()},
                                        {"parent_frame_id", string_schema()},
                                        {"child_frame_id", string_schema()},
                                        {"translation", vector3_schema()},
                                        {"rotation", quaternion_schema()}});
  return named("foxglove.FrameTransforms", {{"transforms", list_schema(transform)}});
}

Json poses_in_frame_schema() {
  return named("foxglove.PosesInFrame", {{"timestamp", time_schema()},
                                         {"frame_id", string_schema()},
                                         {"poses", list_schema(pose_schema())}});
}

Json pose_in_frame_schema() {
  return named(
      "foxglove.PoseInFrame",
      {{"timestamp", time_schema()}, {"frame_id", string_schema()}, {"pose", pose_schema()}});
}

Json scene_update_schema() {
  const Json deletion = object_schema(
      {{"timestamp", time_schema()}, {"type", integer_schema()}, {"id", string_schema()}});
  return named("foxglove.SceneUpdate",
               {{"deletions", list_schema(deletion)}, {"entities", list_schema(entity_schema())}});
}

Json log_schema() {
  return named("foxglove.Log", {{"timestamp", time_schema()},
                                {"level", integer_schema()},
                                {"message", string_schema()},
                                {"name", string_schema()},
                                {"file", string_schema()},
                                {"line", integer_schema()}});
}

Json time(std::int64_t time_us) {
  return {{"sec", time_us / 1'000'000}, {"nsec", 1000 * (time_us % 1'000'000)}};
}

Json vector3(const Eigen::Vector3d& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }

Json quaternion(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

Json pose(const Se3& T_frame_pose) {
  return {{"position", vector3(T_frame_pose.t)}, {"orientation", quaternion(T_frame_pose.R)}};
}

Json colour(const Colour& colour) {
  return {{"r", colour.r}, {"g", colour.g}, {"b", colour.b}, {"a", colour.a}};
}

Json scene_entity(std::int64_t time_us, const char* frame, const std::string& id) {
  Json entity = {{"timestamp", time(time_us)},
                 {"frame_id", frame},
                 {"id", id},
                 {"lifetime", time(0)},
                 {"frame_locked", true}};
  for (const char* list : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                           "triangles", "texts", "models"})
    entity[list] = Json::array();
  return entity;
}

Json line_list(const std::vector<Eigen::Vector3d>& points, const Colour& line_colour) {
  constexpr int kLineList = 2;
  Json list = {{"type", kLineList},       {"pose", pose({})},        {"thickness", 1.5},
               {"scale_invariant", true}, {"points", Json::array()}, {"color", colour(line_colour)},
               {"colors", Json::array()}, {"indices", Json::array()}};
  for (const Eigen::Vector3d& point : points) list["points"].push_back(vector3(point));
  return list;
}

Json cube(const Se3& T_frame_centre, const Eigen::Vector3d& size_m, const Colour& cube_colour) {
  return {
      {"pose", pose(T_frame_centre)}, {"size", vector3(size_m)}, {"color", colour(cube_colour)}};
}

Json text(const Eigen::Vector3d& place_m, const std::string& words, const Colour& text_colour) {
  return {{"pose", pose({Eigen::Matrix3d::Identity(), place_m})},
          {"billboard", true},
          {"font_size", 12.0},
          {"scale_invariant", true},
          {"color", colour(text_colour)},
          {"text", words}};
}

Json scene(std::int64_t time_us, Json entities) {
  constexpr int kDeleteAll = 1;
  const Json deletion = {{"timestamp", time(time_us)}, {"type", kDeleteAll}, {"id", ""}};
  return {{"deletions", Json::array({deletion})}, {"entities", std::move(entities)}};
}

std::string base64(std::span<const std::uint8_t> bytes) {
  const std::unique_ptr<gchar, decltype(&g_free)> text(g_base64_encode(bytes.data(), bytes.size()),
                                                       &g_free);
  return text.get();
}

}  // namespace plumb::foxglove
