/// The settings of the judges of time stamps, clocks and pictures.
#pragma once

#include "modules/integrity/clock_offset.hpp"
#include "modules/integrity/picture_config.hpp"
#include "modules/integrity/time_base_config.hpp"

namespace plumb {

struct IntegrityConfig {
  TimeBaseConfig time;
  ClockOffsetConfig clock;
  PictureConfig picture;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    TimeBaseConfig::visit(c.time, field);
    ClockOffsetConfig::visit(c.clock, field);
    PictureConfig::visit(c.picture, field);
  }
};

}  // namespace plumb
