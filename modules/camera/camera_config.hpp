/// Every setting of plumb-camera; visit() is the only list of keys, ranges and meanings.
///
/// Frames:
///   img: u right, v down; (0,0) is the centre of the upper left pixel.
/// Model:
///   plumb_bob (k1 k2 p1 p2 k3) or fisheye (equidistant, k1 to k4), with OpenCV's coefficients. A
///   plumb_bob lens with every coefficient 0 means that the images are already rectified.
#pragma once

#include <string>

namespace plumb {

struct CameraConfig {
  // The captured image. A 0 is replaced by the value of the device or the folder.
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;

  // The distortion of the captured image.
  std::string distortion = "plumb_bob";
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;
  double k4 = 0.0;

  // The published pinhole camera. A 0 is replaced by the value of the captured image.
  double rectified_fx_px = 0.0;
  double rectified_fy_px = 0.0;
  double rectified_cx_px = 0.0;
  double rectified_cy_px = 0.0;

  double readout_s = 0.0;
  double residual_k1 = 0.0;
  double residual_k2 = 0.0;
  double camera_height_m = 0.0;

  // The part of the published image that the vehicle itself covers.
  std::string mask_file;
  std::string mask_polygon;
  int mask_top_rows = 0;
  int mask_bottom_rows = 0;
  int mask_feather_px = 8;

  // The live device.
  std::string device;
  std::string pixel_format = "auto";
  double rate_hz = 0.0;
  int num_buffers = 4;
  double stamp_offset_s = 0.0;
  double timeout_s = 1.0;
  std::string on_loss = "retry";
  double retry_min_s = 0.5;
  double retry_max_s = 10.0;

  // The limits of a faulty image.
  double black_mean = 24.0;
  double flat_std = 3.0;
  int fault_frames = 3;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    visit_model(c, field);
    visit_mask(c, field);
    visit_device(c, field);
    field("camera.black_mean", c.black_mean, 0.0, 255.0,
          "a flat image with at most this mean grey level is black");
    field("camera.flat_std", c.flat_std, 0.0, 128.0,
          "an image with a smaller standard deviation of its grey levels is flat");
    field("camera.fault_frames", c.fault_frames, 1, 1000,
          "number of consecutive frames that raise or clear a fault");
  }

 private:
  template <typename Config, typename Visit>
  static void visit_model(Config& c, Visit&& field) {
    field("camera.width_px", c.width_px, 0, 8192, "captured width; 0: that of the source");
    field("camera.height_px", c.height_px, 0, 8192, "captured height; 0: that of the source");
    field("camera.fx_px", c.fx_px, 0.0, 1e5, "focal length along u; 0: that of the source");
    field("camera.fy_px", c.fy_px, 0.0, 1e5, "focal length along v; 0: that of the source");
    field("camera.cx_px", c.cx_px, 0.0, 8192.0, "principal point, (0,0) is a pixel centre");
    field("camera.cy_px", c.cy_px, 0.0, 8192.0, "principal point, (0,0) is a pixel centre");
    field("camera.distortion", c.distortion, {"plumb_bob", "fisheye"}, "lens model");
    field("camera.k1", c.k1, -10.0, 10.0, "radial coefficient of r^2 (fisheye: theta^2)");
    field("camera.k2", c.k2, -10.0, 10.0, "radial coefficient of r^4 (fisheye: theta^4)");
    field("camera.p1", c.p1, -1.0, 1.0, "tangential coefficient; plumb_bob only");
    field("camera.p2", c.p2, -1.0, 1.0, "tangential coefficient; plumb_bob only");
    field("camera.k3", c.k3, -10.0, 10.0, "radial coefficient of r^6 (fisheye: theta^6)");
    field("camera.k4", c.k4, -10.0, 10.0, "coefficient of theta^8; fisheye only");
    field("camera.rectified_fx_px", c.rectified_fx_px, 0.0, 1e5,
          "focal length of the published image; 0: camera.fx_px");
    field("camera.rectified_fy_px", c.rectified_fy_px, 0.0, 1e5,
          "focal length of the published image; 0: camera.fy_px");
    field("camera.rectified_cx_px", c.rectified_cx_px, 0.0, 8192.0,
          "principal point of the published image; 0: camera.cx_px");
    field("camera.rectified_cy_px", c.rectified_cy_px, 0.0, 8192.0,
          "principal point of the published image; 0: camera.cy_px");
    field("camera.residual_k1", c.residual_k1, -0.1, 0.1,
          "radial coefficient of r^2 that rectification left in the image");
    field("camera.residual_k2", c.residual_k2, -0.1, 0.1,
          "radial coefficient of r^4 that rectification left in the image");
    field(
        "camera.readout_s", c.readout_s, 0.0, 0.1,
        "rolling shutter: time from the first row's exposure to the last row's; 0: global shutter");
    field(
        "camera.camera_height_m", c.camera_height_m, 0.0, 4.0,
        "height of the optical centre above the road, vehicle unloaded; 0: ground.camera_height_m");
  }

  template <typename Config, typename Visit>
  static void visit_mask(Config& c, Visit&& field) {
    field("camera.mask_file", c.mask_file,
          "PGM or PNG whose non-zero pixels are masked; relative to the folder of this file");
    field("camera.mask_polygon", c.mask_polygon, "masked area: 'u,v u,v u,v ...' [px]");
    field("camera.mask_top_rows", c.mask_top_rows, 0, 8192, "masked rows at the top");
    field("camera.mask_bottom_rows", c.mask_bottom_rows, 0, 8192, "masked rows at the bottom");
    field("camera.mask_feather_px", c.mask_feather_px, 1, 64, "width of the blend around the mask");
  }

  template <typename Config, typename Visit>
  static void visit_device(Config& c, Visit&& field) {
    field("camera.device", c.device, "V4L2 device used when the command line names no source");
    field("camera.pixel_format", c.pixel_format, {"auto", "GREY", "YUYV", "NV12", "MJPG"},
          "format requested of the device");
    field("camera.rate_hz", c.rate_hz, 0.0, 240.0,
          "frame rate requested of the device; 0: the rate that it has set");
    field("camera.num_buffers", c.num_buffers, 2, 32, "number of buffers shared with the driver");
    field("camera.stamp_offset_s", c.stamp_offset_s, -1.0, 1.0,
          "added to the driver's time stamp to get the mid-exposure time of the middle row");
    field("camera.timeout_s", c.timeout_s, 0.1, 60.0, "time without a frame that is a fault");
    field("camera.on_loss", c.on_loss, {"retry", "exit"}, "reaction to the loss of the device");
    field("camera.retry_min_s", c.retry_min_s, 0.05, 60.0,
          "pause before the first attempt to open a lost device");
    field("camera.retry_max_s", c.retry_max_s, 0.05, 600.0,
          "longest pause; pauses double up to it");
  }
};

}  // namespace plumb
