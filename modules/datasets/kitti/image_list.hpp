/// The numbered images of a folder.
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

/// Every NUMBER.png by number. Throws InputError when the folder is missing or holds none, and when
/// two names give the same number.
[[nodiscard]] std::vector<NumberedImage> list_images(const std::filesystem::path& folder);

/// Sentences about numbers that are left out, one per gap, at most five.
[[nodiscard]] std::vector<std::string> describe_gaps(const std::vector<NumberedImage>& images);

/// Which row of a per-frame file belongs to which image. The file has one row per frame number from
/// the first to the last image, or from 0 on, or one per image.
class RowLookup {
 public:
  /// Throws InputError when `num_rows` fits none of the three.
  RowLookup(const std::filesystem::path& file, std::size_t num_rows,
            const std::vector<NumberedImage>& images);
  /// Row of the image that is `ordinal`-th in the list.
  [[nodiscard]] std::size_t row(std::size_t ordinal, std::int64_t number) const {
    return per_image_ ? ordinal : static_cast<std::size_t>(number - first_);
  }

 private:
  std::int64_t first_ = 0;  ///< frame number of row 0
  bool per_image_ = false;
};

}  // namespace plumb
