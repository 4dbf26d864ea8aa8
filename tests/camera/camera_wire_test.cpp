#include "modules/camera/camera_wire.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace plumb {
namespace {

// Not inlined: gcc 12 then takes lcm-gen's msg_hash for uninitialised.
[[gnu::noinline]] int decode(const std::vector<std::uint8_t>& bytes, image_t* message) {
  return message->decode(bytes.data(), 0, static_cast<int>(bytes.size()));
}

TEST(CameraWire, AnImageSurvivesTheRoundTrip) {
  ImageMessage message(32, 20);
  for (std::size_t i = 0; i < 32 * 20; ++i) message.pixels()[i] = static_cast<std::uint8_t>(i * 7);
  const image_t& sent = message.stamped(123'456'789, 42);
  std::vector<std::uint8_t> bytes(message.encoded_bytes());
  ASSERT_EQ(sent.encode(bytes.data(), 0, static_cast<int>(bytes.size())),
            static_cast<int>(bytes.size()));

  image_t received;
  ASSERT_EQ(decode(bytes, &received), static_cast<int>(bytes.size()));
  EXPECT_EQ(received.utime, 123'456'789);
  EXPECT_EQ(received.width, 32);
  EXPECT_EQ(received.height, 20);
  EXPECT_EQ(received.row_stride, 32);
  EXPECT_EQ(received.pixelformat, image_t::PIXEL_FORMAT_GRAY);
  EXPECT_EQ(received.data, sent.data);
  std::int64_t seq = -1;
  ASSERT_TRUE(read_seq(received, &seq));
  EXPECT_EQ(seq, 42);
}

TEST(CameraWire, SequenceNumbersAreEightBytesBigEndian) {
  ImageMessage message(16, 16);
  const image_t& stamped = message.stamped(0, 0x0102'0304'0506'0708);
  EXPECT_EQ(stamped.metadata[0].key, "seq");
  EXPECT_EQ(stamped.metadata[0].value, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  for (const std::int64_t seq :
       {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::max(),
        std::numeric_limits<std::int64_t>::min()}) {
    std::int64_t read = 99;
    ASSERT_TRUE(read_seq(message.stamped(0, seq), &read));
    EXPECT_EQ(read, seq);
  }
}

TEST(CameraWire, AnImageWithoutASequenceNumberSaysSo) {
  image_t message{};
  std::int64_t seq = 7;
  EXPECT_FALSE(read_seq(message, &seq));
  message.metadata.resize(2);
  message.metadata[0].key = "exposure";
  message.metadata[0].value.resize(8);
  message.metadata[1].key = "seq";
  message.metadata[1].value.resize(4);
  EXPECT_FALSE(read_seq(message, &seq));
  EXPECT_EQ(seq, 7);
}

TEST(CameraWire, CalibrationCarriesEveryField) {
  CameraModel model;
  model.width_px = 1241;
  model.height_px = 376;
  model.fx_px = 718.1;
  model.fy_px = 718.2;
  model.cx_px = 607.3;
  model.cy_px = 185.4;
  model.residual_k1 = -0.002;
  model.camera_height_m = 1.65;
  const camera_calibration_t message = to_wire(model, 55);
  EXPECT_EQ(message.utime, 55);
  EXPECT_EQ(message.width, 1241);
  EXPECT_EQ(message.height, 376);
  EXPECT_EQ(message.fx_px, 718.1);
  EXPECT_EQ(message.fy_px, 718.2);
  EXPECT_EQ(message.cx_px, 607.3);
  EXPECT_EQ(message.cy_px, 185.4);
  EXPECT_EQ(message.residual_k1, -0.002);
  EXPECT_EQ(message.camera_height_m, 1.65);
}

}  // namespace
}  // namespace plumb
