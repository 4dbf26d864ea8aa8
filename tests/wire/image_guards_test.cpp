// Tests the limits of what is accepted as an image, a JPEG header or a calibration: the last value
// inside and the first one outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "modules/camera/image_queue_config.hpp"
#include "modules/camera/image_wire.hpp"

namespace plumb {
namespace {

using Octets = std::vector<std::uint8_t>;
constexpr int kTinyWidth = 20;
constexpr int kTinyHeight = 10;
constexpr std::int64_t kSeq = 0x0102030405060708;
constexpr std::int64_t kSession = 0x1112131415161718;

image_t tiny_image(int width = kTinyWidth, int height = kTinyHeight) {
  const Octets pixels(static_cast<std::size_t>(width * height), 7);
  image_t message{};
  to_wire(5, kSeq, {pixels.data(), width, height, width}, &message, kSession);
  return message;
}

/// Null when the image is read, else why not.
const char* reading(const image_t& message, ImageFrame* frame) {
  static Octets bytes;
  bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return read_image(bytes, frame);
}

std::string refusal_of(const image_t& message) {
  ImageFrame frame;
  const char* why = reading(message, &frame);
  return why == nullptr ? "" : why;
}

image_metadata_t metadata(const std::string& key, std::size_t size) {
  image_metadata_t entry{};
  entry.key = key;
  entry.n = static_cast<std::int32_t>(size);
  entry.value.resize(size);
  return entry;
}

image_t with_metadata(const std::vector<image_metadata_t>& entries) {
  image_t message = tiny_image();
  message.metadata = entries;
  message.nmetadata = static_cast<std::int32_t>(entries.size());
  return message;
}

TEST(ImageGuards, CarriesNumberAndSessionToTheBit) {
  ImageFrame frame;
  const image_t message = tiny_image();
  EXPECT_EQ(2, message.nmetadata);
  EXPECT_EQ(kTinyWidth, message.row_stride);
  ASSERT_EQ(nullptr, reading(message, &frame));
  EXPECT_EQ(kSeq, frame.seq);
  EXPECT_EQ(kSession, frame.session);
  EXPECT_FALSE(frame.compressed);
  EXPECT_EQ(kTinyWidth, frame.width_px);
  EXPECT_EQ(kTinyHeight, frame.height_px);
  EXPECT_EQ(kTinyWidth, frame.row_stride_bytes);
}

TEST(ImageGuards, TakesASessionOnlyFromTheImageItself) {
  ImageFrame frame;
  frame.session = 99;
  ASSERT_EQ(nullptr, reading(with_metadata({metadata("seq", 8)}), &frame));
  EXPECT_EQ(0, frame.session);
  image_t message = tiny_image();
  std::swap(message.metadata[0], message.metadata[1]);
  ASSERT_EQ(nullptr, reading(message, &frame)) << "in any order";
  EXPECT_EQ(kSeq, frame.seq);
  EXPECT_EQ(kSession, frame.session);
}

TEST(ImageGuards, WritesNoSessionWithoutOne) {
  const Octets pixels(4, 7);
  image_t message{};
  to_wire(5, 6, {pixels.data(), 2, 2, 2}, &message, 0);
  EXPECT_EQ(1, message.nmetadata);
  EXPECT_EQ(std::size_t{1}, message.metadata.size());
  to_wire_jpeg(5, 6, 2, 2, pixels, &message);
  EXPECT_EQ(1, message.nmetadata);
  EXPECT_EQ(0, message.row_stride);
  EXPECT_EQ(4, message.size);
  EXPECT_EQ(5, message.utime);
}

TEST(ImageGuards, LimitsMetadata) {
  std::vector<image_metadata_t> entries(15, metadata("other", 3));
  entries.push_back(metadata("seq", 8));
  EXPECT_EQ("", refusal_of(with_metadata(entries)));
  entries.push_back(metadata("other", 0));
  EXPECT_EQ("image metadata does not decode", refusal_of(with_metadata(entries)));
  const std::string wrong_size = "image metadata 'seq' or 'session' is not 8 bytes";
  for (const std::size_t size : {7, 9}) {
    EXPECT_EQ(wrong_size, refusal_of(with_metadata({metadata("seq", size)})));
    EXPECT_EQ(wrong_size,
              refusal_of(with_metadata({metadata("seq", 8), metadata("session", size)})));
  }
  EXPECT_EQ("image has no sequence number ('seq' metadata)",
            refusal_of(with_metadata({metadata("session", 8)})));
  EXPECT_EQ("image has no sequence number ('seq' metadata)",
            refusal_of(with_metadata({metadata("seqq", 8), metadata("sea", 8)})));
}

TEST(ImageGuards, RefusesMetadataThatIsCutOff) {
  const image_t message = tiny_image();
  Octets bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  ImageFrame frame;
  for (std::size_t cut = 1; cut <= 40; ++cut) {
    const char* why = read_image(std::span(bytes).first(bytes.size() - cut), &frame);
    EXPECT_STREQ("image metadata does not decode", why) << cut;
  }
  const std::size_t count_at = 8 + 8 + 5 * 4 + message.data.size();
  ASSERT_EQ(2, bytes[count_at + 3]);
  bytes[count_at] = 0xFF;  // negative
  EXPECT_STREQ("image metadata does not decode", read_image(bytes, &frame));
  bytes[count_at - message.data.size() - 4] = 0xFF;  // negative length of the data
  EXPECT_STREQ("image data is cut off or its length is corrupt", read_image(bytes, &frame));
  bytes[0] ^= 1U;
  EXPECT_STREQ("not an image_t", read_image(bytes, &frame));
}

TEST(ImageGuards, LimitsTheSize) {
  const std::string outside = "image size is outside [1, 8192]";
  EXPECT_EQ("", refusal_of(tiny_image(8192, 1)));
  EXPECT_EQ("", refusal_of(tiny_image(1, 8192)));
  EXPECT_EQ("", refusal_of(tiny_image(1, 1)));
  EXPECT_EQ(outside, refusal_of(tiny_image(8193, 1)));
  EXPECT_EQ(outside, refusal_of(tiny_image(1, 8193)));
  image_t message = tiny_image();
  message.width = 0;
  EXPECT_EQ(outside, refusal_of(message));
  message = tiny_image();
  message.height = 0;
  EXPECT_EQ(outside, refusal_of(message));
}

TEST(ImageGuards, RefusesARowThatIsShorterThanTheImage) {
  image_t message = tiny_image();
  message.row_stride = kTinyWidth - 1;
  message.size = message.row_stride * kTinyHeight;
  message.data.resize(static_cast<std::size_t>(message.size));
  EXPECT_EQ("image data length, row stride and size contradict each other", refusal_of(message))
      << "although the length is that of such rows";
  message = tiny_image();
  message.size = 0;
  message.data.clear();
  message.row_stride = 0;
  EXPECT_NE("", refusal_of(message));
}

// ---- JPEG headers: what is refused before libjpeg sees it

/// A start of image, `segments`, and the header of a frame.
Octets jpeg_bytes(unsigned frame_marker, int width, int height, const Octets& segments = {}) {
  const auto high = [](int value) { return static_cast<std::uint8_t>(value >> 8); };
  const auto low = [](int value) { return static_cast<std::uint8_t>(value & 0xFF); };
  const std::array<std::uint8_t, 9> header = {0xFF,        static_cast<std::uint8_t>(frame_marker),
                                              0,           11,
                                              8,           high(height),
                                              low(height), high(width),
                                              low(width)};
  Octets bytes(2 + segments.size() + header.size());
  bytes[0] = 0xFF;
  bytes[1] = 0xD8;
  const auto end = std::copy(segments.begin(), segments.end(), bytes.begin() + 2);
  std::copy(header.begin(), header.end(), end);
  return bytes;
}

std::string jpeg_refusal(const Octets& bytes) {
  ImageFrame frame;
  frame.compressed = true;
  frame.width_px = 300;
  frame.height_px = 260;
  frame.data = bytes;
  ImageDecoder decoder(300, 260);
  ImageView view;
  const char* why = decoder.decode(frame, &view);
  return why == nullptr ? "" : why;
}

const std::string kContradicts = "JPEG header contradicts the image";
const std::string kCutOff = "JPEG is cut off";
const std::string kDamaged = "JPEG does not decode";

TEST(JpegGuards, ReadTheSizeFromEveryFrameHeader) {
  for (unsigned marker = 0xC0; marker <= 0xCF; ++marker) {
    const bool is_header = marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
    EXPECT_EQ(is_header ? kCutOff : kContradicts, jpeg_refusal(jpeg_bytes(marker, 300, 260)))
        << marker;
  }
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xBF, 300, 260)));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xD0, 300, 260)));
}

