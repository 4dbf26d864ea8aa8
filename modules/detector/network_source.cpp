#include "modules/detector/network_source.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "modules/detector/crops.hpp"
#include "platform/config.hpp"

namespace plumb {
namespace {

constexpr int kColumnsBeforeClasses = 5;  // centre x, y, width, height, objectness

ObjectClass class_named(const std::string& name) {
  static const std::map<std::string, ObjectClass> names = {
      {"car", ObjectClass::kCar},         {"van", ObjectClass::kVan},
      {"truck", ObjectClass::kTruck},     {"bus", ObjectClass::kBus},
      {"cyclist", ObjectClass::kCyclist}, {"pedestrian", ObjectClass::kPedestrian}};
  const auto found = names.find(name);
  if (found == names.end())
    throw ConfigError("detect.classes: '" + name +
                      "' is none of car, van, truck, bus, cyclist, pedestrian");
  return found->second;
}

std::map<int, ObjectClass> parse_classes(const std::string& text) {
  std::map<int, ObjectClass> classes;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos)
      throw ConfigError("detect.classes: '" + word + "' is not number:class");
    int number = -1;
    const std::from_chars_result read = std::from_chars(word.data(), word.data() + colon, number);
    if (read.ec != std::errc() || read.ptr != word.data() + colon || number < 0)
      throw ConfigError("detect.classes: '" + word + "' is not number:class");
    classes[number] = class_named(word.substr(colon + 1));
  }
  if (classes.empty()) throw ConfigError("detect.classes names no class");
  return classes;
}

cv::dnn::Net read_network(const DetectorConfig& config) {
  if (config.model_file.empty()) throw ConfigError("detect.model_file is not set");
  try {
    return cv::dnn::readNet(config.model_file, config.weights_file);
  } catch (const cv::Exception&) {
    throw ConfigError(config.model_file +
                      (config.weights_file.empty() ? "" : " with " + config.weights_file) +
                      ": not a network that OpenCV can read");
  }
}

}  // namespace

struct Network::Impl {
  explicit Impl(const DetectorConfig& config_in)
      : config(config_in),
        classes(parse_classes(config.classes)),
        net(read_network(config)),
        outputs(net.getUnconnectedOutLayersNames()),
        onnx(config.model_file.ends_with(".onnx")) {
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    cv::setNumThreads(1);
  }

  void search(const cv::Mat& image, const Crop& crop);
  void take_rows(const cv::Mat& rows, const cv::Mat& image, const Crop& crop);

  DetectorConfig config;
  std::map<int, ObjectClass> classes;
  cv::dnn::Net net;
  std::vector<std::string> outputs;
  bool onnx;
  std::vector<RawBox> boxes;
};

Network::Network(const DetectorConfig& config) : impl_(std::make_unique<Impl>(config)) {}
Network::~Network() = default;

std::vector<RawBox>& Network::find(const ImageView& grey) {
  // OpenCV has no view of constant pixels; these are only read.
  const cv::Mat view(grey.height_px, grey.width_px, CV_8U, const_cast<std::uint8_t*>(grey.data),
                     static_cast<std::size_t>(grey.stride_bytes));
  cv::Mat image;
  cv::cvtColor(view, image, cv::COLOR_GRAY2BGR);
  impl_->boxes.clear();
  for (const Crop& crop :
       make_crops(grey.width_px, grey.height_px, static_cast<int>(impl_->config.num_crops)))
    impl_->search(image, crop);
  return impl_->boxes;
}

void Network::Impl::search(const cv::Mat& image, const Crop& crop) {
  const auto side = static_cast<int>(config.input_px);
  const cv::Mat part = image(cv::Rect(crop.left_px, crop.top_px, crop.side_px, crop.side_px));
  std::vector<cv::Mat> found;
  try {
    net.setInput(cv::dnn::blobFromImage(part, 1.0 / 255.0, cv::Size(side, side), {}, true, false));
    net.forward(found, outputs);
  } catch (const cv::Exception&) {
    throw ConfigError(config.model_file + ": does not run on " + std::to_string(side) + " x " +
                      std::to_string(side) + " pixels");
  }
  for (const cv::Mat& output : found) {
    const cv::Mat rows = output.dims == 3 ? output.reshape(1, output.size[1]) : output;
    if (rows.dims != 2 || rows.cols <= kColumnsBeforeClasses || rows.type() != CV_32F)
      throw ConfigError(config.model_file + ": its output is not rows of boxes");
    take_rows(rows, image, crop);
  }
}

void Network::Impl::take_rows(const cv::Mat& rows, const cv::Mat& image, const Crop& crop) {
  // Darknet's rows are relative to the size of the input,
  // and its class scores include the objectness.
  const double scale = onnx ? crop.side_px / config.input_px : crop.side_px;
  for (int r = 0; r < rows.rows; ++r) {
    const auto* row = rows.ptr<float>(r);
    const float* best = std::max_element(row + kColumnsBeforeClasses, row + rows.cols);
    const auto known = classes.find(static_cast<int>(best - row) - kColumnsBeforeClasses);
    const double score =
        std::min(1.0, static_cast<double>(*best) * (onnx ? static_cast<double>(row[4]) : 1.0));
    if (known == classes.end() || !(score >= config.min_score)) continue;
    const double u = crop.left_px + scale * static_cast<double>(row[0]);
    const double v = crop.top_px + scale * static_cast<double>(row[1]);
    const double half_width = 0.5 * scale * static_cast<double>(row[2]);
    const double half_height = 0.5 * scale * static_cast<double>(row[3]);
    RawBox one{
        {std::max(u - half_width, 0.0), std::max(v - half_height, 0.0),
         std::min(u + half_width, image.cols - 1.0), std::min(v + half_height, image.rows - 1.0)},
        score,
        known->second};
    const bool sound = one.box.width_px() > 1.0 && one.box.height_px() > 1.0;
    if (sound && !is_cut_by(crop, one.box, image.cols, image.rows)) boxes.push_back(one);
  }
}

}  // namespace plumb
