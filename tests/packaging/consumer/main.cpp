// Runs the visual odometry on a textured plane that comes nearer, and passes its result through a
// message. Prints the message's number and whether the motion was measured.
#include <cmath>
#include <cstdio>
#include <vector>

#include "modules/vo/vo.hpp"
#include "modules/vo/vo_wire.hpp"

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kNumImages = 12;

/// A road of irregular blots 1.5 m under a camera that moves 0.8 m ahead per image, below a wall.
std::vector<std::uint8_t> picture(const plumb::CameraModel& camera, double travelled_m) {
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(kWidth * kHeight));
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const Eigen::Vector3d ray = camera.unproject({u, v});
      const double depth_m = ray.y() > 0.02 ? 1.5 / ray.y() : 60.0 - travelled_m;
      const double x = ray.x() * depth_m;
      const double z = depth_m + travelled_m + 7.0 * ray.y() * depth_m;
      const double blots =
          std::sin(2.1 * x + 1.3 * std::sin(0.9 * z)) * std::sin(1.7 * z + std::sin(1.1 * x));
      grey[static_cast<std::size_t>(v * kWidth + u)] =
          static_cast<std::uint8_t>(128.0 + 90.0 * blots);
    }
  }
  return grey;
}

}  // namespace

int main() {
  plumb::CameraModel camera;
  camera.width_px = kWidth;
  camera.height_px = kHeight;
  camera.fx_px = camera.fy_px = 500.0;
  camera.cx_px = 319.5;
  camera.cy_px = 239.5;
  plumb::VisualOdometry odometry(plumb::VoConfig{}, camera, 1);
  plumb::NullProbe probe;
  plumb::vo_motion_t message{};
  for (int i = 0; i < kNumImages; ++i) {
    const std::vector<std::uint8_t> grey = picture(camera, 0.8 * i);
    const plumb::VoOutput& output =
        odometry.update({100'000 * (i + 1), i, {grey.data(), kWidth, kHeight, kWidth}}, probe);
    to_wire(output, &message);
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  plumb::vo_motion_t back{};
  if (back.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return 1;
  const bool measured = back.status == plumb::vo_motion_t::STATUS_OK;
  std::printf("image %lld, %s\n", static_cast<long long>(back.seq),
              measured ? "measured" : "not measured");
  return measured ? 0 : 1;
}
