#include "modules/datasets/folder/image_folder.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/input_error.hpp"
#include "modules/datasets/folder/companion.hpp"
#include "modules/datasets/folder/image_name.hpp"
#include "modules/datasets/kitti/image_list.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;
using Numbers = std::optional<std::vector<std::int64_t>>;

constexpr std::array kExtensions{".jpg", ".jpeg", ".png",  ".bmp", ".pgm",
                                 ".ppm", ".tif",  ".tiff", ".webp"};
constexpr int kMostGapNotes = 5;
constexpr double kLatestTime_s = 4e9;  // the year 2096

void sort_names(std::vector<ImageName>* names) {
  const bool by_time = are_named_by_time(*names);
  std::sort(names->begin(), names->end(), [by_time](const ImageName& a, const ImageName& b) {
    if (by_time && a.time_us != b.time_us) return a.time_us < b.time_us;
    return a.pieces != b.pieces ? a.pieces < b.pieces : a.path < b.path;
  });
}

std::vector<ImageName> list_names(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError("no image folder " + folder.string());
  std::vector<ImageName> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory() && is_image_name(entry.path()))
      names.push_back(read_image_name(entry.path()));
  }
  if (names.empty()) throw InputError(folder.string() + " has no image (jpg, png, ...)");
  sort_names(&names);
  const auto twin = std::adjacent_find(
      names.begin(), names.end(),
      [](const ImageName& a, const ImageName& b) { return a.pieces == b.pieces; });
  if (twin != names.end()) {
    throw InputError(twin->path.string() + " and " + (twin + 1)->path.filename().string() +
                     " name the same frame");
  }
  return names;
}

void set_numbers(const std::vector<ImageName>& names, const Numbers& numbers, ImageFolder* out) {
  const std::int64_t step = numbers ? common_step(*numbers) : 1;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto seq = numbers ? (*numbers)[i] / step : static_cast<std::int64_t>(i);
    out->images.push_back({names[i].path, seq, 0});
  }
  if (step > 1) {
    out->notes.push_back(format("the numbers in the names are multiples of %lld apart",
                                static_cast<long long>(step)));
  }
}

/// With `numbers`, the file has one of the layouts of RowLookup, else one row per image.
void set_times_of_file(const fs::path& file, const Numbers& numbers, ImageFolder* out) {
  std::vector<FolderImage>& images = out->images;
  const std::vector<NumberRow> rows = read_number_rows(file, 1, 1);
  if (!numbers && rows.size() != images.size()) {
    throw InputError(
        format("%s has %zu times for %zu images", file.c_str(), rows.size(), images.size()));
  }
  std::vector<NumberedImage> numbered;
  for (std::size_t i = 0; i < images.size(); ++i)
    numbered.push_back({numbers ? (*numbers)[i] : images[i].seq, images[i].path});
  const RowLookup lookup(file, rows.size(), numbered);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const NumberRow& row = rows[lookup.row(i, numbered[i].number)];
    const double time_s = row.values.front();
    if (time_s < 0.0 || time_s > kLatestTime_s)
      throw InputError(format("%s:%d: time is outside [0, 4e9] s", file.c_str(), row.line));
    images[i].capture_us = std::llround(time_s * 1e6);
  }
  out->notes.push_back("times from " + file.string());
}

void set_times_of_rate(double rate_hz, std::vector<FolderImage>* images) {
  for (FolderImage& image : *images) {
    const auto num_frames = static_cast<double>(image.seq - images->front().seq);
    image.capture_us = std::llround(1e6 * num_frames / rate_hz);
  }
}

void set_times_of_names(const std::vector<ImageName>& names, ImageFolder* out) {
  for (std::size_t i = 0; i < names.size(); ++i) out->images[i].capture_us = *names[i].time_us;
  out->notes.emplace_back("times from the names of the images");
}

void check_increase(const std::vector<FolderImage>& images) {
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].capture_us > images[i - 1].capture_us) continue;
    throw InputError("the time of " + images[i].path.string() + " is not after that of " +
                     images[i - 1].path.filename().string());
  }
}

void note_gaps(ImageFolder* folder) {
  int num_gaps = 0;
  for (std::size_t i = 1; i < folder->images.size(); ++i) {
    const FolderImage& image = folder->images[i];
    const std::int64_t missing = image.seq - folder->images[i - 1].seq - 1;
    if (missing == 0 || ++num_gaps > kMostGapNotes) continue;
    folder->notes.push_back(format("%lld image%s missing before %s",
                                   static_cast<long long>(missing), missing == 1 ? " is" : "s are",
                                   image.path.filename().c_str()));
  }
  if (num_gaps > kMostGapNotes)
    folder->notes.push_back(format("%d further gaps", num_gaps - kMostGapNotes));
}

}  // namespace

bool is_image_name(const fs::path& path) {
  if (path.filename().string().starts_with('.')) return false;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

ImageFolder list_image_folder(const ImageFolderOptions& options) {
  const std::vector<ImageName> names = list_names(options.folder);
  const bool named_by_time = are_named_by_time(names);
  const Numbers numbers = named_by_time ? Numbers() : count_by_names(names);
  ImageFolder out;
  set_numbers(names, numbers, &out);
  fs::path times = options.times;
  if (times.empty() && options.rate_hz == 0.0)
    times = find_companion(options.folder, {"times.txt"});
  if (options.rate_hz > 0.0) {
    set_times_of_rate(options.rate_hz, &out.images);
  } else if (!times.empty()) {
    set_times_of_file(times, numbers, &out);
  } else if (named_by_time) {
    set_times_of_names(names, &out);
  } else {
    throw InputError(options.folder.string() +
                     ": neither times.txt nor the names tell when the images were taken; state "
                     "--rate");
  }
  if (!named_by_time && !numbers && names.size() > 1)
    out.notes.emplace_back("the names do not count frames; the images are taken as consecutive");
  check_increase(out.images);
  note_gaps(&out);
  return out;
}

}  // namespace plumb
