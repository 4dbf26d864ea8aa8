/// The images in messages of ROS 2 and Foxglove.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

#include "tools/run/convert/mcap_reader.hpp"

namespace plumb {

/// sensor_msgs/msg/CompressedImage and sensor_msgs/msg/Image in CDR, foxglove.CompressedImage in
/// JSON and Protobuf.
[[nodiscard]] bool has_images(const McapChannel& channel);

struct StampedImage {
  std::int64_t stamp_us = 0;
  cv::Mat grey;
};

/// Fills `image` and returns null, or returns the reason. @pre has_images(channel)
[[nodiscard]] const char* read_image_message(const McapChannel& channel,
                                             std::span<const std::uint8_t> data,
                                             StampedImage* image);

}  // namespace plumb