TEST(JpegGuards, CompareEveryByteOfTheSize) {
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 301, 260)));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 300, 261)));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 300 - 256, 260)));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 300, 260 - 256)));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 260, 300)));
}

TEST(JpegGuards, PassOverOtherSegments) {
  const Octets comment = {0xFF, 0xFE, 0x00, 0x04, 1, 2};
  Octets long_comment = {0xFF, 0xFE, 0x01, 0x02};
  long_comment.resize(4 + 256);
  EXPECT_EQ(kCutOff, jpeg_refusal(jpeg_bytes(0xC0, 300, 260, comment)));
  EXPECT_EQ(kCutOff, jpeg_refusal(jpeg_bytes(0xC2, 300, 260, long_comment)));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 300, 260, {0xFF, 0xFE, 0x00, 0x05, 1, 2})));
  EXPECT_EQ(kContradicts, jpeg_refusal(jpeg_bytes(0xC0, 300, 260, {0x00, 0xFE, 0x00, 0x04, 1, 2})));
}

TEST(JpegGuards, NeedTheWholeHeader) {
  const Octets whole = jpeg_bytes(0xC0, 300, 260);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Octets cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(kContradicts, jpeg_refusal(cut)) << size;
  }
  Octets other = whole;
  other[0] = 0xFE;
  EXPECT_EQ(kContradicts, jpeg_refusal(other));
  other = whole;
  other[1] = 0xD9;
  EXPECT_EQ(kContradicts, jpeg_refusal(other));
}

