/// Every setting of plumb-camera; visit() is the one list of keys, ranges and meanings.
///
/// Frames   img: u right, v down, (0,0) is the centre of the upper left pixel.
/// Model    plumb_bob (k1 k2 p1 p2 k3) or fisheye (equidistant, k1..k4), coefficients as OpenCV's.
///          plumb_bob with every coefficient 0 is a camera that is already rectified.
#pragma once

#include <string>

namespace plumb {

struct CameraConfig {
  // The captured image. 0: not set; the device or the folder says.
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;

  // Its distortion.
  std::string distortion = "plumb_bob";
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;
  double k4 = 0.0;

  // The published pinhole. 0: as captured.
  double rectified_fx_px = 0.0;
  double rectified_fy_px = 0.0;
  double rectified_cx_px = 0.0;
  double rectified_cy_px = 0.0;

  double readout_s = 0.0;
  double residual_k1 = 0.0;
  double residual_k2 = 0.0;
  double camera_height_m = 0.0;

  // What the car itself covers, in the published image.
  std::string mask_file;
  std::string mask_polygon;
  int mask_top_rows = 0;
  int mask_bottom_rows = 0;
  int mask_feather_px = 8;

  // Live device.
  std::string device;
  std::string pixel_format = "auto";
  double rate_hz = 0.0;
  int num_buffers = 4;
  double stamp_offset_s = 0.0;
  double timeout_s = 1.0;
  std::string on_loss = "retry";
  double retry_min_s = 0.5;
  double retry_max_s = 10.0;

  // What counts as a sick image.
  double black_mean = 24.0;
  double flat_std = 3.0;
  int fault_frames = 3;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    visit_model(c, field);
    visit_mask(c, field);
    visit_device(c, field);
    field("camera.black_mean", c.black_mean, 0.0, 255.0, "a flat image not brighter is black");
    field("camera.flat_std", c.flat_std, 0.0, 128.0, "grey levels; less spread is a flat image");
    field("camera.fault_frames", c.fault_frames, 1, 1000,
          "frames in a row to raise or clear a fault");
  }

 private:
  template <typename Config, typename Visit>
  static void visit_model(Config& c, Visit&& field) {
    field("camera.width_px", c.width_px, 0, 8192, "captured width; 0: the source says");
    field("camera.height_px", c.height_px, 0, 8192, "captured height; 0: the source says");
    field("camera.fx_px", c.fx_px, 0.0, 1e5, "focal length along u; 0: the source says");
    field("camera.fy_px", c.fy_px, 0.0, 1e5, "focal length along v; 0: the source says");
    field("camera.cx_px", c.cx_px, 0.0, 8192.0, "principal point, (0,0) is a pixel centre");
    field("camera.cy_px", c.cy_px, 0.0, 8192.0, "principal point, (0,0) is a pixel centre");
    field("camera.distortion", c.distortion, {"plumb_bob", "fisheye"}, "lens model");
    field("camera.k1", c.k1, -10.0, 10.0, "radial, r^2 (fisheye: theta^2)");
    field("camera.k2", c.k2, -10.0, 10.0, "radial, r^4 (fisheye: theta^4)");
    field("camera.p1", c.p1, -1.0, 1.0, "tangential; plumb_bob only");
    field("camera.p2", c.p2, -1.0, 1.0, "tangential; plumb_bob only");
    field("camera.k3", c.k3, -10.0, 10.0, "radial, r^6 (fisheye: theta^6)");
    field("camera.k4", c.k4, -10.0, 10.0, "theta^8; fisheye only");
    field("camera.rectified_fx_px", c.rectified_fx_px, 0.0, 1e5, "published; 0: camera.fx_px");
    field("camera.rectified_fy_px", c.rectified_fy_px, 0.0, 1e5, "published; 0: camera.fy_px");
    field("camera.rectified_cx_px", c.rectified_cx_px, 0.0, 8192.0, "published; 0: camera.cx_px");
    field("camera.rectified_cy_px", c.rectified_cy_px, 0.0, 8192.0, "published; 0: camera.cy_px");
    field("camera.residual_k1", c.residual_k1, -0.1, 0.1,
          "radial term of r^2 left after rectification");
    field("camera.residual_k2", c.residual_k2, -0.1, 0.1, "the same, of r^4");
    field("camera.readout_s", c.readout_s, 0.0, 0.1,
          "rolling shutter: exposure of the last row after the first; 0: all rows at once");
    field("camera.camera_height_m", c.camera_height_m, 0.0, 4.0,
          "optical centre above the road, unloaded; 0: ground.camera_height_m");
  }

  template <typename Config, typename Visit>
  static void visit_mask(Config& c, Visit&& field) {
    field("camera.mask_file", c.mask_file, "PGM or PNG, non-zero is covered; beside this file");
    field("camera.mask_polygon", c.mask_polygon, "covered area: 'u,v u,v u,v ...' [px]");
    field("camera.mask_top_rows", c.mask_top_rows, 0, 8192, "covered rows at the top");
    field("camera.mask_bottom_rows", c.mask_bottom_rows, 0, 8192, "covered rows at the bottom");
    field("camera.mask_feather_px", c.mask_feather_px, 1, 64, "width of the blend around the mask");
  }

  template <typename Config, typename Visit>
  static void visit_device(Config& c, Visit&& field) {
    field("camera.device", c.device, "V4L2 device used when the command line names no source");
    field("camera.pixel_format", c.pixel_format, {"auto", "GREY", "YUYV", "NV12", "MJPG"},
          "format asked of the device");
    field("camera.rate_hz", c.rate_hz, 0.0, 240.0, "frame rate asked of the device; 0: its own");
    field("camera.num_buffers", c.num_buffers, 2, 32, "buffers shared with the driver");
    field("camera.stamp_offset_s", c.stamp_offset_s, -1.0, 1.0,
          "added to the driver's stamp to reach mid-exposure, of the middle row");
    field("camera.timeout_s", c.timeout_s, 0.1, 60.0, "silence of the device that is a fault");
    field("camera.on_loss", c.on_loss, {"retry", "exit"}, "when the device is gone");
    field("camera.retry_min_s", c.retry_min_s, 0.05, 60.0, "first pause before opening again");
    field("camera.retry_max_s", c.retry_max_s, 0.05, 600.0, "pauses double up to this");
  }
};

}  // namespace plumb
