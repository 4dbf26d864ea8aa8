#include "modules/camera/video_source.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "platform/log.hpp"
#include "platform/process.hpp"

namespace plumb {
namespace {

/// Keeps FFmpeg from printing what this source says in its own words. A level that the user has
/// set stays.
void silence_ffmpeg() { ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0); }

}  // namespace

VideoSource::VideoSource(const std::string& file) : file_(file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) throw UsageError("cannot read " + file);
  silence_ffmpeg();
  // These two backends read only files. Others would take the name for
  // a pipeline or an image series.
  if (!capture_.open(file, cv::CAP_FFMPEG) && !capture_.open(file, cv::CAP_OPENCV_MJPEG))
    throw UsageError(file + ": is not a readable video");
  const double rate_hz = capture_.get(cv::CAP_PROP_FPS);
  if (!(rate_hz > 0.0) || rate_hz > 1000.0)
    throw UsageError(file + ": does not tell its frame rate");
  period_us_ = 1e6 / rate_hz;
  if (!load()) throw UsageError(file + ": has no frames");
  first_is_loaded_ = true;
}

bool VideoSource::load() {
  if (!capture_.read(colour_) || colour_.empty()) return false;
  if (colour_.depth() != CV_8U) throw UsageError(file_ + ": has more than 8 bits per pixel");
  const cv::Size size = image_.size();
  if (colour_.channels() == 1) {
    colour_.copyTo(image_);
  } else {
    cv::cvtColor(colour_, image_, cv::COLOR_BGR2GRAY);
  }
  if (!size.empty() && image_.size() != size) throw UsageError(file_ + ": changes its image size");
  const std::int64_t told_us = std::llround(capture_.get(cv::CAP_PROP_POS_MSEC) * 1e3);
  const bool increases = seq_ < 0 || told_us > capture_us_;
  capture_us_ = increases ? told_us : capture_us_ + std::llround(period_us_);
  ++seq_;
  return true;
}

void VideoSource::complete(CameraConfig* config) const {
  complete_size(file_, image_.cols, image_.rows, config);
}

std::int64_t VideoSource::num_frames() const {
  const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
  return count > 0.0 && count < 1e9 ? std::llround(count) : 0;
}

bool VideoSource::read(GreyFrame* frame) {
  if (!first_is_loaded_ && !load()) {
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    if (count > static_cast<double>(seq_ + 1)) {
      log_line("%s: ends after %lld of %.0f frames", file_.c_str(),
               static_cast<long long>(seq_) + 1, count);
    }
    return false;
  }
  first_is_loaded_ = false;
  *frame = {capture_us_,
            seq_,
            {image_.data, image_.cols, image_.rows, static_cast<std::ptrdiff_t>(image_.step[0])}};
  return true;
}

}  // namespace plumb