TEST(JpegGuards, NeedTheEndMarkerBeforeThePadding) {
  const auto ending = [](const Octets& end) {
    Octets bytes = jpeg_bytes(0xC0, 300, 260);
    bytes.insert(bytes.end(), end.begin(), end.end());
    return jpeg_refusal(bytes);
  };
  EXPECT_EQ(kDamaged, ending({0xFF, 0xD9}));
  EXPECT_EQ(kDamaged, ending({0xFF, 0xD9, 0, 0, 0}));
  EXPECT_EQ(kCutOff, ending({0xFF, 0xD9, 1}));
  EXPECT_EQ(kCutOff, ending({0xFF, 0xDA}));
  EXPECT_EQ(kCutOff, ending({0xFE, 0xD9}));
}

TEST(ImageDecoderGuards, ComparesTheSizeWithTheCalibration) {
  const ImageDecoder decoder(300, 260);
  ImageFrame frame;
  frame.width_px = 300;
  frame.height_px = 260;
  EXPECT_EQ(nullptr, decoder.check(frame));
  frame.width_px = 299;
  EXPECT_NE(nullptr, decoder.check(frame));
  frame.width_px = 300;
  frame.height_px = 261;
  EXPECT_NE(nullptr, decoder.check(frame));
}

// ---- Calibrations

const CameraModel kGoodCamera{1242, 375, 721.5, 720.9, 609.6, 172.9, -0.002, 0.0004, 1.65, 0.02};

std::string calibration_refusal(const std::function<void(CameraModel*)>& change) {
  CameraModel camera = kGoodCamera;
  change(&camera);
  CameraModel out;
  const char* why = from_wire(to_wire(camera, 5), &out);
  if (why != nullptr) return why;
  EXPECT_TRUE(same_camera(camera, out));
  return "";
}

