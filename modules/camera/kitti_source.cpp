#include "modules/camera/kitti_source.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <string>

#include "platform/process.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

std::ifstream open_text(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw UsageError("cannot read " + file.string());
  return stream;
}

std::string at_line(const fs::path& file, std::size_t line) {
  return file.string() + ":" + std::to_string(line) + ": ";
}

bool to_number(const std::string& text, double* value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, *value);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(*value);
}

std::vector<std::int64_t> read_times_us(const fs::path& file) {
  std::ifstream stream = open_text(file);
  std::vector<std::int64_t> times_us;
  std::string line;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word)) continue;
    double time_s = 0.0;
    constexpr double kMax_s = 1e12;
    if (!to_number(word, &time_s) || std::abs(time_s) > kMax_s || words >> word) {
      throw UsageError(at_line(file, times_us.size() + 1) + "'" + line +
                       "' is not a time in seconds");
    }
    const std::int64_t time_us = std::llround(time_s * 1e6);
    if (!times_us.empty() && time_us <= times_us.back()) {
      throw UsageError(at_line(file, times_us.size() + 1) + "time does not increase");
    }
    times_us.push_back(time_us);
  }
  return times_us;
}

PinholePx read_pinhole(const fs::path& file, int camera) {
  std::ifstream stream = open_text(file);
  std::string key = "P0:";
  key[1] = static_cast<char>('0' + camera);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != key) continue;
    std::array<double, 12> p{};
    for (double& value : p) {
      if (!(words >> word) || !to_number(word, &value)) {
        throw UsageError(at_line(file, number) + key + " is not followed by 12 numbers");
      }
    }
    if (p[0] <= 0.0 || p[5] <= 0.0) {
      throw UsageError(at_line(file, number) + "focal length is not positive");
    }
    return {p[0], p[5], p[2], p[6]};
  }
  throw UsageError(file.string() + ": has no row '" + key + "'");
}

void take_or_compare(const char* key, double known, double* configured) {
  if (*configured != 0.0 && std::abs(*configured - known) > 1e-6 * std::abs(known)) {
    throw UsageError(std::string(key) + " contradicts calib.txt of the KITTI folder: " +
                     std::to_string(*configured) + " against " + std::to_string(known));
  }
  *configured = known;
}

}  // namespace

KittiSource::KittiSource(const fs::path& folder, int camera) : allow_colour_(camera >= 2) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw UsageError(folder.string() + " is not a folder");
  list_images(folder / ("image_" + std::to_string(camera)));
  assign_times(folder / "times.txt");
  pinhole_ = read_pinhole(folder / "calib.txt", camera);
  load(entries_.front().file);
}

void KittiSource::list_images(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& item : fs::directory_iterator(folder, error)) {
    if (item.path().extension() != ".png") continue;
    const std::string stem = item.path().stem().string();
    std::int64_t number = 0;
    const char* end = stem.data() + stem.size();
    const auto result = std::from_chars(stem.data(), end, number);
    if (result.ec != std::errc() || result.ptr != end || number < 0) {
      throw UsageError(item.path().string() + ": file name is not a frame number");
    }
    entries_.push_back({number, item.path(), 0});
  }
  if (error) throw UsageError("cannot read the folder " + folder.string() + ": " + error.message());
  if (entries_.empty()) throw UsageError(folder.string() + " has no PNG images");
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return a.number < b.number; });
  const auto twin =
      std::adjacent_find(entries_.begin(), entries_.end(),
                         [](const auto& a, const auto& b) { return a.number == b.number; });
  if (twin != entries_.end()) {
    throw UsageError(twin->file.string() + ": another file has the same frame number");
  }
}

void KittiSource::assign_times(const fs::path& file) {
  const std::vector<std::int64_t> times_us = read_times_us(file);
  const std::int64_t first = entries_.front().number;
  const std::int64_t last = entries_.back().number;
  const auto rows = static_cast<std::int64_t>(times_us.size());
  const bool by_order = rows == static_cast<std::int64_t>(entries_.size());
  const bool from_first = rows == last - first + 1;
  if (!by_order && !from_first && rows <= last) {
    throw UsageError(file.string() + ": has " + std::to_string(rows) + " times for " +
                     std::to_string(entries_.size()) + " images, numbered " +
                     std::to_string(first) + " to " + std::to_string(last));
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const std::int64_t row = by_order     ? static_cast<std::int64_t>(i)
                             : from_first ? entries_[i].number - first
                                          : entries_[i].number;
    entries_[i].capture_us = times_us[static_cast<std::size_t>(row)];
  }
}

void KittiSource::load(const fs::path& file) {
  cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  if (image.empty()) throw UsageError(file.string() + ": is not a readable PNG");
  if (image.depth() != CV_8U) throw UsageError(file.string() + ": has more than 8 bits per pixel");
  if (image.channels() != 1 && !allow_colour_) {
    throw UsageError(file.string() + ": is a colour image; cameras 0 and 1 are grey");
  }
  if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
  if (image.channels() == 4) cv::cvtColor(image, image, cv::COLOR_BGRA2GRAY);
  if (size_.empty()) size_ = image.size();
  if (image.size() != size_) {
    throw UsageError(file.string() + ": is " + std::to_string(image.cols) + "x" +
                     std::to_string(image.rows) + ", the images before it are " +
                     std::to_string(size_.width) + "x" + std::to_string(size_.height));
  }
  image_ = image;
}

void KittiSource::complete(CameraConfig* config) const {
  const bool distorted = config->distortion != "plumb_bob" || config->k1 != 0.0 ||
                         config->k2 != 0.0 || config->p1 != 0.0 || config->p2 != 0.0 ||
                         config->k3 != 0.0;
  if (distorted)
    throw UsageError("camera.k1 ... camera.k3: images of a KITTI folder are rectified already");
  double width = config->width_px;
  double height = config->height_px;
  take_or_compare("camera.width_px", size_.width, &width);
  take_or_compare("camera.height_px", size_.height, &height);
  config->width_px = size_.width;
  config->height_px = size_.height;
  take_or_compare("camera.fx_px", pinhole_.fx_px, &config->fx_px);
  take_or_compare("camera.fy_px", pinhole_.fy_px, &config->fy_px);
  take_or_compare("camera.cx_px", pinhole_.cx_px, &config->cx_px);
  take_or_compare("camera.cy_px", pinhole_.cy_px, &config->cy_px);
}

bool KittiSource::read(GreyFrame* frame) {
  if (next_ == entries_.size()) return false;
  const Entry& entry = entries_[next_];
  if (next_ > 0) load(entry.file);  // the first one was loaded for its size
  ++next_;
  *frame = {entry.capture_us,
            entry.number,
            {image_.data, image_.cols, image_.rows, static_cast<std::ptrdiff_t>(image_.step[0])}};
  return true;
}

}  // namespace plumb
