/// Tests that camera topics in MCAP files are read: every type of image, every compression of
/// chunks, and damage.
#include "tools/run/convert/mcap_source.hpp"

#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zstd.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/input_error.hpp"
#include "tests/camera/pattern.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/kitti_folder.hpp"
#include "tests/support/temp_folder.hpp"
#include "tools/run/convert/mcap_reader.hpp"
#include "tools/run/export/cdr_writer.hpp"
#include "tools/run/export/foxglove_types.hpp"

namespace plumb {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::int64_t kStart_us = 1'700'000'000'123'456;
constexpr int kNumImages = 6;
const Bytes kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

void put(std::uint64_t value, int size, Bytes* out) {
  for (int i = 0; i < size; ++i) out->push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}
void put_text(const std::string& text, Bytes* out) {
  put(text.size(), 4, out);
  out->insert(out->end(), text.begin(), text.end());
}
void put_record(std::uint8_t opcode, const Bytes& content, Bytes* out) {
  out->push_back(opcode);
  put(content.size(), 8, out);
  out->insert(out->end(), content.begin(), content.end());
}

/// What a recorder writes: a type, a topic, messages in chunks of two, and no summary.
class Bag {
 public:
  Bag(const std::string& compression, const std::string& schema, const std::string& encoding)
      : compression_(compression) {
    bytes_ = kMagic;
    add_channel(1, "/other", "std_msgs/msg/String", "cdr");
    add_channel(7, "/camera", schema, encoding);
  }
  void add_channel(std::uint16_t number, const std::string& topic, const std::string& schema,
                   const std::string& encoding) {
    Bytes content;
    put(number, 2, &content);
    put_text(schema, &content);
    put_text("", &content);
    put_text("", &content);
    put_record(0x03, content, &bytes_);
    content.clear();
    put(number, 2, &content);
    put(number, 2, &content);
    put_text(topic, &content);
    put_text(encoding, &content);
    put(0, 4, &content);
    put_record(0x04, content, &bytes_);
  }
  void add(std::uint16_t channel, const Bytes& message) {
    Bytes content;
    put(channel, 2, &content);
    put(0, 4 + 8 + 8, &content);
    content.insert(content.end(), message.begin(), message.end());
    put_record(0x05, content, &chunk_);
    if (++num_in_chunk_ == 2) end_chunk();
  }
  [[nodiscard]] std::string finished() {
    end_chunk();
    put_record(0x0F, Bytes(4), &bytes_);
    Bytes footer;
    put(0, 20, &footer);
    put_record(0x02, footer, &bytes_);
    bytes_.insert(bytes_.end(), kMagic.begin(), kMagic.end());
    return {bytes_.begin(), bytes_.end()};
  }

