/// An MCAP file with Foxglove's messages in JSON, which Foxglove and PlotJuggler open as it is.
///
/// Topics:
///   /camera/image        foxglove.CompressedImage
///   /camera/calibration  foxglove.CameraCalibration, once
///   /tf                  foxglove.FrameTransforms: odom -> base_link -> camera -> road
///   /pose                foxglove.PoseInFrame: base_link in odom
///   /path                foxglove.PosesInFrame: the whole drive, once
///   /road                foxglove.SceneUpdate: the road as a grid
///   /objects             foxglove.SceneUpdate: a box and a label per object
///   /log                 foxglove.Log: changes of the motion's and the plane's status, resets
///   /plumbline/frame     every column of plumb-replay --csv that has a value
/// Frames:
///   base_link is `vehicle`, and odom that of the first image (vehicle_frame.hpp). road has the
///   axes of `ground` in the messages and follows the plane from image to image.
#pragma once

#include <filesystem>
#include <memory>

#include "tools/run/export/drive_sink.hpp"

namespace plumb {

/// Creates or replaces the file. `drive` outlives the sink. Throws InputError.
[[nodiscard]] std::unique_ptr<DriveSink> make_foxglove_file(const DriveResults& drive,
                                                            const std::filesystem::path& path);

}  // namespace plumb
