/// The settings of all processes. One file serves them all,
/// and a key that no module owns is an error.
#pragma once

#include <string>

#include "modules/camera/camera_config.hpp"
#include "modules/camera/image_queue_config.hpp"
#include "modules/can/can_config.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/detector/detector_config.hpp"
#include "modules/ground/types/ground_config.hpp"
#include "modules/ground_paper/paper_config.hpp"
#include "modules/integrity/integrity_config.hpp"
#include "modules/integrity/plausibility_config.hpp"
#include "modules/mount/mount_config.hpp"
#include "modules/objects/objects_config.hpp"
#include "modules/vehicle/vehicle_speed_config.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb {

struct PlumbConfig {
  CameraConfig camera;
  IntegrityConfig integrity;
  ImageQueueConfig images;
  VoConfig vo;
  DetectorConfig detect;
  DetectionsConfig detections;
  std::string ground_mode = "default";
  GroundConfig ground;
  PaperConfig ground_paper;
  MountConfig mount;
  ObjectsConfig objects;
  PlausibilityConfig vehicle;
  VehicleSpeedConfig vehicle_speed;
  CanConfig can;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    CameraConfig::visit(c.camera, field);
    IntegrityConfig::visit(c.integrity, field);
    ImageQueueConfig::visit(c.images, field);
    VoConfig::visit(c.vo, field);
    DetectorConfig::visit(c.detect, field);
    DetectionsConfig::visit(c.detections, field);
    field("ground.mode", c.ground_mode, {"default", "paper"},
          "algorithm: ours, or in plumb-replay that of Song and Chandraker (CVPR 2014)");
    GroundConfig::visit(c.ground, field);
    PaperConfig::visit(c.ground_paper, field);
    MountConfig::visit(c.mount, field);
    ObjectsConfig::visit(c.objects, field);
    PlausibilityConfig::visit(c.vehicle, field);
    VehicleSpeedConfig::visit(c.vehicle_speed, field);
    CanConfig::visit(c.can, field);
  }

  /// Which two limits contradict each other, as a sentence; empty when none do.
  [[nodiscard]] std::string contradiction() const {
    if (ground.road_near_m >= ground.road_far_m)
      return "ground.road_near_m is not below ground.road_far_m";
    if (vehicle.min_height_m >= vehicle.max_height_m)
      return "vehicle.min_height_m is not below vehicle.max_height_m";
    if (camera.retry_min_s > camera.retry_max_s)
      return "camera.retry_min_s is above camera.retry_max_s";
    return "";
  }
};

}  // namespace plumb
