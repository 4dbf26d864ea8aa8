/// plumb-draw: draws plumb-replay's results onto the images of a log.

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/channels.hpp"
#include "core/input_error.hpp"
#include "modules/camera/image_wire.hpp"
#include "modules/datasets/text.hpp"
#include "platform/bounded_decode.hpp"
#include "platform/command_line.hpp"
#include "platform/log_file.hpp"
#include "tools/run/draw/figures.hpp"
#include "tools/support/tool_main.hpp"

namespace plumb {
namespace {

struct Options {
  std::string log;
  std::string csv;
  std::string objects;
  std::string features;
  std::string out;
  std::vector<std::int64_t> frames;
  int num_pictures = 4;
};

/// Frames spread evenly over the drive, without its first one.
std::vector<std::int64_t> spread(const DriveFigures& figures, int count) {
  std::vector<std::int64_t> chosen;
  for (int i = 1; i <= count && figures.size() > 0; ++i) {
    chosen.push_back(figures.seq((figures.size() - 1) * static_cast<std::size_t>(i) /
                                 static_cast<std::size_t>(count)));
  }
  return chosen;
}

/// Turns the images of a log into pictures, one by one.
class Painter {
 public:
  explicit Painter(const Options& options)
      : options_(options), figures_(CsvTable(options.csv)), wanted_(options.frames) {
    if (!options.objects.empty()) figures_.add_objects(CsvTable(options.objects));
    if (!options.features.empty()) figures_.add_features(CsvTable(options.features));
    if (wanted_.empty()) wanted_ = spread(figures_, options.num_pictures);
    std::filesystem::create_directories(options.out);
  }

  void take(const LogEvent& event) {
    if (event.channel == kCameraCalibration.name) take_calibration(event);
    if (event.channel == kCamera.name && decoder_ != nullptr) take_image(event);
  }
  [[nodiscard]] int num_written() const { return num_written_; }

 private:
  void take_calibration(const LogEvent& event) {
    camera_calibration_t message;
    CameraModel camera;
    if (!decode_bounded(event.data, &message) || from_wire(message, &camera) != nullptr) return;
    if (decoder_ != nullptr) return;
    camera_ = camera;
    decoder_ = std::make_unique<ImageDecoder>(camera.width_px, camera.height_px);
  }

  void take_image(const LogEvent& event) {
    ImageFrame frame;
    ImageView view;
    if (read_image(event.data, &frame) != nullptr) return;
    const bool wanted = std::find(wanted_.begin(), wanted_.end(), frame.seq) != wanted_.end();
    const auto index = figures_.find(frame.seq);
    if (!wanted || !index) return;
    if (decoder_->check(frame) != nullptr || decoder_->decode(frame, &view) != nullptr) return;
    // OpenCV has no view of constant pixels; draw_overlay() only reads them.
    const cv::Mat grey(view.height_px, view.width_px, CV_8U, const_cast<std::uint8_t*>(view.data),
                       static_cast<std::size_t>(view.stride_bytes));
    write_picture(frame.seq, draw_overlay(grey, camera_, figures_.frame(*index)));
  }

  void write_picture(std::int64_t seq, const cv::Mat& picture) {
    const std::string path =
        (std::filesystem::path(options_.out) / format("%06lld.png", static_cast<long long>(seq)))
            .string();
    if (!cv::imwrite(path, picture)) throw InputError("cannot write " + path);
    ++num_written_;
  }

  const Options& options_;
  DriveFigures figures_;
  std::vector<std::int64_t> wanted_;
  CameraModel camera_;
  std::unique_ptr<ImageDecoder> decoder_;
  int num_written_ = 0;
};

int run(const Options& options) {
  Painter painter(options);
  LogReader log(options.log);
  LogEvent event;
  while (log.next(&event)) painter.take(event);
  for (const std::string& problem : log.problems()) std::cerr << "plumb-draw: " << problem << "\n";
  if (painter.num_written() == 0) {
    throw InputError(options.log + " has no image of a frame that " + options.csv + " names");
  }
  std::cout << painter.num_written() << " pictures in " << options.out << "\n";
  return 0;
}

}  // namespace
}  // namespace plumb

int main(int argc, char** argv) {
  plumb::Options options;
  plumb::CommandLine app("Draws road grid, horizon, objects and figures onto the frames of a log",
                         "plumb-draw");
  app.add_option("LOG", options.log, "LCM log with the images").required();
  app.add_option("CSV", options.csv, "what plumb-replay --csv wrote for it").required();
  app.add_option("--objects", options.objects, "what plumb-replay --objects wrote for it");
  app.add_option("--features", options.features, "what plumb-replay --features wrote for it");
  app.add_option("--out", options.out, "folder for the pictures").required();
  app.add_option("--frames", options.frames, "sequence numbers to draw [spread over the drive]")
      .delimiter(',');
  app.add_option("--num-pictures", options.num_pictures,
                 "number of pictures when --frames is not given")
      .check(plumb::within(1, 1000))
      .capture_default_str();
  return plumb::tool_main(&app, argc, argv, [&] { return plumb::run(options); });
}
