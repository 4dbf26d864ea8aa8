#include "modules/camera/kitti_source.hpp"

#include <cmath>
#include <string>

#include "modules/datasets/kitti/png_image.hpp"
#include "platform/process.hpp"

namespace plumb {
namespace {

Sequence read_folder(const std::filesystem::path& folder, int camera) {
  SequenceOptions options;
  options.folder = folder;
  options.camera = camera;
  return read_sequence(options);
}

bool is_distorted(const CameraConfig& c) {
  return c.distortion != "plumb_bob" || c.k1 != 0.0 || c.k2 != 0.0 || c.p1 != 0.0 || c.p2 != 0.0 ||
         c.k3 != 0.0 || c.k4 != 0.0;
}

/// Replaces a configured 0 by the value of the folder. Any other value must be equal to it.
template <typename T>
void take_or_compare(const char* key, T known, T* configured) {
  constexpr double kRelative = 1e-6;
  const auto difference = static_cast<double>(*configured) - static_cast<double>(known);
  if (*configured != T{} &&
      std::abs(difference) > kRelative * std::abs(static_cast<double>(known))) {
    throw UsageError(std::string(key) + " = " + std::to_string(*configured) +
                     " contradicts the KITTI folder, which says " + std::to_string(known));
  }
  *configured = known;
}

}  // namespace

KittiSource::KittiSource(const std::filesystem::path& folder, int camera)
    : sequence_(read_folder(folder, camera)) {
  load(sequence_.frames.front().image);
}

void KittiSource::load(const std::filesystem::path& file) {
  cv::Mat image = load_grey_png(file, sequence_.colour_allowed);
  if (!image_.empty() && image.size() != image_.size()) {
    throw UsageError(file.string() + " is " + std::to_string(image.cols) + "x" +
                     std::to_string(image.rows) + ", the images before it are " +
                     std::to_string(image_.cols) + "x" + std::to_string(image_.rows));
  }
  image_ = std::move(image);
}

void KittiSource::complete(CameraConfig* config) const {
  if (is_distorted(*config)) {
    throw UsageError(
        "camera.distortion, camera.k1 ...: images of a KITTI folder are rectified already");
  }
  const CameraModel& camera = sequence_.camera;
  take_or_compare("camera.width_px", image_.cols, &config->width_px);
  take_or_compare("camera.height_px", image_.rows, &config->height_px);
  take_or_compare("camera.fx_px", camera.fx_px, &config->fx_px);
  take_or_compare("camera.fy_px", camera.fy_px, &config->fy_px);
  take_or_compare("camera.cx_px", camera.cx_px, &config->cx_px);
  take_or_compare("camera.cy_px", camera.cy_px, &config->cy_px);
  // The two coefficients describe one lens,
  // so those of the settings and of the folder are not mixed.
  if (config->residual_k1 == 0.0 && config->residual_k2 == 0.0) {
    config->residual_k1 = camera.residual_k1;
    config->residual_k2 = camera.residual_k2;
  }
  if (config->readout_s == 0.0) config->readout_s = camera.readout_s;
  if (config->camera_height_m == 0.0) config->camera_height_m = camera.camera_height_m;
}

bool KittiSource::read(GreyFrame* frame) {
  if (next_ == sequence_.frames.size()) return false;
  const SequenceFrame& entry = sequence_.frames[next_];
  if (next_ > 0) load(entry.image);  // the constructor loaded the first one
  ++next_;
  *frame = {entry.capture_us,
            entry.seq,
            {image_.data, image_.cols, image_.rows, static_cast<std::ptrdiff_t>(image_.step[0])}};
  return true;
}

}  // namespace plumb
