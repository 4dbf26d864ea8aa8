/// Every setting of plumb-detect; visit() is the one list of keys, ranges and meanings.
#pragma once

#include <string>

namespace plumb {

struct DetectConfig {
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
          "network: Darknet's .cfg, or .onnx with rows of centre, size, objectness, classes");
    field("detect.weights_file", c.weights_file, "Darknet's .weights; empty for .onnx");
    field("detect.classes", c.classes,
          "what the network's class numbers mean: 'number:class ...'; others are left out");
    field("detect.input_px", c.input_px, 64.0, 2048.0, "side of the square that the network takes");
    field("detect.num_crops", c.num_crops, 0.0, 8.0,
          "squares cut out of an image, side by side; 0: as many as overlap by a fifth");
    field("detect.min_score", c.min_score, 0.01, 1.0, "boxes scored lower are not kept");
    field(
        "detect.suppress_overlap_ratio", c.suppress_overlap_ratio, 0.05, 0.95,
        "intersection over union with a better box of the class, from which on a box is that one's "
        "candidate");
    field("detect.rate_hz", c.rate_hz, 0.2, 60.0,
          "images searched per second at most; always the newest one");
  }
};

}  // namespace plumb