/// A member is accepted from `low` to `high`, and refused `step` beyond, with its own reason.
template <typename T>
void expect_range(T CameraModel::*member, T low, T high, T step, const std::string& reason) {
  const auto with = [member](T value) {
    return calibration_refusal([&](CameraModel* camera) { camera->*member = value; });
  };
  EXPECT_EQ("", with(low)) << reason;
  EXPECT_EQ("", with(high)) << reason;
  EXPECT_NE(std::string::npos, with(low - step).find(reason)) << with(low - step);
  EXPECT_NE(std::string::npos, with(high + step).find(reason)) << with(high + step);
}

TEST(CalibrationGuards, KeepTheirRanges) {
  constexpr double kStep = 1e-9;
  expect_range(&CameraModel::fx_px, 1.0, 1e5, 1e-6, "focal length");
  expect_range(&CameraModel::fy_px, 1.0, 1e5, 1e-6, "focal length");
  expect_range(&CameraModel::cx_px, -0.5, 1241.5, kStep, "principal point");
  expect_range(&CameraModel::cy_px, -0.5, 374.5, kStep, "principal point");
  expect_range(&CameraModel::residual_k1, -0.5, 0.5, kStep, "k1");
  expect_range(&CameraModel::residual_k2, -0.5, 0.5, kStep, "k2");
  expect_range(&CameraModel::readout_s, 0.0, 0.1, kStep, "readout");
  expect_range(&CameraModel::camera_height_m, 0.3, 4.0, kStep, "camera height");
  EXPECT_EQ("", calibration_refusal([](CameraModel* c) { c->camera_height_m = 0.0; }));
}

TEST(CalibrationGuards, LimitTheSizeOfImages) {
  const auto sized = [](int width, int height) {
    return calibration_refusal([=](CameraModel* camera) {
      camera->width_px = width;
      camera->height_px = height;
      camera->cx_px = camera->cy_px = 30.0;
    });
  };
  const std::string outside = "calibration: image size is outside [64, 8192]";
  EXPECT_EQ("", sized(64, 64));
  EXPECT_EQ(outside, sized(63, 64));
  EXPECT_EQ(outside, sized(64, 63));
  EXPECT_EQ("", sized(8192, 64));
  EXPECT_EQ("", sized(64, 8192));
  EXPECT_EQ(outside, sized(8193, 64));
  EXPECT_EQ(outside, sized(64, 8193));
  static_assert(ImageQueueConfig::kMaxPixels == 1920 * 1200);
  EXPECT_EQ("", sized(1920, 1200));
  EXPECT_NE(std::string::npos, sized(1920, 1201).find("more pixels"));
  EXPECT_NE(std::string::npos, sized(8192, 8192).find("more pixels"));
}

TEST(CalibrationGuards, DifferInEveryParameter) {
  const std::vector<std::function<void(CameraModel*)>> changes = {[](CameraModel* c) { ++c->width_px; },
                                                                  [](CameraModel* c) { ++c->height_px; },
                                                                  [](CameraModel* c) { c->fx_px += 1; },
                                                                  [](CameraModel* c) { c->fy_px += 1; },
                                                                  [](CameraModel* c) { c->cx_px += 1; },
                                                                  [](CameraModel* c) { c->cy_px += 1; },
                                                                  [](CameraModel* c) { c->residual_k1 += 0.01; },
                                                                  [](CameraModel* c) { c->residual_k2 += 0.01; },
                                                                  [](CameraModel* c) { c->camera_height_m += 1; },
                                                                  [](CameraModel* c) { c->readout_s += 0.01; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CameraModel other = kGoodCamera;
    changes[i](&other);
    EXPECT_FALSE(same_camera(kGoodCamera, other)) << i;
  }
  EXPECT_TRUE(same_camera(kGoodCamera, kGoodCamera));
  EXPECT_EQ(5, to_wire(kGoodCamera, 5).utime);
}

}  // namespace
}  // namespace plumb
