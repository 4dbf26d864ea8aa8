#include "modules/datasets/kitti/png_image.hpp"

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/input_error.hpp"
#include "modules/datasets/file_bytes.hpp"

namespace plumb {
namespace {

constexpr std::uint8_t kSignature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t kChunkFrame = 12;  // length, type and checksum
constexpr int kMaxSide_px = 8192;

std::uint32_t big_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8U) | bytes[at + i];
  return value;
}

/// True when the list of chunks reaches its final IEND.
bool chunks_complete(std::span<const std::uint8_t> bytes) {
  std::size_t at = sizeof kSignature;
  while (at + kChunkFrame <= bytes.size()) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - kChunkFrame) return false;
    if (std::memcmp(bytes.data() + at + 4, "IEND", 4) == 0) return true;
    at += kChunkFrame + length;
  }
  return false;
}

}  // namespace

bool is_png(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= sizeof kSignature &&
         std::memcmp(bytes.data(), kSignature, sizeof kSignature) == 0;
}

const char* read_png_header(std::span<const std::uint8_t> bytes, PngHeader* header) {
  if (!is_png(bytes)) return bytes.empty() ? "is empty" : "is not a PNG image";
  if (!chunks_complete(bytes)) return "is cut off before the image ends";
  if (std::memcmp(bytes.data() + 12, "IHDR", 4) != 0 || bytes.size() < 33)
    return "has no PNG header";
  const std::uint32_t width = big_endian(bytes, 16);
  const std::uint32_t height = big_endian(bytes, 20);
  if (width == 0 || height == 0 || width > kMaxSide_px || height > kMaxSide_px) {
    return "has a size outside [1, 8192]";
  }
  *header = {static_cast<int>(width), static_cast<int>(height), bytes[24], bytes[25] != 0};
  return nullptr;
}

cv::Mat load_grey_png(const std::filesystem::path& path, bool colour_allowed) {
  return decode_grey_png(read_bytes(path), path, colour_allowed);
}

cv::Mat decode_grey_png(const std::vector<std::uint8_t>& bytes, const std::filesystem::path& path,
                        bool colour_allowed) {
  PngHeader header;
  if (const char* why = read_png_header(bytes, &header))
    throw InputError(path.string() + " " + why);
  if (header.bits_per_channel != 8) {
    throw InputError(path.string() + " has " + std::to_string(header.bits_per_channel) +
                     " bits per channel, expected 8");
  }
  if (header.colour && !colour_allowed) {
    throw InputError(path.string() +
                     " is a colour image; --camera 2 takes image_2 and converts it");
  }
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, header.colour ? cv::IMREAD_COLOR : cv::IMREAD_GRAYSCALE);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.cols != header.width_px || image.rows != header.height_px) {
    throw InputError(path.string() + " is corrupt: its pixels do not decode");
  }
  if (!header.colour) return image;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

}  // namespace plumb
