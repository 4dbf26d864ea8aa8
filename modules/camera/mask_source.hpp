/// Reads the picture of a mask: a PNG of any kind, by libpng, or a PGM.
///
/// Memory:
///   Allocates; masks are read before a process serves.
/// Errors:
///   The mask is empty when the file is neither or is damaged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace plumb {

struct MaskPicture {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> marked;  ///< rows without gaps; not zero where any colour is not black

  [[nodiscard]] bool empty() const { return marked.empty(); }
};

[[nodiscard]] MaskPicture read_mask_picture(const std::string& path);

}  // namespace plumb
