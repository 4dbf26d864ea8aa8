// A fuzz target for compressed images, as ImageDecoder gets them from CAMERA and from a device.
#include "modules/camera/image_wire.hpp"
#include "tests/fuzz/fuzz_input.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using plumb::fuzz::require;
  constexpr int kWidth_px = 64;
  constexpr int kHeight_px = 48;
  // One decoder, as in a process: what an image leaves behind must not harm the next one.
  static plumb::ImageDecoder decoder(kWidth_px, kHeight_px);
  const plumb::fuzz::TightCopy copy({data, size});
  plumb::ImageFrame frame;
  frame.width_px = kWidth_px;
  frame.height_px = kHeight_px;
  frame.compressed = true;
  frame.data = copy.bytes();
  plumb::ImageView view;
  if (decoder.decode(frame, &view) != nullptr) return 0;
  require(view.width_px == kWidth_px && view.height_px == kHeight_px);
  static volatile unsigned sum = 0;  // every pixel has to be readable
  for (int v = 0; v < kHeight_px; ++v)
    for (int u = 0; u < kWidth_px; ++u) sum = sum + view.row(v)[u];
  return 0;
}
