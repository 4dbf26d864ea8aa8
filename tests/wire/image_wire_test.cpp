#include "modules/camera/image_wire.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <random>

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr int kWidth = 96;
constexpr int kHeight = 64;

Bytes encoded(const image_t& message) {
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

Bytes pattern() {
  Bytes pixels(static_cast<std::size_t>(kWidth * kHeight));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i * 7 / 3);
  return pixels;
}

image_t grey_message() {
  static const Bytes pixels = pattern();
  image_t message{};
  to_wire(123'456, 42, {pixels.data(), kWidth, kHeight, kWidth}, &message);
  return message;
}

image_t jpeg_message() {
  Bytes pixels = pattern();
  Bytes jpeg;
  cv::imencode(".jpg", cv::Mat(kHeight, kWidth, CV_8UC1, pixels.data()), jpeg);
  image_t message{};
  to_wire_jpeg(123'456, 42, kWidth, kHeight, jpeg, &message);
  return message;
}

// The reason why the changed message is refused when it is read and decoded.
std::string refusal(image_t message, const std::function<void(image_t*)>& change) {
  change(&message);
  const Bytes bytes = encoded(message);
  ImageFrame frame;
  if (const char* why = read_image(bytes, &frame)) return why;
  ImageDecoder decoder(kWidth, kHeight);
  ImageView view;
  const char* why = decoder.decode(frame, &view);
  return why == nullptr ? "" : why;
}

void set_metadata(image_t* m, const std::string& key, Bytes value) {
  m->metadata.resize(1);
  m->nmetadata = 1;
  m->metadata[0].key = key;
  m->metadata[0].n = static_cast<std::int32_t>(value.size());
  m->metadata[0].value = std::move(value);
}

TEST(ImageWire, CarriesAGreyImageWithoutTouchingItsPixels) {
  const Bytes bytes = encoded(grey_message());
  ASSERT_LE(bytes.size(), max_image_bytes(kWidth * kHeight));
  ImageFrame frame;
  ASSERT_EQ(nullptr, read_image(bytes, &frame));
  EXPECT_EQ(123'456, frame.capture_us);
  EXPECT_EQ(42, frame.seq);
  ImageDecoder decoder(kWidth, kHeight);
  ImageView view;
  ASSERT_EQ(nullptr, decoder.decode(frame, &view));
  const Bytes pixels = pattern();
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      ASSERT_EQ(pixels[static_cast<std::size_t>(v * kWidth + u)], view.at(u, v));
  EXPECT_GE(view.data, bytes.data());
  EXPECT_LT(view.data, bytes.data() + bytes.size());
}

TEST(ImageWire, PacksRowsThatHadGaps) {
  Bytes padded(static_cast<std::size_t>(100 * kHeight), 255);
  const Bytes pixels = pattern();
  for (std::size_t v = 0; v < kHeight; ++v)
    std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(v * kWidth), kWidth,
                padded.begin() + static_cast<std::ptrdiff_t>(v * 100));
  image_t message{};
  to_wire(1, 2, {padded.data(), kWidth, kHeight, 100}, &message);
  EXPECT_EQ(pixels, message.data);
}

TEST(ImageWire, ReadsRowsWithGaps) {
  EXPECT_EQ("", refusal(grey_message(), [](image_t* m) {
              m->row_stride = 100;
              m->data.resize(100 * kHeight);
              m->size = 100 * kHeight;
            }));
}

// Grey and colour, every subsampling that OpenCV writes, restart markers, progressive, odd sizes.
TEST(ImageWire, DecodesJpegLikeOpenCv) {
  std::mt19937 random(5);
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const cv::Size size : {cv::Size(96, 64), cv::Size(123, 77), cv::Size(641, 97)}) {
      cv::Mat image(size, type);
      for (auto i = 0; i < image.rows * image.cols * image.channels(); ++i)
        image.data[i] = static_cast<std::uint8_t>(i * 7 / 3 + static_cast<int>(random() % 32U));
      for (const int quality : {30, 75, 95, 100}) {
        for (const bool progressive : {false, true}) {
          Bytes jpeg;
          cv::imencode(".jpg", image, jpeg,
                       {cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_PROGRESSIVE,
                        progressive ? 1 : 0, cv::IMWRITE_JPEG_RST_INTERVAL, quality == 30 ? 4 : 0});
          JpegDecoder decoder(size.width, size.height);
          ImageView view;
          ASSERT_EQ(nullptr, decoder.decode(jpeg, &view));
          const cv::Mat expected = cv::imdecode(jpeg, cv::IMREAD_GRAYSCALE);
          for (int v = 0; v < size.height; ++v)
            ASSERT_EQ(
                0, std::memcmp(expected.ptr(v), view.row(v), static_cast<std::size_t>(size.width)))
                << "row " << v << " of " << size << ", quality " << quality;
        }
      }
    }
  }
}

