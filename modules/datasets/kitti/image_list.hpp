/// Lists the numbered images of a folder.
///
/// Errors:
///   Functions throw InputError.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plumb {

struct NumberedImage {
  std::int64_t number = 0;
  std::filesystem::path path;
};

/// Lists every NUMBER.png in the order of the numbers. Throws when the folder is missing or has no
/// such image, and when two names have the same number.
[[nodiscard]] std::vector<NumberedImage> list_images(const std::filesystem::path& folder);

/// Describes missing numbers in one sentence per gap, for at most five gaps.
[[nodiscard]] std::vector<std::string> describe_gaps(const std::vector<NumberedImage>& images);

/// Finds the row of a per-frame file that belongs to an image. The file has one row per frame
/// number, starting at the first image or at 0, or it has one row per image.
class RowLookup {
 public:
  /// Throws when `num_rows` fits none of the three layouts.
  RowLookup(const std::filesystem::path& file, std::size_t num_rows,
            const std::vector<NumberedImage>& images);
  /// Row of the image with index `ordinal` in the list and frame number `number`.
  [[nodiscard]] std::size_t row(std::size_t ordinal, std::int64_t number) const {
    return per_image_ ? ordinal : static_cast<std::size_t>(number - first_);
  }

 private:
  std::int64_t first_ = 0;  ///< frame number of the first row
  bool per_image_ = false;
};

}  // namespace plumb
