#include "modules/datasets/folder/grey_image.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/input_error.hpp"
#include "modules/datasets/file_bytes.hpp"
#include "modules/datasets/kitti/png_image.hpp"

namespace plumb {
namespace {

constexpr std::uint8_t kMarker = 0xFF;
constexpr std::uint8_t kStartOfScan = 0xDA;
constexpr std::array<std::uint8_t, 2> kJpegBegin{kMarker, 0xD8};
constexpr std::array<std::uint8_t, 2> kJpegEnd{kMarker, 0xD9};

/// Where the pixels of a JPEG begin. The segments before them are passed over by their lengths,
/// because the preview in an EXIF segment is a JPEG with an end of its own.
std::size_t find_pixels(const std::vector<std::uint8_t>& jpeg) {
  std::size_t at = kJpegBegin.size();
  while (at + 4 <= jpeg.size() && jpeg[at] == kMarker && jpeg[at + 1] != kStartOfScan)
    at += 2 + (static_cast<std::size_t>(jpeg[at + 2]) << 8U | jpeg[at + 3]);
  return std::min(at, jpeg.size());
}

bool is_cut_off_jpeg(const std::vector<std::uint8_t>& bytes) {
  const bool is_jpeg = bytes.size() >= kJpegBegin.size() &&
                       std::equal(kJpegBegin.begin(), kJpegBegin.end(), bytes.begin());
  if (!is_jpeg) return false;
  const auto pixels = bytes.begin() + static_cast<std::ptrdiff_t>(find_pixels(bytes));
  return std::search(pixels, bytes.end(), kJpegEnd.begin(), kJpegEnd.end()) == bytes.end();
}

}  // namespace

cv::Mat load_grey_image(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  if (bytes.empty()) throw InputError(path.string() + " is empty");
  if (is_png(bytes)) return decode_grey_png(bytes, path, true);
  if (is_cut_off_jpeg(bytes)) throw InputError(path.string() + " is cut off before the image ends");
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw InputError(path.string() + " is not an image that can be read");
  if (image.depth() != CV_8U) throw InputError(path.string() + " has more than 8 bits per channel");
  return image;
}

}  // namespace plumb
