/// A view of an 8-bit grey image that somebody else owns.
///
/// Frames:
///   img: u right, v down; (0,0) is the centre of the upper left pixel.
///   Rows run from top to bottom.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plumb {

struct ImageView {
  const std::uint8_t* data = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::ptrdiff_t stride_bytes = 0;

  [[nodiscard]] bool empty() const { return data == nullptr || width_px <= 0 || height_px <= 0; }
  [[nodiscard]] const std::uint8_t* row(int v) const { return data + v * stride_bytes; }
  [[nodiscard]] std::uint8_t at(int u, int v) const { return row(v)[u]; }
};

}  // namespace plumb
