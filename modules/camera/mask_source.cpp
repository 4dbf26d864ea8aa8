#include "modules/camera/mask_source.hpp"

#include <png.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <limits>

namespace plumb {
namespace {

constexpr int kMaxMaskSide_px = 8192;

bool is_size(long long width, long long height) {
  return width >= 1 && width <= kMaxMaskSide_px && height >= 1 && height <= kMaxMaskSide_px;
}

MaskPicture read_png_mask(const std::string& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  MaskPicture mask;
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) return {};
  png.format = PNG_FORMAT_RGB;  // a dark colour would become black in grey
  std::vector<std::uint8_t> colours;
  if (is_size(png.width, png.height)) colours.resize(PNG_IMAGE_SIZE(png));
  const png_color black{0, 0, 0};  // behind what is transparent
  if (colours.empty() || png_image_finish_read(&png, &black, colours.data(), 0, nullptr) == 0) {
    png_image_free(&png);
    return {};
  }
  mask.width_px = static_cast<int>(png.width);
  mask.height_px = static_cast<int>(png.height);
  mask.marked.resize(colours.size() / 3);
  for (std::size_t i = 0; i < mask.marked.size(); ++i)
    mask.marked[i] = std::max({colours[3 * i], colours[3 * i + 1], colours[3 * i + 2]});
  return mask;
}

/// The next number of a PGM, -1 without one. A "#" begins a comment.
long long next_number(std::istream& file) {
  while (file >> std::ws && file.peek() == '#')
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  long long number = -1;
  return file >> number ? number : -1;
}

MaskPicture read_pgm_mask(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char magic[2] = {};
  file.read(magic, sizeof magic);
  const bool is_text = magic[1] == '2';
  if (!file || magic[0] != 'P' || (magic[1] != '5' && !is_text)) return {};
  const long long width = next_number(file);
  const long long height = next_number(file);
  const long long most = next_number(file);
  if (!is_size(width, height) || most < 1 || most > 255) return {};
  MaskPicture mask{static_cast<int>(width), static_cast<int>(height), {}};
  mask.marked.resize(static_cast<std::size_t>(width * height));
  if (is_text) {
    for (std::uint8_t& pixel : mask.marked) {
      const long long value = next_number(file);
      if (value < 0 || value > most) return {};
      pixel = static_cast<std::uint8_t>(value);
    }
    return mask;
  }
  file.get();  // the one white space before the pixels
  const auto bytes = static_cast<std::streamsize>(mask.marked.size());
  if (!file.read(reinterpret_cast<char*>(mask.marked.data()), bytes)) return {};
  return mask;
}

}  // namespace

MaskPicture read_mask_picture(const std::string& path) {
  MaskPicture mask = read_pgm_mask(path);
  return mask.empty() ? read_png_mask(path) : mask;
}

}  // namespace plumb
