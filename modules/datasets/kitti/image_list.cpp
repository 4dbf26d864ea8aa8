#include "modules/datasets/kitti/image_list.hpp"

#include <algorithm>
#include <charconv>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMaxGapNotes = 5;

bool parse_frame_number(const std::string& stem, std::int64_t* number) {
  const char* end = stem.data() + stem.size();
  const auto [stop, error] = std::from_chars(stem.data(), end, *number);
  return error == std::errc() && stop == end && *number >= 0;
}

}  // namespace

std::vector<NumberedImage> list_images(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError("no image folder " + folder.string());
  std::vector<NumberedImage> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    NumberedImage image{0, entry.path()};
    if (image.path.extension() != ".png") continue;
    if (parse_frame_number(image.path.stem().string(), &image.number)) images.push_back(image);
  }
  if (images.empty()) throw InputError(folder.string() + " has no image (NUMBER.png)");
  std::sort(images.begin(), images.end(), [](const NumberedImage& a, const NumberedImage& b) {
    return a.number != b.number ? a.number < b.number : a.path < b.path;
  });
  const auto twin = std::adjacent_find(
      images.begin(), images.end(),
      [](const NumberedImage& a, const NumberedImage& b) { return a.number == b.number; });
  if (twin != images.end()) {
    throw InputError("frame " + std::to_string(twin->number) + " is there twice: " +
                     twin->path.string() + " and " + (twin + 1)->path.filename().string());
  }
  return images;
}

std::vector<std::string> describe_gaps(const std::vector<NumberedImage>& images) {
  std::vector<std::string> notes;
  std::size_t num_gaps = 0;
  for (std::size_t i = 1; i < images.size(); ++i) {
    const std::int64_t missing = images[i].number - images[i - 1].number - 1;
    if (missing == 0) continue;
    if (++num_gaps > kMaxGapNotes) continue;
    notes.push_back(format("warning: %lld frame%s missing after %lld; seq keeps the gap",
                           static_cast<long long>(missing), missing == 1 ? " is" : "s are",
                           static_cast<long long>(images[i - 1].number)));
  }
  if (num_gaps > kMaxGapNotes) {
    notes.push_back(format("warning: %zu further gaps", num_gaps - kMaxGapNotes));
  }
  return notes;
}

RowLookup::RowLookup(const fs::path& file, std::size_t num_rows,
                     const std::vector<NumberedImage>& images) {
  const std::int64_t first = images.front().number;
  const std::int64_t last = images.back().number;
  const auto rows = static_cast<std::int64_t>(num_rows);
  if (rows == last - first + 1) {
    first_ = first;
  } else if (rows > last) {
    first_ = 0;
  } else if (num_rows == images.size()) {
    per_image_ = true;
  } else {
    throw InputError(format(
        "%s has %zu rows for %zu images numbered %lld to %lld: expected one row per frame number",
        file.string().c_str(), num_rows, images.size(), static_cast<long long>(first),
        static_cast<long long>(last)));
  }
}

}  // namespace plumb
