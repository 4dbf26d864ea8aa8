#include "modules/camera/front_end.hpp"

namespace plumb {
namespace {

double or_else(double value, double fallback) { return value > 0.0 ? value : fallback; }

MaskPainter paint(const CameraConfig& config, const Rectifier& rectifier, int width_px,
                  int height_px, const std::uint8_t* mask_bytes) {
  MaskPainter painter(width_px, height_px);
  painter.add_rows(config.mask_top_rows, config.mask_bottom_rows);
  if (!config.mask_polygon.empty()) (void)painter.add_polygon(config.mask_polygon);
  if (mask_bytes != nullptr) painter.add_bytes(mask_bytes);
  // The border of the area that the camera did not see is as static as that of the vehicle itself.
  painter.add_bytes(rectifier.unseen().data());
  return painter;
}

Rectifier make_rectifier(const CameraConfig& config, int width_px, int height_px) {
  return {width_px, height_px, captured_pinhole(config), lens_of(config),
          published_pinhole(config)};
}

}  // namespace

Lens lens_of(const CameraConfig& config) {
  Lens lens;
  lens.model = config.distortion == "fisheye" ? LensModel::kFisheye : LensModel::kPlumbBob;
  lens.k1 = config.k1;
  lens.k2 = config.k2;
  lens.p1 = config.p1;
  lens.p2 = config.p2;
  lens.k3 = config.k3;
  lens.k4 = config.k4;
  return lens;
}

PinholePx captured_pinhole(const CameraConfig& config) {
  return {config.fx_px, config.fy_px, config.cx_px, config.cy_px};
}

PinholePx published_pinhole(const CameraConfig& config) {
  return {
      or_else(config.rectified_fx_px, config.fx_px), or_else(config.rectified_fy_px, config.fy_px),
      or_else(config.rectified_cx_px, config.cx_px), or_else(config.rectified_cy_px, config.cy_px)};
}

CameraModel published_model(const CameraConfig& config, int width_px, int height_px) {
  const PinholePx pinhole = published_pinhole(config);
  CameraModel model;
  model.width_px = width_px;
  model.height_px = height_px;
  model.fx_px = pinhole.fx_px;
  model.fy_px = pinhole.fy_px;
  model.cx_px = pinhole.cx_px;
  model.cy_px = pinhole.cy_px;
  model.residual_k1 = config.residual_k1;
  model.residual_k2 = config.residual_k2;
  model.readout_s = config.readout_s;
  model.camera_height_m = config.camera_height_m;
  return model;
}

std::optional<CameraModel> stated_model(const CameraConfig& config) {
  const bool is_stated =
      config.width_px > 0 && config.height_px > 0 && config.fx_px > 0.0 && config.fy_px > 0.0;
  if (!is_stated) return std::nullopt;
  return published_model(config, config.width_px, config.height_px);
}

std::string why_unusable(const CameraConfig& config, int width_px, int height_px,
                         const std::uint8_t* mask_bytes) {
  constexpr int kMinSide = 64;  // the estimators accept no smaller image
  constexpr double kMaxCovered = 0.9;
  const std::string size = std::to_string(width_px) + "x" + std::to_string(height_px);
  if (width_px < kMinSide || height_px < kMinSide) return "an image of " + size + " is too small";
  if (config.fx_px <= 0.0 || config.fy_px <= 0.0) {
    return "camera.fx_px and camera.fy_px are not set: the camera has to be calibrated";
  }
  if (config.cx_px >= width_px || config.cy_px >= height_px) {
    return "camera.cx_px, camera.cy_px is outside the image of " + size;
  }
  if (config.camera_height_m != 0.0 && config.camera_height_m < 0.3) {
    return "camera.camera_height_m is neither 0 nor in [0.3, 4]";
  }
  const bool is_fisheye = config.distortion == "fisheye";
  if (is_fisheye && (config.p1 != 0.0 || config.p2 != 0.0)) {
    return "camera.p1 and camera.p2 belong to plumb_bob, not to fisheye";
  }
  if (!is_fisheye && config.k4 != 0.0) return "camera.k4 belongs to fisheye, not to plumb_bob";
  if (!config.mask_polygon.empty() && !MaskPainter(1, 1).add_polygon(config.mask_polygon)) {
    return "camera.mask_polygon = \"" + config.mask_polygon +
           "\" is not a list of three or more corners 'u,v u,v u,v'";
  }
  const Rectifier rectifier = make_rectifier(config, width_px, height_px);
  if (paint(config, rectifier, width_px, height_px, mask_bytes).covered_ratio() > kMaxCovered) {
    return "mask and distortion together leave less than a tenth of the image";
  }
  return {};
}

FrontEnd::FrontEnd(const CameraConfig& config, int width_px, int height_px,
                   const std::uint8_t* mask_bytes)
    : rectifier_(make_rectifier(config, width_px, height_px)),
      mask_(paint(config, rectifier_, width_px, height_px, mask_bytes), config.mask_feather_px),
      health_(width_px, height_px, {config.black_mean, config.flat_std, config.fault_frames}) {}

ImageFault FrontEnd::process(const ImageView& captured, std::uint8_t* published,
                             StageProbe* probe) {
  const ImageFault fault = health_.update(captured);
  probe->mark("judge");
  rectifier_.apply(captured, published);
  probe->mark("rectify");
  mask_.apply(published);
  probe->mark("mask");
  return fault;
}

}  // namespace plumb
