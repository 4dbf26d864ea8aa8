/// The command line of plumb-synth.
#pragma once

#include <string>

#include "platform/command_line.hpp"
#include "tools/synth/synth_config.hpp"

namespace plumb::synth {

struct Options {
  SynthConfig config;
  int threads = 0;
  bool force = false;
  bool quiet = false;
  std::string size = "1242x375";
  std::string tunnel;
  std::string tube;
  std::string covered;
  std::string turntable_span;
  double sun_deg = 35.0;
  double sun_azimuth_deg = -1.0;
  double mount_pitch_deg = 1e9;
  double mount_roll_deg = 1e9;
  double mount_yaw_deg = 1e9;
  double knock_pitch_deg = 0.0;
  double knock_roll_deg = 0.0;
  double knock_yaw_deg = 0.0;
  double focal_px = 0.0;
  bool overcast = false;
  bool night = false;
};

/// Declares every option of rendering on `app`.
void declare(CommandLine& app, Options& options);

/// Fills what depends on other options. Throws UsageError in one sentence.
void complete(Options& options);

}  // namespace plumb::synth
