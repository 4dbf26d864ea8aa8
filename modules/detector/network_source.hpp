/// Runs a detection network from the user's files with OpenCV's dnn module. No network is shipped.
///
/// Formats:
///   Darknet (.cfg and .weights) with region or yolo layers, or ONNX. The only output of an ONNX
///   network is [1, N, 5 + classes] with centre and size (in pixels of the input), objectness and
///   class scores, as YOLOv5 exports it.
/// Threads:
///   OpenCV runs in the calling thread only.
/// Memory:
///   OpenCV allocates in every call.
#pragma once

#include <memory>
#include <vector>

#include "core/image_view.hpp"
#include "modules/detector/detector_config.hpp"
#include "modules/detector/suppress.hpp"

namespace plumb {

class Network {
 public:
  /// Loads the network. Throws ConfigError that names the wrong file or setting.
  explicit Network(const DetectorConfig& config);
  ~Network();

  /// Finds the boxes of all crops that have a named class and at least the minimum score, in pixels
  /// of the image. They are valid until the next call. Throws ConfigError when the output of the
  /// network has an unknown layout.
  std::vector<RawBox>& find(const ImageView& grey);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
