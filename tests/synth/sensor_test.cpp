#include "tools/synth/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/synth/synth_config.hpp"

namespace plumb::synth {
namespace {

RenderedFrame grey_frame(float radiance) {
  RenderedFrame frame;
  frame.width_px = 200;
  frame.height_px = 100;
  frame.radiance.assign(20000, radiance);
  return frame;
}

TEST(Sensor, NoiseHasTheConfiguredVariance) {
  SensorConfig config;
  config.vignetting = 0.0;
  config.gain_drift = 0.0;
  config.gain = 100.0;
  config.read_noise = 2.0;
  config.shot_noise = 0.05;
  Sensor sensor(config);
  std::vector<std::uint8_t> bytes;
  sensor.develop(grey_frame(1.0F), 0.0, 3, 1.0, bytes);
  double sum = 0.0;
  double square = 0.0;
  for (const std::uint8_t b : bytes) {
    sum += b;
    square += static_cast<double>(b) * b;
  }
  const double n = static_cast<double>(bytes.size());
  const double mean = sum / n;
  EXPECT_NEAR(mean, 100.0, 0.1);
  EXPECT_NEAR(square / n - mean * mean, 4.0 + 5.0 + 1.0 / 12.0, 0.4);
}

TEST(Sensor, FramesHaveDifferentNoiseAndTheSameFrameTheSame) {
  Sensor sensor(SensorConfig{});
  std::vector<std::uint8_t> a;
  std::vector<std::uint8_t> b;
  std::vector<std::uint8_t> c;
  sensor.develop(grey_frame(0.3F), 0.0, 1, 1.0, a);
  sensor.develop(grey_frame(0.3F), 0.0, 1, 1.0, b);
  sensor.develop(grey_frame(0.3F), 0.0, 2, 1.0, c);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
}

TEST(Sensor, BlurKeepsTheLightAndSpreadsIt) {
  SensorConfig config;
  config.vignetting = 0.0;
  config.gain_drift = 0.0;
  config.gain = 200.0;
  config.read_noise = 0.0;
  config.shot_noise = 0.0;
  config.blur_px = 0.8;
  RenderedFrame frame = grey_frame(0.0F);
  frame.radiance[50 * 200 + 100] = 1.0F;
  Sensor sensor(config);
  std::vector<std::uint8_t> bytes;
  sensor.develop(frame, 0.0, 0, 1.0, bytes);
  double sum = 0.0;
  for (const std::uint8_t b : bytes) sum += b;
  EXPECT_NEAR(sum, 200.0, 5.0);
  EXPECT_NEAR(bytes[50 * 200 + 100], 200.0 / (2.0 * 3.14159 * 0.64), 3.0);
}

TEST(Sensor, ExposureStepsBackAndForth) {
  SensorConfig config;
  config.gain_drift = 0.0;
  config.step_factor = 2.0;
  config.step_every_s = 1.0;
  const Sensor sensor(config);
  EXPECT_DOUBLE_EQ(sensor.exposure(0.5), 1.0);
  EXPECT_DOUBLE_EQ(sensor.exposure(1.5), 2.0);
  EXPECT_DOUBLE_EQ(sensor.exposure(2.5), 1.0);
}

TEST(DarkSpan, FadesInAndOut) {
  const DarkSpan tunnel{2.0, 6.0, 0.1, 1.0};
  EXPECT_DOUBLE_EQ(tunnel.factor(1.0), 1.0);
  EXPECT_NEAR(tunnel.factor(2.5), 0.55, 1e-9);
  EXPECT_NEAR(tunnel.factor(4.0), 0.1, 1e-9);
  EXPECT_DOUBLE_EQ(tunnel.factor(7.0), 1.0);
  EXPECT_DOUBLE_EQ(DarkSpan{}.factor(0.0), 1.0);
}

}  // namespace
}  // namespace plumb::synth
