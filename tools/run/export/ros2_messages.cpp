#include "tools/run/export/ros2_messages.hpp"

#include <initializer_list>

#include "tools/run/export/cdr_writer.hpp"

namespace plumb::ros2 {
namespace {

/// Definitions of the types that others contain.
struct Part {
  const char* name;
  const char* fields;
};
constexpr Part kTime{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"};
constexpr Part kHeaderPart{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"};
constexpr Part kPoint{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Part kVector3{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Part kQuaternion{"geometry_msgs/Quaternion",
                           "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"};
constexpr Part kPose{"geometry_msgs/Pose",
                     "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"};
constexpr Part kPoseWithCovariance{"geometry_msgs/PoseWithCovariance",
                                   "geometry_msgs/Pose pose\nfloat64[36] covariance\n"};
constexpr Part kTwist{"geometry_msgs/Twist",
                      "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"};
constexpr Part kTwistWithCovariance{"geometry_msgs/TwistWithCovariance",
                                    "geometry_msgs/Twist twist\nfloat64[36] covariance\n"};
constexpr Part kTransformPart{
    "geometry_msgs/Transform",
    "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"};
constexpr Part kTransformStamped{
    "geometry_msgs/TransformStamped",
    "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"};
constexpr Part kRegion{"sensor_msgs/RegionOfInterest",
                       "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\n"
                       "bool do_rectify\n"};
constexpr Part kKeyValue{"diagnostic_msgs/KeyValue", "string key\nstring value\n"};
constexpr Part kDiagnosticStatus{"diagnostic_msgs/DiagnosticStatus",
                                 "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\n"
                                 "byte level\nstring name\nstring message\nstring hardware_id\n"
                                 "diagnostic_msgs/KeyValue[] values\n"};

std::string definition(const char* fields, std::initializer_list<Part> parts) {
  std::string text = fields;
  for (const Part& part : parts) {
    text += std::string(80, '=') + "\nMSG: " + part.name + "\n" + part.fields;
  }
  return text;
}

void put_header(std::int64_t time_us, const char* frame, CdrWriter* out) {
  out->i32(static_cast<std::int32_t>(time_us / 1'000'000));
  out->u32(static_cast<std::uint32_t>(1000 * (time_us % 1'000'000)));
  out->text(frame);
}

void put_vector(const Eigen::Vector3d& v, CdrWriter* out) {
  for (int i = 0; i < 3; ++i) out->f64(v[i]);
}

/// Position, then rotation.
void put_pose(const Se3& pose, CdrWriter* out) {
  put_vector(pose.t, out);
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.R).normalized();
  for (const double value : {q.x(), q.y(), q.z(), q.w()}) out->f64(value);
}

void put_covariance(const Matrix6d& covariance, CdrWriter* out) {
  for (int row = 0; row < 6; ++row)
    for (int col = 0; col < 6; ++col) out->f64(covariance(row, col));
}

}  // namespace

Type odometry_type() {
  return {"nav_msgs/msg/Odometry",
          definition("std_msgs/Header header\nstring child_frame_id\n"
                     "geometry_msgs/PoseWithCovariance pose\n"
                     "geometry_msgs/TwistWithCovariance twist\n",
                     {kHeaderPart, kTime, kPoseWithCovariance, kPose, kPoint, kQuaternion,
                      kTwistWithCovariance, kTwist, kVector3})};
}

Type compressed_image_type() {
  return {
      "sensor_msgs/msg/CompressedImage",
      definition("std_msgs/Header header\nstring format\nuint8[] data\n", {kHeaderPart, kTime})};
}

Type camera_info_type() {
  return {"sensor_msgs/msg/CameraInfo",
          definition("std_msgs/Header header\nuint32 height\nuint32 width\n"
                     "string distortion_model\nfloat64[] d\nfloat64[9] k\nfloat64[9] r\n"
                     "float64[12] p\nuint32 binning_x\nuint32 binning_y\n"
                     "sensor_msgs/RegionOfInterest roi\n",
                     {kHeaderPart, kTime, kRegion})};
}

Type tf_message_type() {
  return {"tf2_msgs/msg/TFMessage", definition("geometry_msgs/TransformStamped[] transforms\n",
                                               {kTransformStamped, kHeaderPart, kTime,
                                                kTransformPart, kVector3, kQuaternion})};
}

Type diagnostic_array_type() {
  return {"diagnostic_msgs/msg/DiagnosticArray",
          definition("std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
                     {kHeaderPart, kTime, kDiagnosticStatus, kKeyValue})};
}

Bytes odometry(std::int64_t time_us, const Se3& pose, const Matrix6d& covariance,
               const VehicleTwist* twist) {
  static const VehicleTwist kUnknown{Vector6d::Zero(), kUnknownVariance * Matrix6d::Identity()};
  const VehicleTwist& shown = twist != nullptr ? *twist : kUnknown;
  CdrWriter out;
  put_header(time_us, "odom", &out);
  out.text("base_link");
  put_pose(pose, &out);
  put_covariance(covariance, &out);
  put_vector(shown.mean.head<3>(), &out);
  put_vector(shown.mean.tail<3>(), &out);
  put_covariance(shown.covariance, &out);
  return out.bytes();
}

Bytes compressed_image(std::int64_t time_us, std::span<const std::uint8_t> jpeg) {
  CdrWriter out;
  put_header(time_us, "camera", &out);
  out.text("jpeg");
  out.blob(jpeg);
  return out.bytes();
}

Bytes camera_info(std::int64_t time_us, const CameraModel& camera) {
  const double fx = camera.fx_px, fy = camera.fy_px, cx = camera.cx_px, cy = camera.cy_px;
  CdrWriter out;
  put_header(time_us, "camera", &out);
  out.u32(static_cast<std::uint32_t>(camera.height_px));
  out.u32(static_cast<std::uint32_t>(camera.width_px));
  out.text("plumb_bob");
  out.u32(5);
  for (const double d : {camera.residual_k1, camera.residual_k2, 0.0, 0.0, 0.0}) out.f64(d);
  for (const double k : {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}) out.f64(k);
  for (const double r : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) out.f64(r);
  for (const double p : {fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}) out.f64(p);
  for (int i = 0; i < 2 + 4; ++i) out.u32(0);  // no binning; the region is the whole image
  out.u8(0);
  return out.bytes();
}

Bytes tf_message(std::int64_t time_us, const std::vector<Transform>& transforms) {
  CdrWriter out;
  out.u32(static_cast<std::uint32_t>(transforms.size()));
  for (const Transform& transform : transforms) {
    put_header(time_us, transform.parent, &out);
    out.text(transform.child);
    put_pose(transform.T_parent_child, &out);
  }
  return out.bytes();
}

Bytes diagnostic_array(std::int64_t time_us, const std::vector<Diagnosis>& all) {
  CdrWriter out;
  put_header(time_us, "", &out);
  out.u32(static_cast<std::uint32_t>(all.size()));
  for (const Diagnosis& diagnosis : all) {
    out.u8(diagnosis.level);
    out.text(diagnosis.name);
    out.text(diagnosis.message);
    out.text("camera");  // hardware_id
    out.u32(static_cast<std::uint32_t>(diagnosis.values.size()));
    for (const auto& [key, value] : diagnosis.values) {
      out.text(key);
      out.text(value);
    }
  }
  return out.bytes();
}

}  // namespace plumb::ros2
