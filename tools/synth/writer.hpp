/// Renders a drive into a folder in KITTI odometry layout, with its truth.
///
/// Threads:
///   Frames are handed out one by one to `num_threads` workers. The files do not depend on their
///   number.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>

#include "tools/synth/studio.hpp"

namespace plumb::synth {

struct WriteResult {
  int frames = 0;        ///< complete frames, from 0
  double seconds = 0.0;  ///< rendering time, wall clock
};

/// Writes image_0/, calib.txt, times.txt, poses.txt, gt_ground_plane.txt, vehicle.txt and
/// label_02.txt. Stops early and keeps what is complete when `stop` becomes true. `progress` is
/// called with the number of finished frames.
/// Throws std::runtime_error, naming the file, when something cannot be written.
WriteResult write_drive(const Studio& studio, int num_threads, const std::atomic<bool>& stop,
                        const std::function<void(int)>& progress);

/// Throws InputError when the drive's files would overwrite the pose file that it follows.
void refuse_overwriting(const SynthConfig& config);

/// Throws UsageError when `folder` is not empty and `force` is not set; creates it otherwise.
/// With `force`, only files of a former drive are removed.
void prepare_folder(const std::filesystem::path& folder, bool force);

}  // namespace plumb::synth