TEST(ImageWire, RefusesContradictions) {
  const auto grey = [](const std::function<void(image_t*)>& change) {
    return refusal(grey_message(), change);
  };
  const std::string layout = "image data length, row stride and size contradict each other";
  EXPECT_EQ(layout, grey([](image_t* m) { m->row_stride = kWidth - 1; }));
  EXPECT_EQ(layout, grey([](image_t* m) { m->row_stride = -1; }));
  EXPECT_EQ(layout, grey([](image_t* m) { m->row_stride = 0x7FFFFFFF; }));
  EXPECT_EQ(layout, grey([](image_t* m) { m->height = kHeight + 1; }));
  EXPECT_EQ("image size is outside [1, 8192]", grey([](image_t* m) { m->width = -kWidth; }));
  EXPECT_EQ("image size is outside [1, 8192]", grey([](image_t* m) { m->height = 1 << 30; }));
  EXPECT_EQ("image size differs from the calibration", grey([](image_t* m) {
              m->width = kHeight;
              m->height = kWidth;
              m->row_stride = kHeight;
            }));
}

TEST(ImageWire, RefusesFormatsThatAreNotEightBitGrey) {
  for (const char* fourcc : {"RGB3", "Y16 ", "YUYV", "BA81"}) {
    std::int32_t format = 0;
    std::memcpy(&format, fourcc, 4);
    EXPECT_EQ("pixel format is neither 8-bit grey nor MJPEG",
              refusal(grey_message(), [format](image_t* m) { m->pixelformat = format; }))
        << fourcc;
  }
}

TEST(ImageWire, NeedsASequenceNumber) {
  const std::string none = "image has no sequence number ('seq' metadata)";
  EXPECT_EQ(none, refusal(grey_message(), [](image_t* m) {
              m->nmetadata = 0;
              m->metadata.clear();
            }));
  EXPECT_EQ(none, refusal(grey_message(), [](image_t* m) { set_metadata(m, "sec", Bytes(8)); }));
  EXPECT_EQ("image metadata 'seq' or 'session' is not 8 bytes",
            refusal(grey_message(), [](image_t* m) { set_metadata(m, "seq", Bytes(4)); }));
}

TEST(ImageWire, RefusesBrokenJpeg) {
  const auto jpeg = [](const std::function<void(image_t*)>& change) {
    return refusal(jpeg_message(), [&](image_t* m) {
      change(m);
      m->size = static_cast<std::int32_t>(m->data.size());
    });
  };
  EXPECT_EQ("", jpeg([](image_t* m) { m->data.resize(m->data.size() + 5); })) << "zero padding";
  EXPECT_EQ("JPEG is cut off", jpeg([](image_t* m) { m->data.resize(m->data.size() / 2); }));
  EXPECT_EQ("JPEG does not decode", jpeg([](image_t* m) {
              m->data.resize(m->data.size() / 2);
              m->data.insert(m->data.end(), {0xFF, 0xD9});
            }))
      << "its second half would be grey";
  EXPECT_EQ("compressed image is empty", jpeg([](image_t* m) { m->data.clear(); }));
  EXPECT_EQ("JPEG header contradicts the image", jpeg([](image_t* m) { m->data.assign(100, 0); }));
  // A header that claims 65535 x 65535 pixels would make the decoder allocate 4 GB.
  EXPECT_EQ("JPEG header contradicts the image", jpeg([](image_t* m) {
              for (std::size_t i = 2; i + 9 < m->data.size(); ++i)
                if (m->data[i] == 0xFF && m->data[i + 1] == 0xC0)
                  std::fill_n(m->data.begin() + static_cast<std::ptrdiff_t>(i) + 5, 4, 0xFF);
            }));
}

