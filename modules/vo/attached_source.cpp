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
constexpr double kEvidencePerDigit = double{vo::AttachedRegions::kMostEvidence} / 9.0;
constexpr char kNothing = '.';

std::size_t cells_along(int side_px) {
  return static_cast<std::size_t>(vo::AttachedRegions::num_cells(side_px));
}

std::size_t most_bytes(int width_px, int height_px) {
  constexpr std::size_t kAroundRow = 24;  // 'row_0000 = "..."' and the end of the line
  return kMostHeadBytes + cells_along(height_px) * (cells_along(width_px) + kAroundRow);
}

std::array<char, 32> row_name(std::size_t row) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "row_%03zu", row);
  return name;
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
  const std::size_t columns = cells_along(width_px);
  for (std::size_t row = 0; row < cells_along(height_px); ++row) {
    const std::string key = std::string("attached_regions.") + row_name(row).data();
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
  const std::size_t columns = cells_along(width_px_);
  const std::span<const float> evidence = regions.evidence();
  for (std::size_t row = 0; row < cells_along(height_px_); ++row) {
    next_text_ += row_name(row).data();
    next_text_ += " = \"";
    for (const float cell : evidence.subspan(row * columns, columns)) next_text_ += digit_of(cell);
    next_text_ += "\"\n";
  }
  const bool is_on_disk = next_text_ == text_ && thread_.error() == 0;
  if (is_on_disk || !thread_.replace(next_text_)) return false;
  text_.swap(next_text_);
  return true;
}

}  // namespace plumb
