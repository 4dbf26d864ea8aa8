/// Every setting of plumb-detect; visit() is the only list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct DetectorConfig {
  std::string model_file;
  std::string weights_file;
  std::string classes = "0:pedestrian 1:cyclist 2:car 5:bus 7:truck";
  double input_px = 320.0;
  double num_crops = 0.0;
  double min_score = 0.3;
  double suppress_overlap_ratio = 0.45;
  double rate_hz = 10.0;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("detect.model_file", c.model_file,
          "network: a Darknet .cfg, or an .onnx with rows of centre, size, objectness, classes");
    field("detect.weights_file", c.weights_file, "Darknet .weights; empty for an .onnx");
    field("detect.classes", c.classes,
          "classes of the network's class numbers: 'number:class ...'; other numbers are ignored");
    field("detect.input_px", c.input_px, 64.0, 2048.0, "side of the network's square input");
    field("detect.num_crops", c.num_crops, 0.0, 8.0,
          "number of square crops per image; 0: as many as make neighbours overlap by a fifth");
    field("detect.min_score", c.min_score, 0.01, 1.0, "boxes with a lower score are dropped");
    field(
        "detect.suppress_overlap_ratio", c.suppress_overlap_ratio, 0.05, 0.95,
        "a box becomes a candidate of a better box of its class when their intersection over union "
        "is at least this");
    field("detect.rate_hz", c.rate_hz, 0.2, 60.0,
          "largest number of images searched per second; the newest image is searched");
  }
};

}  // namespace plumb
