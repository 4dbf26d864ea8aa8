#include "modules/datasets/folder/grey_image.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/input_error.hpp"
#include "modules/datasets/kitti/png_image.hpp"

namespace plumb {
namespace {

constexpr std::array<std::uint8_t, 2> kJpegBegin{0xFF, 0xD8};
constexpr std::array<std::uint8_t, 2> kJpegEnd{0xFF, 0xD9};

/// libjpeg fills the missing part of a JPEG with grey and only warns.
bool is_cut_off_jpeg(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < 2 || !std::equal(kJpegBegin.begin(), kJpegBegin.end(), bytes.begin()))
    return false;
  return std::find_end(bytes.begin(), bytes.end(), kJpegEnd.begin(), kJpegEnd.end()) == bytes.end();
}

}  // namespace

cv::Mat load_grey_image(const std::filesystem::path& path) {
  if (path.extension() == ".png" || path.extension() == ".PNG") return load_grey_png(path, true);
  std::ifstream file(path, std::ios::binary);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(file)),
                                        std::istreambuf_iterator<char>());
  if (bytes.empty()) throw InputError("cannot read " + path.string());
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
