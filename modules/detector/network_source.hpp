/// A detection network out of the user's files, by OpenCV's dnn module. None is shipped.
///
/// Formats  Darknet (.cfg and .weights) with region or yolo layers; ONNX whose only output is [1, N, 5 + classes] of
///          centre, size (pixels of the input), objectness and class scores, as YOLOv5 exports it.
/// Threads  one. Memory  OpenCV's own.
#pragma once

#include <memory>
#include <vector>

#include "core/image_view.hpp"
#include "modules/detector/detect_config.hpp"
#include "modules/detector/suppress.hpp"

namespace plumb {

class Network {
 public:
  /// Throws ConfigError naming the file, or the setting, that is wrong.
  explicit Network(const DetectConfig& config);
  ~Network();

  /// Boxes of all crops in pixels of the image, above the least score, of classes that have a name. Valid until the next
  /// call. Throws ConfigError when the network's output is of no known form.
  std::vector<RawBox>& find(const ImageView& grey);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumb
