/// plumb-boxes: runs a detector over a log's images and writes its boxes to disk, those from before
/// suppression, too.

#include <fstream>
#include <iostream>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/chain/plumb_config.hpp"
#include "modules/datasets/text.hpp"
#include "modules/detector/detector_node.hpp"
#include "platform/config.hpp"
#include "platform/log_file.hpp"
#include "platform/overwrite_guard.hpp"
#include "tools/datasets/kitti_tracking/candidate_file.hpp"
#include "tools/datasets/kitti_tracking/kitti_tracking.hpp"
#include "tools/support/progress.hpp"
#include "tools/support/stop_flag.hpp"
#include "tools/support/tool_main.hpp"

namespace {

constexpr const char* kFooter =
    R"(LOG is what plumb-kitti2lcm or plumb-convert wrote. The network is that of plumb-detect: keys detect.* of --config.
BOXES has the form of KITTI's tracking labels with a score; the detector does not track, so every box has a number of
its own. --candidates has rows 'frame type left top right bottom score', as plumb-kitti2lcm --candidates reads them.

Example
  plumb-boxes 04.lcm --config detector.toml --out boxes.txt --candidates candidates.txt)";

struct BoxesOptions {
  std::string log, config, out, candidates;
};

/// A text file that is checked when it is closed.
class RowFile {
 public:
  explicit RowFile(const std::string& path) : path_(path), file_(path) {}
  void write(const std::string& row) { file_ << row; }
  void close() {
    file_.close();
    if (!file_) throw plumb::InputError("cannot write " + path_);
  }

 private:
  std::string path_;
  std::ofstream file_;
};

std::string box_line(int frame, int number, const plumb::Detection& detection) {
  const plumb::Box& box = detection.box;
  return plumb::format(
      "%d %d %s -1 -1 -10 %.2f %.2f %.2f %.2f -1 -1 -1 -1000 -1000 -1000 -10 %.4f\n", frame, number,
      plumb::kitti_name_of(detection.object_class), box.left_px, box.top_px, box.right_px,
      box.bottom_px, detection.score);
}

class BoxWriter {
 public:
  explicit BoxWriter(const BoxesOptions& options)
      : boxes_(options.out),
        candidates_(options.candidates.empty() ? "/dev/null" : options.candidates) {}

  void take(const plumb::detections_t& message) {
    if (const char* why = plumb::from_wire(message, &frame_)) throw plumb::InputError(why);
    const int number = static_cast<int>(frame_.seq);
    for (const plumb::Detection& detection : frame_.detections) {
      boxes_.write(box_line(number, num_boxes_++, detection));
      for (const plumb::Candidate& candidate : detection.candidates) {
        candidates_.write(plumb::candidate_line({number, detection.object_class, candidate}));
        ++num_candidates_;
      }
    }
  }
  void finish() {
    boxes_.close();
    candidates_.close();
    std::cout << num_boxes_ << " boxes, " << num_candidates_ << " candidates\n";
  }

 private:
  RowFile boxes_, candidates_;
  plumb::DetectionFrame frame_;
  int num_boxes_ = 0;
  int num_candidates_ = 0;
};

int run(const BoxesOptions& options) {
  plumb::OverwriteGuard()
      .reads("LOG", options.log)
      .reads("--config", options.config)
      .writes("--out", options.out)
      .writes("--candidates", options.candidates)
      .check();
  plumb::PlumbConfig config;
  plumb::load_config(options.config, &config);
  plumb::LogReader reader(options.log);
  plumb::DetectorNode detector(config.detect);
  BoxWriter writer(options);
  plumb::catch_stop_signals();
  plumb::Progress progress("searching", "images", reader.file_bytes());
  plumb::LogEvent event;
  std::int64_t num_images = 0;
  while (!plumb::stop_requested() && reader.next(&event)) {
    if (event.channel != plumb::kCamera.name) continue;
    const char* refused = detector.take_image(event.data);
    const plumb::detections_t* found = refused == nullptr ? detector.search(&refused) : nullptr;
    if (refused != nullptr) throw plumb::InputError(options.log + ": " + refused);
    if (found != nullptr) writer.take(*found);
    progress.update(reader.offset_bytes(), ++num_images);
  }
  progress.finish(!plumb::stop_requested());
  writer.finish();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  BoxesOptions options;
  plumb::CommandLine app("Runs a detector over a log and writes its boxes", "plumb-boxes");
  app.footer(kFooter);
  app.add_option("LOG", options.log, "log with CAMERA").required();
  app.add_option("--config", options.config, "TOML configuration with the network").required();
  app.add_option("--out", options.out, "boxes to write").required();
  app.add_option("--candidates", options.candidates, "boxes from before suppression to write");
  return plumb::tool_main(&app, argc, argv, [&] { return run(options); });
}