TEST(ImageWire, DecodesAfterABrokenJpegAsBefore) {
  const image_t message = jpeg_message();
  JpegDecoder decoder(kWidth, kHeight);
  std::mt19937 random(3);
  ImageView view;
  ASSERT_EQ(nullptr, decoder.decode(message.data, &view));
  const Bytes whole(view.data, view.data + kWidth * kHeight);
  int num_refused = 0;
  for (int i = 0; i < 2000; ++i) {
    Bytes noisy = message.data;
    for (int k = 0; k < 4; ++k)
      noisy[random() % noisy.size()] = static_cast<std::uint8_t>(random());
    if (decoder.decode(noisy, &view) != nullptr) ++num_refused;
    if (i % 100 != 0) continue;
    ASSERT_EQ(nullptr, decoder.decode(message.data, &view));
    ASSERT_EQ(whole, Bytes(view.data, view.data + kWidth * kHeight));
  }
  EXPECT_GT(num_refused, 100);
}

TEST(ImageWire, RefusesEveryTruncation) {
  const Bytes whole = encoded(jpeg_message());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    ImageFrame frame;
    ASSERT_NE(nullptr, read_image(std::span(whole).first(length), &frame)) << length;
  }
  Bytes longer = whole;
  longer.push_back(0);
  ImageFrame frame;
  EXPECT_STREQ("bytes follow the image", read_image(longer, &frame));
}

TEST(ImageWire, SurvivesHostileLengthsAndNoise) {
  const Bytes whole = encoded(grey_message());
  ImageFrame frame;
  ImageView view;
  ImageDecoder decoder(kWidth, kHeight);
  for (const std::uint32_t hostile : {0xFFFFFFFFU, 0x7FFFFFFFU, 0x80000000U, 0x40000000U}) {
    for (const std::size_t at : {std::size_t{32}, whole.size() - 24}) {  // size, nmetadata
      Bytes bytes = whole;
      for (std::size_t i = 0; i < 4; ++i)
        bytes[at + i] = static_cast<std::uint8_t>(hostile >> (24 - 8 * i));
      EXPECT_NE(nullptr, read_image(bytes, &frame)) << at;
    }
  }
  std::mt19937 random(11);
  const Bytes jpeg = encoded(jpeg_message());
  for (int i = 0; i < 5000; ++i) {
    Bytes noisy = i % 2 == 0 ? whole : jpeg;
    for (int k = 0; k < 3; ++k) noisy[random() % 60] = static_cast<std::uint8_t>(random());
    noisy[noisy.size() - 1 - random() % 28] = static_cast<std::uint8_t>(random());
    if (read_image(noisy, &frame) != nullptr) continue;
    EXPECT_NO_THROW((void)decoder.decode(frame, &view));
  }
}

TEST(CalibrationWire, RoundTrips) {
  const CameraModel camera{1242, 375, 721.5, 720.9, 609.6, 172.9, -0.002, 0.0004, 1.65, 0.02};
  CameraModel back;
  EXPECT_EQ(nullptr, from_wire(to_wire(camera, 5), &back));
  EXPECT_TRUE(same_camera(camera, back));
  back.readout_s = 0.0;
  EXPECT_FALSE(same_camera(camera, back));
  back = camera;
  back.camera_height_m = 0.0;
  EXPECT_FALSE(same_camera(camera, back));
  EXPECT_EQ(nullptr, from_wire(to_wire(back, 5), &back)) << "0 means that the height is unknown";
}

TEST(CalibrationWire, RefusesWhatIsNoCamera) {
  const CameraModel camera{1242, 375, 721.5, 720.9, 609.6, 172.9, 0.0, 0.0, 1.65};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const std::function<void(CameraModel*)>& change) {
    CameraModel bad = camera;
    change(&bad);
    CameraModel out;
    return from_wire(to_wire(bad, 0), &out) != nullptr;
  };
  EXPECT_FALSE(refused([](CameraModel*) {}));
  EXPECT_TRUE(refused([](CameraModel* c) { c->width_px = 63; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->height_px = -1; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->width_px = 100'000; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->fx_px = 0.0; }));
  EXPECT_TRUE(refused([=](CameraModel* c) { c->fy_px = nan; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->cx_px = 1242.0; }));
  EXPECT_TRUE(refused([=](CameraModel* c) { c->cy_px = nan; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->residual_k1 = 2.0; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->residual_k2 = -2.0; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->camera_height_m = 145.0; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->readout_s = -0.01; }));
  EXPECT_TRUE(refused([](CameraModel* c) { c->readout_s = 20.0; }));  // this would be milliseconds
  EXPECT_TRUE(refused([=](CameraModel* c) { c->camera_height_m = nan; }));
}

}  // namespace
}  // namespace plumb
