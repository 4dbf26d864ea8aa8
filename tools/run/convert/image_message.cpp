#include "tools/run/convert/image_message.hpp"

#include <glib.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "tools/run/convert/byte_cursor.hpp"

namespace plumb {
namespace {

using Bytes = std::span<const std::uint8_t>;
constexpr const char* kBroken = "a message is not of its type";
constexpr const char* kUnreadable = "an image cannot be decoded";

const char* decode_picture(Bytes bytes, cv::Mat* grey) {
  if (bytes.empty()) return kUnreadable;
  const cv::Mat packed(1, static_cast<int>(bytes.size()), CV_8U,
                       const_cast<std::uint8_t*>(bytes.data()));
  try {
    *grey = cv::imdecode(packed, cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    return kUnreadable;
  }
  return grey->empty() ? kUnreadable : nullptr;
}

/// Begins a ROS message: its encapsulation, then the time stamp and frame of its header.
std::optional<ByteCursor> begin_cdr(Bytes data, std::int64_t* stamp_us) {
  if (data.size() < 4 || data[1] != 1) return {};  // little-endian CDR
  ByteCursor cursor(data.subspan(4));
  const auto seconds = static_cast<std::int32_t>(cursor.number(4));
  *stamp_us =
      std::int64_t{seconds} * 1'000'000 + static_cast<std::int64_t>(cursor.number(4) / 1000);
  (void)cursor.text();
  cursor.align(4);
  return cursor;
}

/// The text of a ROS message, which ends with a zero.
std::string ros_text(ByteCursor* cursor) {
  std::string text(cursor->text());
  while (!text.empty() && text.back() == '\0') text.pop_back();
  return text;
}

const char* read_ros_compressed(Bytes data, StampedImage* image) {
  auto cursor = begin_cdr(data, &image->stamp_us);
  if (!cursor) return kBroken;
  (void)cursor->text();  // the format, which the bytes tell, too
  cursor->align(4);
  const Bytes picture = cursor->blob();
  return cursor->ok() ? decode_picture(picture, &image->grey) : kBroken;
}

const char* read_ros_image(Bytes data, StampedImage* image) {
  auto cursor = begin_cdr(data, &image->stamp_us);
  if (!cursor) return kBroken;
  const std::uint64_t height = cursor->number(4), width = cursor->number(4);
  const std::string encoding = ros_text(&*cursor);
  (void)cursor->number(1);
  cursor->align(4);
  const std::uint64_t step = cursor->number(4);
  const Bytes pixels = cursor->blob();
  const int channels = encoding == "mono8" ? 1 : encoding == "bgr8" || encoding == "rgb8" ? 3 : 0;
  if (channels == 0) return "an image has another encoding than mono8, rgb8 and bgr8";
  constexpr std::uint64_t kMaxSide = 16384;
  if (!cursor->ok() || width == 0 || height == 0 || width > kMaxSide || height > kMaxSide ||
      step < width * static_cast<std::uint64_t>(channels) || step > 8 * kMaxSide ||
      pixels.size() < step * height)
    return kBroken;
  const cv::Mat view(static_cast<int>(height), static_cast<int>(width), CV_8UC(channels),
                     const_cast<std::uint8_t*>(pixels.data()), static_cast<std::size_t>(step));
  if (channels == 1) {
    image->grey = view.clone();
  } else {
    cv::cvtColor(view, image->grey, encoding == "bgr8" ? cv::COLOR_BGR2GRAY : cv::COLOR_RGB2GRAY);
  }
  return nullptr;
}

const char* read_foxglove_json(Bytes data, StampedImage* image) {
  const auto json = nlohmann::json::parse(data.begin(), data.end(), nullptr, false);
  try {
    const auto& stamp = json.at("timestamp");
    image->stamp_us = stamp.at("sec").get<std::int64_t>() * 1'000'000 +
                      stamp.at("nsec").get<std::int64_t>() / 1000;
    gsize size = 0;
    const std::unique_ptr<guchar, decltype(&g_free)> bytes(
        g_base64_decode(json.at("data").get_ref<const std::string&>().c_str(), &size), &g_free);
    return decode_picture({bytes.get(), size}, &image->grey);
  } catch (const nlohmann::json::exception&) {
    return kBroken;
  }
}

/// One field of a Protobuf message.
struct ProtoField {
  std::uint64_t number = 0;
  std::uint64_t value = 0;  ///< of a varint
  Bytes bytes;              ///< of a field with a length
};

std::uint64_t varint(ByteCursor* cursor) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const std::uint64_t byte = cursor->number(1);
    value |= (byte & 0x7FU) << shift;
    if ((byte & 0x80U) == 0) break;
  }
  return value;
}

bool next_field(ByteCursor* cursor, ProtoField* field) {
  if (cursor->at_end()) return false;
  const std::uint64_t key = varint(cursor);
  *field = {key >> 3U, 0, {}};
  switch (key & 7U) {
    case 0:
      field->value = varint(cursor);
      break;
    case 1:
      (void)cursor->take(8);
      break;
    case 2:
      field->bytes = cursor->take(varint(cursor));
      break;
    case 5:
      (void)cursor->take(4);
      break;
    default:
      return false;
  }
  return cursor->ok();
}

const char* read_foxglove_protobuf(Bytes data, StampedImage* image) {
  Bytes picture;
  ByteCursor cursor(data);
  for (ProtoField field; next_field(&cursor, &field);) {
    if (field.number == 2) picture = field.bytes;
    if (field.number != 1) continue;
    ByteCursor stamp(field.bytes);
    for (ProtoField part; next_field(&stamp, &part);) {
      const auto value = static_cast<std::int64_t>(part.value);
      image->stamp_us += part.number == 1 ? value * 1'000'000 : part.number == 2 ? value / 1000 : 0;
    }
  }
  return cursor.ok() && cursor.at_end() ? decode_picture(picture, &image->grey) : kBroken;
}

using Read = const char* (*)(Bytes, StampedImage*);
struct Kind {
  const char* schema;
  const char* encoding;
  Read read;
};
constexpr Kind kKinds[] = {
    {"sensor_msgs/msg/CompressedImage", "cdr", read_ros_compressed},
    {"sensor_msgs/msg/Image", "cdr", read_ros_image},
    {"foxglove.CompressedImage", "json", read_foxglove_json},
    {"foxglove.CompressedImage", "protobuf", read_foxglove_protobuf},
};

Read reader_of(const McapChannel& channel) {
  for (const Kind& kind : kKinds) {
    if (channel.schema == kind.schema && channel.encoding == kind.encoding) return kind.read;
  }
  return nullptr;
}

}  // namespace

bool has_images(const McapChannel& channel) { return reader_of(channel) != nullptr; }

const char* read_image_message(const McapChannel& channel, std::span<const std::uint8_t> data,
                               StampedImage* image) {
  image->stamp_us = 0;
  return reader_of(channel)(data, image);
}

}  // namespace plumb
