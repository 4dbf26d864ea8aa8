/// The settings of all processes. One file serves them all,
/// and a key that no module owns is an error.
#pragma once

#include "modules/camera/camera_config.hpp"
#include "modules/can/can_config.hpp"
#include "modules/detections/detections_config.hpp"
#include "modules/detector/detector_config.hpp"
#include "modules/ground/types/ground_config.hpp"
#include "modules/mount/mount_config.hpp"
#include "modules/objects/objects_config.hpp"
#include "modules/vo/vo_config.hpp"

namespace plumb {

struct PlumbConfig {
  CameraConfig camera;
  VoConfig vo;
  DetectorConfig detect;
  DetectionsConfig detections;
  GroundConfig ground;
  MountConfig mount;
  ObjectsConfig objects;
  CanConfig can;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    CameraConfig::visit(c.camera, field);
    VoConfig::visit(c.vo, field);
    DetectorConfig::visit(c.detect, field);
    DetectionsConfig::visit(c.detections, field);
    GroundConfig::visit(c.ground, field);
    MountConfig::visit(c.mount, field);
    ObjectsConfig::visit(c.objects, field);
    CanConfig::visit(c.can, field);
  }
};

}  // namespace plumb
