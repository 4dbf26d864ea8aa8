#include "modules/datasets/folder/image_folder.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "core/input_error.hpp"
#include "modules/datasets/number_file.hpp"
#include "modules/datasets/text.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;
constexpr std::array kExtensions{".jpg", ".jpeg", ".png",  ".bmp", ".pgm",
                                 ".ppm", ".tif",  ".tiff", ".webp"};
constexpr std::size_t kMostDigits = 18;
constexpr int kMaxMissingNotes = 5;

/// What a file name says about the place of its image.
struct NamedImage {
  fs::path path;
  std::string prefix;         // text before the last number
  std::int64_t number = -1;   // the last number of the name; -1 for none
  std::int64_t time_us = -1;  // the whole name as a time since 1970; -1 when it is none
};

bool is_image(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::int64_t time_of_name(const std::string& stem) {
  if (std::all_of(stem.begin(), stem.end(), is_digit)) {
    if (stem.size() == 19) return std::stoll(stem.substr(0, 16));
    if (stem.size() == 16) return std::stoll(stem);
    if (stem.size() == 13) return 1000 * std::stoll(stem);
    return -1;
  }
  const bool has_point = stem.size() > 11 && stem[10] == '.';
  if (!has_point || !is_digit(stem[0])) return -1;
  const std::optional<double> time_s = parse_number(stem);
  return time_s ? std::llround(*time_s * 1e6) : -1;
}

NamedImage read_name(const fs::path& path) {
  NamedImage image{path, path.stem().string()};
  const std::string stem = image.prefix;
  image.time_us = time_of_name(stem);
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(stem[begin - 1])) --begin;
  if (begin == end || end - begin > kMostDigits) return image;
  image.prefix = stem.substr(0, begin);
  image.number = std::stoll(stem.substr(begin, end - begin));
  return image;
}

std::vector<NamedImage> list_names(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError("no image folder " + folder.string());
  std::vector<NamedImage> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_image(entry.path())) images.push_back(read_name(entry.path()));
  }
  if (images.empty()) throw InputError(folder.string() + " holds no image (jpg, png, ...)");
  std::sort(images.begin(), images.end(), [](const NamedImage& a, const NamedImage& b) {
    return std::tie(a.prefix, a.number, a.path) < std::tie(b.prefix, b.number, b.path);
  });
  return images;
}

/// The file of times: the stated one, or times.txt in the folder or beside it; empty for none.
fs::path find_times(const ImageFolderOptions& options) {
  if (!options.times.empty()) return options.times;
  const fs::path folder = fs::absolute(options.folder / "").parent_path();
  for (const fs::path& file : {folder / "times.txt", folder.parent_path() / "times.txt"}) {
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

/// The number of each image among the frames of its camera, from 0.
std::vector<std::int64_t> count_frames(const std::vector<NamedImage>& names) {
  std::vector<std::int64_t> frames(names.size());
  std::iota(frames.begin(), frames.end(), 0);
  std::int64_t step = 0;
  for (std::size_t i = 1; i < names.size(); ++i) {
    const std::int64_t apart = names[i].number - names[i - 1].number;
    if (names[i - 1].number < 0 || apart <= 0 || names[i].prefix != names.front().prefix)
      return frames;
    step = std::gcd(step, apart);
  }
  for (std::size_t i = 1; i < names.size(); ++i)
    frames[i] = (names[i].number - names.front().number) / step;
  return frames;
}

void take_times_of_file(const fs::path& file, std::vector<FolderImage>* images) {
  const std::vector<NumberRow> rows = read_number_rows(file, 1, 1);
  if (rows.size() != images->size()) {
    throw InputError(format("%s has %zu times for %zu images", file.string().c_str(), rows.size(),
                            images->size()));
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    (*images)[i].capture_us = std::llround(rows[i].values.front() * 1e6);
}

void check_increase(const std::vector<FolderImage>& images) {
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].capture_us > images[i - 1].capture_us) continue;
    throw InputError(images[i].path.string() + ": its time is not after that of " +
                     images[i - 1].path.filename().string());
  }
}

void note_gaps(const std::vector<FolderImage>& images, std::vector<std::string>* notes) {
  int num_gaps = 0;
  for (std::size_t i = 1; i < images.size(); ++i) {
    const std::int64_t missing = images[i].seq - images[i - 1].seq - 1;
    if (missing == 0 || ++num_gaps > kMaxMissingNotes) continue;
    notes->push_back(format("%lld image%s missing before %s", static_cast<long long>(missing),
                            missing == 1 ? " is" : "s are",
                            images[i].path.filename().string().c_str()));
  }
  if (num_gaps > kMaxMissingNotes)
    notes->push_back(format("%d further gaps", num_gaps - kMaxMissingNotes));
}

}  // namespace

ImageFolder list_image_folder(const ImageFolderOptions& options) {
  const std::vector<NamedImage> names = list_names(options.folder);
  const std::vector<std::int64_t> frames = count_frames(names);
  const bool named_by_time = std::all_of(
      names.begin(), names.end(), [](const NamedImage& image) { return image.time_us >= 0; });
  ImageFolder out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out.images.push_back({names[i].path, named_by_time ? static_cast<std::int64_t>(i) : frames[i]});
  const fs::path times = options.rate_hz > 0.0 ? fs::path() : find_times(options);
  if (!times.empty()) {
    take_times_of_file(times, &out.images);
    out.notes.push_back("times from " + times.string());
  } else if (options.rate_hz > 0.0) {
    for (FolderImage& image : out.images)
      image.capture_us = std::llround(1e6 * static_cast<double>(image.seq) / options.rate_hz);
  } else if (named_by_time) {
    for (std::size_t i = 0; i < names.size(); ++i) out.images[i].capture_us = names[i].time_us;
    out.notes.emplace_back("times from the names of the images");
  } else {
    throw InputError(options.folder.string() +
                     ": neither times.txt nor the names tell the times of the images; state "
                     "--rate or --times");
  }
  check_increase(out.images);
  note_gaps(out.images, &out.notes);
  return out;
}

}  // namespace plumb
