#include "tools/run/export/video_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <vector>

#include "core/input_error.hpp"
#include "tools/run/draw/figures.hpp"
#include "tools/run/draw/labels.hpp"
#include "tools/run/replay/frame_csv.hpp"
#include "tools/run/replay/names.hpp"

namespace plumb {
namespace {

constexpr double kLongestPicture_s = 2.0;
constexpr double kUsualRate_hz = 10.0;

/// The table of the drive, as plumb-replay --csv writes it.
CsvTable table_of(const DriveResults& drive) {
  std::vector<std::string> lines = {frame_csv_header(false)};
  for (const FrameResult& frame : drive.frames) lines.push_back(frame.csv_row);
  return {"results", lines};
}

/// Pictures per second: one by the median interval.
double rate_of(const DriveResults& drive) {
  std::vector<std::int64_t> intervals_us;
  for (std::size_t i = 1; i < drive.frames.size(); ++i)
    intervals_us.push_back(drive.frames[i].capture_us - drive.frames[i - 1].capture_us);
  if (intervals_us.empty()) return kUsualRate_hz;
  const auto middle = intervals_us.begin() + static_cast<std::ptrdiff_t>(intervals_us.size() / 2);
  std::nth_element(intervals_us.begin(), middle, intervals_us.end());
  return *middle > 0 ? std::clamp(1e6 / static_cast<double>(*middle), 1.0, 240.0) : kUsualRate_hz;
}

void add_objects(const objects_t& objects, FrameFigures* figures) {
  for (const object_t& object : objects.objects) {
    if (object.status == object_t::STATUS_NOT_LOCALISED) continue;
    ObjectFigure figure;
    figure.place_m = {object.position_ground_m[0], object.position_ground_m[1]};
    figure.yaw_rad = object.yaw_rad;
    figure.size_m = {object.size_m[0], object.size_m[1], object.size_m[2]};
    figure.measured = object.status == object_t::STATUS_MEASURED;
    figure.label = object_label(object_class_name(object.class_id), figure.place_m);
    figures->objects.push_back(std::move(figure));
  }
}

class VideoFile final : public DriveSink {
 public:
  VideoFile(const DriveResults& drive, const std::string& path)
      : drive_(drive), path_(path), figures_(table_of(drive)), rate_hz_(rate_of(drive)) {}

  void take_image(const JpegImage& image) override {
    const cv::Mat bytes(1, static_cast<int>(image.jpeg.size()), CV_8U,
                        const_cast<std::uint8_t*>(image.jpeg.data()));
    grey_ = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
  }

  void take_frame(const FrameResult& frame) override {
    const std::size_t index = next_++;
    const bool has_image =
        grey_.cols == drive_.camera->width_px && grey_.rows == drive_.camera->height_px;
    if (!has_image) return;
    FrameFigures figures = figures_.frame(index);
    figures.features = frame.features;
    if (frame.objects) add_objects(*frame.objects, &figures);
    const cv::Mat picture = draw_overlay(grey_, *drive_.camera, figures);
    hold_last_until(frame.capture_us);
    show(picture);
    last_us_ = frame.capture_us;
    grey_.release();
  }

  void close() override {
    if (!video_.isOpened()) throw InputError("no image of the drive can be drawn into " + path_);
    video_.release();
    std::error_code ignored;
    if (std::filesystem::file_size(path_, ignored) == 0 || ignored)
      throw InputError("cannot write " + path_);
  }

 private:
  /// Repeats the last picture for the time in which there was none.
  void hold_last_until(std::int64_t capture_us) {
    if (canvas_.empty()) return;
    const double gap_s =
        std::clamp(1e-6 * static_cast<double>(capture_us - last_us_), 0.0, kLongestPicture_s);
    for (auto i = std::lround(gap_s * rate_hz_); i > 1; --i) video_.write(canvas_);
  }

  /// The strip of text may need one line more than that of the first picture, which gave the video
  /// its size. H.264 wants even sizes.
  void show(const cv::Mat& picture) {
    if (canvas_.empty()) {
      const int room = LabelStyle(picture.cols).line_height;
      canvas_.create((picture.rows + room + 1) / 2 * 2, (picture.cols + 1) / 2 * 2, CV_8UC3);
      open();
    }
    canvas_.setTo(cv::Scalar(32, 28, 26));
    const cv::Rect both =
        cv::Rect(0, 0, picture.cols, picture.rows) & cv::Rect(0, 0, canvas_.cols, canvas_.rows);
    picture(both).copyTo(canvas_(both));
    video_.write(canvas_);
  }

  void open() {
    const bool is_mp4 = std::filesystem::path(path_).extension() == ".mp4";
    const int code = is_mp4 ? cv::VideoWriter::fourcc('a', 'v', 'c', '1')
                            : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    if (!video_.open(path_, cv::CAP_FFMPEG, code, rate_hz_, canvas_.size()))
      throw InputError("cannot write " + path_);
  }

  const DriveResults& drive_;
  std::string path_;
  DriveFigures figures_;
  double rate_hz_;
  cv::VideoWriter video_;
  cv::Mat grey_;    ///< of the frame that follows; empty when it has none
  cv::Mat canvas_;  ///< the last picture, of the video's size
  std::int64_t last_us_ = 0;
  std::size_t next_ = 0;
};

}  // namespace

void check_video_name(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension().string();
  if (suffix != ".mp4" && suffix != ".avi")
    throw InputError("--video " + path + " ends neither in .mp4 nor in .avi");
}

std::unique_ptr<DriveSink> make_video_file(const DriveResults& drive, const std::string& path) {
  if (!drive.camera) throw InputError("--video: the log holds no valid calibration");
  return std::make_unique<VideoFile>(drive, path);
}

}  // namespace plumb
