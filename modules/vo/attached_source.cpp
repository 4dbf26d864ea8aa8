#include "modules/vo/attached_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "platform/complete_reader.hpp"
#include "platform/config.hpp"

namespace plumb {
namespace {

constexpr const char* kSchema = "plumb.attached_regions";
constexpr int kVersion = 1;
constexpr int kMostPx = 16'384;
constexpr std::size_t kMostHeadBytes = 512;
// One digit is so much evidence; 9 is the most that a cell can have.
constexpr double kEvidencePerDigit = 24.0 / 9.0;
constexpr char kNothing = '.';

std::size_t num_rows(int height_px) {
  return static_cast<std::size_t>((height_px + vo::AttachedRegions::kCellPx - 1) /
                                  vo::AttachedRegions::kCellPx);
}

std::size_t num_columns(int width_px) { return num_rows(width_px); }

std::size_t most_bytes(int width_px, int height_px) {
  constexpr std::size_t kAroundRow = 24;  // 'row_0000 = "..."' and the end of the line
  return kMostHeadBytes + num_rows(height_px) * (num_columns(width_px) + kAroundRow);
}

std::string row_key(std::size_t row) {
  std::array<char, 48> key{};
  std::snprintf(key.data(), key.size(), "attached_regions.row_%03zu", row);
  return key.data();
}

char digit_of(float evidence) {
  const long digit = std::lround(static_cast<double>(evidence) / kEvidencePerDigit);
  return digit <= 0 ? kNothing : static_cast<char>('0' + std::min(digit, 9L));
}

/// Throws ConfigError when the row is not one of `count` digits and dots.
void read_row(const std::string& where, const std::string& row, std::size_t count, float* out) {
  const bool is_row =
      row.size() == count && row.find_first_not_of(".0123456789") == std::string::npos;
  if (!is_row)
    throw ConfigError(where + " is not a text of " + std::to_string(count) + " digits and dots");
  for (const char c : row)
    *out++ = c == kNothing ? 0.0F : static_cast<float>((c - '0') * kEvidencePerDigit);
}

}  // namespace

void load_attached_regions(const std::string& path, int width_px, int height_px,
                           vo::AttachedRegions* regions) {
  ConfigFile file = ConfigFile::load(path);
  CompleteReader field(path, &file);
  std::string schema = kSchema;
  int version = kVersion;
  int file_width_px = 0;
  int file_height_px = 0;
  field("attached_regions.schema", schema, {kSchema}, "");
  field("attached_regions.version", version, kVersion, kVersion, "");
  field("attached_regions.width_px", file_width_px, 1, kMostPx, "");
  field("attached_regions.height_px", file_height_px, 1, kMostPx, "");
  if (file_width_px != width_px || file_height_px != height_px) {
    throw ConfigError(path + ": it is of images of " + std::to_string(file_width_px) + "x" +
                      std::to_string(file_height_px) + " pixels");
  }
  std::vector<float> evidence(regions->evidence().size());
  const std::size_t columns = num_columns(width_px);
  for (std::size_t row = 0; row < num_rows(height_px); ++row) {
    const std::string key = row_key(row);
    std::string digits;
    field(key.c_str(), digits, "");
    read_row(path + ": " + key, digits, columns, &evidence[row * columns]);
  }
  file.refuse_unread();
  regions->restore(evidence);
}

AttachedFile::AttachedFile(const std::string& path, int width_px, int height_px)
    : path_(path),
      width_px_(width_px),
      height_px_(height_px),
      thread_(path, most_bytes(width_px, height_px)) {
  text_.reserve(most_bytes(width_px, height_px));
  next_text_.reserve(text_.capacity());
}

bool AttachedFile::save(const vo::AttachedRegions& regions) {
  std::array<char, kMostHeadBytes> head{};
  std::snprintf(
      head.data(), head.size(),
      "# What is attached to the camera, by cells of %d pixels. Written by plumb-vo; delete "
      "it after work on the camera.\n[attached_regions]\nschema = \"%s\"\nversion = %d\n"
      "width_px = %d\nheight_px = %d\n",
      vo::AttachedRegions::kCellPx, kSchema, kVersion, width_px_, height_px_);
  next_text_ = head.data();
  const std::size_t columns = num_columns(width_px_);
  const std::span<const float> evidence = regions.evidence();
  for (std::size_t row = 0; row < num_rows(height_px_); ++row) {
    std::array<char, 48> name{};
    std::snprintf(name.data(), name.size(), "row_%03zu = \"", row);
    next_text_ += name.data();
    for (const float cell : evidence.subspan(row * columns, columns)) next_text_ += digit_of(cell);
    next_text_ += "\"\n";
  }
  if (next_text_ == text_ || !thread_.replace(next_text_)) return false;
  text_.swap(next_text_);
  return true;
}

}  // namespace plumb
