/// plumb-objects: CAMERA_CALIBRATION, GROUND_PLANE, EGO_MOTION, DETECTIONS -> OBJECTS
#include <optional>

#include "modules/camera/front_end.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/objects/objects_node.hpp"
#include "platform/clock.hpp"
#include "platform/process.hpp"

namespace {

constexpr std::size_t kMaxBytes =
    sizeof(plumb::objects_t) + plumb::kMaxObjects * sizeof(plumb::object_t);

class ObjectsProcess {
 public:
  ObjectsProcess(plumb::Process& process, const plumb::PlumbConfig& config)
      : process_(process),
        node_(config.detections, config.objects, config.ground,
              [this](const plumb::objects_t& objects) { publish(objects); }),
        objects_(process.bus(), plumb::kObjects, kMaxBytes),
        calibration_(process.bus(), plumb::kCameraCalibration, plumb::Input::kOccasional,
                     [this](const plumb::camera_calibration_t& m) { return on_calibration(m); }),
        plane_(
            process.bus(), plumb::kGroundPlane, plumb::Input::kPeriodic,
            [this](const plumb::ground_plane_t& m) { return counted(timed_node().take_plane(m)); }),
        ego_(process.bus(), plumb::kEgoMotion, plumb::Input::kPeriodic,
             [this](const plumb::ego_motion_t& m) { return counted(timed_node().take_ego(m)); }),
        detections_(process.bus(), plumb::kDetections, plumb::Input::kPeriodic,
                    [this](const plumb::detections_t& m) { return on_detections(m); }),
        plane_timeout_(process.loop().timer([this] { on_timeout(); })) {
    if (const auto camera = plumb::stated_model(config.camera)) {
      node_.configure_camera(*camera);
    } else {
      process.health().set_condition(plumb::HealthState::kWaiting, "no CAMERA_CALIBRATION yet");
    }
  }

 private:
  const char* on_calibration(const plumb::camera_calibration_t& message) {
    const char* refused = node_.take_calibration(message);
    if (node_.calibrated()) process_.health().clear_condition();
    return refused;
  }

  const char* on_detections(const plumb::detections_t& message) {
    const char* refused = timed_node().take_detections(message);
    count();
    if (node_.waiting()) {
      process_.loop().arm_at(plane_timeout_, plumb::monotonic_us() + plumb::kGroundPlane.stale_us);
    }
    return refused;
  }

  const char* counted(const char* refused) {
    count();
    return refused;
  }

  void on_timeout() {
    node_.expire();
    count();
  }

  void count() {
    process_.counters().num_dropped = node_.num_lost();
    process_.counters().num_unpaired = node_.num_unpaired();
  }

  /// Any of three messages may complete an image, so each one starts the stage timer.
  plumb::ObjectsNode& timed_node() {
    process_.timer().begin();
    return node_;
  }

  void publish(const plumb::objects_t& objects) {
    process_.timer().mark("objects");
    objects_.publish(objects);
    process_.timer().end();
  }

  plumb::Process& process_;
  plumb::ObjectsNode node_;
  plumb::Publisher<plumb::objects_t> objects_;
  plumb::Subscriber<plumb::camera_calibration_t> calibration_;
  plumb::Subscriber<plumb::ground_plane_t> plane_;
  plumb::Subscriber<plumb::ego_motion_t> ego_;
  plumb::Subscriber<plumb::detections_t> detections_;
  plumb::EventLoop::TimerId plane_timeout_;
};

}  // namespace

int main(int argc, char** argv) {
  plumb::Process process({"objects",
                          "Objects on the road in 3D: DETECTIONS, GROUND_PLANE, EGO_MOTION -> "
                          "OBJECTS",
                          plumb::kHealthObjects});
  plumb::PlumbConfig config;
  std::optional<ObjectsProcess> objects;
  return process.run(argc, argv, &config, [&] { objects.emplace(process, config); });
}