 private:
  void end_chunk() {
    if (num_in_chunk_ == 0) return;
    Bytes packed = chunk_;
    if (compression_ == "zstd") {
      packed.resize(ZSTD_compressBound(chunk_.size()));
      packed.resize(ZSTD_compress(packed.data(), packed.size(), chunk_.data(), chunk_.size(), 3));
    } else if (compression_ == "lz4") {
      packed.resize(LZ4F_compressFrameBound(chunk_.size(), nullptr));
      packed.resize(
          LZ4F_compressFrame(packed.data(), packed.size(), chunk_.data(), chunk_.size(), nullptr));
    }
    Bytes content;
    put(0, 16, &content);
    put(chunk_.size(), 8, &content);
    put(0, 4, &content);
    put_text(compression_, &content);
    put(packed.size(), 8, &content);
    content.insert(content.end(), packed.begin(), packed.end());
    put_record(0x06, content, &bytes_);
    chunk_.clear();
    num_in_chunk_ = 0;
  }
  std::string compression_;
  Bytes bytes_, chunk_;
  int num_in_chunk_ = 0;
};

std::int64_t stamp_us(int i) { return kStart_us + 50'000 * i; }

Bytes png(int i) {
  Bytes bytes;
  cv::imencode(".png", test::test_image(i), bytes);
  return bytes;
}

CdrWriter ros_header(int i) {
  CdrWriter out;
  out.i32(static_cast<std::int32_t>(stamp_us(i) / 1'000'000));
  out.u32(static_cast<std::uint32_t>(stamp_us(i) % 1'000'000 * 1000));
  out.text("camera_link");
  return out;
}

Bytes ros_compressed(int i) {
  CdrWriter out = ros_header(i);
  out.text("png");
  out.blob(png(i));
  return out.bytes();
}

/// Colour whose channels are equal, with gaps between its rows.
Bytes ros_image(int i) {
  cv::Mat colour;
  cv::cvtColor(test::test_image(i), colour, cv::COLOR_GRAY2BGR);
  const auto step = static_cast<std::uint32_t>(3 * colour.cols + 5);
  Bytes pixels(static_cast<std::size_t>(step) * static_cast<std::size_t>(colour.rows));
  for (int row = 0; row < colour.rows; ++row)
    std::copy_n(colour.ptr(row), 3 * colour.cols, pixels.begin() + row * static_cast<int>(step));
  CdrWriter out = ros_header(i);
  out.u32(static_cast<std::uint32_t>(colour.rows));
  out.u32(static_cast<std::uint32_t>(colour.cols));
  out.text("bgr8");
  out.u8(0);
  out.u32(step);
  out.blob(pixels);
  return out.bytes();
}

Bytes foxglove_json(int i) {
  const std::string text = nlohmann::json{
      {"timestamp", foxglove::time(stamp_us(i))},
      {"frame_id", "camera"},
      {"data", foxglove::base64(png(i))},
      {"format", "png"}}.dump();
  return {text.begin(), text.end()};
}

void put_varint(std::uint64_t value, Bytes* out) {
  for (; value >= 0x80; value >>= 7) out->push_back(static_cast<std::uint8_t>(value | 0x80));
  out->push_back(static_cast<std::uint8_t>(value));
}
void put_field(int number, const Bytes& content, Bytes* out) {
  put_varint(static_cast<std::uint64_t>(number) << 3 | 2, out);
  put_varint(content.size(), out);
  out->insert(out->end(), content.begin(), content.end());
}

Bytes foxglove_protobuf(int i) {
  Bytes stamp, out;
  put_varint(1 << 3, &stamp);
  put_varint(static_cast<std::uint64_t>(stamp_us(i) / 1'000'000), &stamp);
  put_varint(2 << 3, &stamp);
  put_varint(static_cast<std::uint64_t>(stamp_us(i) % 1'000'000 * 1000), &stamp);
  put_field(1, stamp, &out);
  put_field(4, {'c', 'a', 'm'}, &out);
  put_field(2, png(i), &out);
  put_field(3, {'p', 'n', 'g'}, &out);
  return out;
}

struct Kind {
  const char* schema;
  const char* encoding;
  Bytes (*message)(int);
};
const Kind kKinds[] = {{"sensor_msgs/msg/CompressedImage", "cdr", ros_compressed},
                       {"sensor_msgs/msg/Image", "cdr", ros_image},
                       {"foxglove.CompressedImage", "json", foxglove_json},
                       {"foxglove.CompressedImage", "protobuf", foxglove_protobuf}};

std::string bag_of(const Kind& kind, const std::string& compression) {
  Bag bag(compression, kind.schema, kind.encoding);
  for (int i = 0; i < kNumImages; ++i) {
    bag.add(1, {0, 1, 0, 0, 2, 0, 0, 0, 'x', 0});
    bag.add(7, kind.message(i));
  }
  return bag.finished();
}

TEST(McapSource, ReadsEveryTypeAndCompressionToThePixel) {
  const test::TempFolder folder;
  for (const Kind& kind : kKinds) {
    for (const char* compression : {"", "zstd", "lz4"}) {
      SCOPED_TRACE(std::string(kind.schema) + " " + kind.encoding + " " + compression);
      McapSource source(folder.write("bag.mcap", bag_of(kind, compression)), "");
      GreyFrame frame;
      for (int i = 0; i < kNumImages; ++i) {
        ASSERT_TRUE(source.read(&frame));
        EXPECT_EQ(frame.seq, i);
        EXPECT_EQ(frame.capture_us, stamp_us(i));
        test::expect_pixels(frame.image, test::test_image(i));
      }
      EXPECT_FALSE(source.read(&frame));
    }
  }
}

TEST(McapSource, SaysWhichTopicsHaveImages) {
  const test::TempFolder folder;
  Bag bag("", "foxglove.CompressedImage", "json");
  bag.add_channel(9, "/rear", "sensor_msgs/msg/CompressedImage", "cdr");
  bag.add(7, foxglove_json(0));
  bag.add(9, ros_compressed(1));
  const std::string path = folder.write("bag.mcap", bag.finished());
  GreyFrame frame;
  EXPECT_TRUE(McapSource(path, "/rear").read(&frame));
  EXPECT_EQ(frame.capture_us, stamp_us(1));
  test::expect_contains(test::input_error_of([&] { McapSource(path, ""); }), "/camera, /rear");
  test::expect_contains(test::input_error_of([&] { McapSource(path, "/front"); }),
                        "/camera, /rear");
  const std::string none =
      folder.write("none.mcap", Bag("", "sensor_msgs/msg/Imu", "cdr").finished());
  test::expect_contains(test::input_error_of([&] { McapSource(none, ""); }),
                        "no topic with images");
}

TEST(McapSource, DamageEndsInASentence) {
  const test::TempFolder folder;
  for (const Kind& kind : kKinds) {
    const std::string whole = bag_of(kind, "");
    int num_refused = 0;
    for (std::size_t k = 1; k <= 60; ++k) {
      std::string damaged = whole;
      if (k % 2 == 0) {
        damaged.resize(whole.size() * k / 61);
      } else {  // seven wrong bytes, often in a length
        for (std::size_t i = 0; i < 7; ++i) damaged[(k * 7919 + i * 13) % whole.size()] ^= '\x5a';
      }
      try {
        McapSource source(folder.write("bag.mcap", damaged), "");
        GreyFrame frame;
        int num_frames = 0;
        while (source.read(&frame)) ++num_frames;
        EXPECT_LE(num_frames, kNumImages);
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("bag.mcap"), std::string::npos) << error.what();
        ++num_refused;
      }
    }
    EXPECT_GE(num_refused, 30) << "a file that is cut off is always refused";
  }
}

TEST(McapSource, AChunkTakesNoMoreMemoryThanItCanHold) {
  const test::TempFolder folder;
  for (const char* compression : {"", "zstd", "lz4"}) {
    Bytes chunk;
    put(0, 8, &chunk);
    put(0, 8, &chunk);
    put(1U << 30U, 8, &chunk);  // its size, unpacked
    put(0, 4, &chunk);
    put_text(compression, &chunk);
    put(3, 8, &chunk);
    put(0, 3, &chunk);
    Bytes file = kMagic;
    put_record(0x06, chunk, &file);
    const auto path = folder.write("bag.mcap", {file.begin(), file.end()});
    McapReader reader(path);
    McapMessage message;
    test::expect_contains(test::input_error_of([&] { (void)reader.next(&message); }),
                          "a chunk states more than it holds");
  }
}

}  // namespace
}  // namespace plumb
