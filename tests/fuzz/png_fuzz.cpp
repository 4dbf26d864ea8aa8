// A fuzz target for PNG and PGM files: the pictures of masks, and the images of KITTI.
#include "core/input_error.hpp"
#include "modules/camera/ego_mask.hpp"
#include "modules/camera/mask_source.hpp"
#include "modules/datasets/kitti/png_image.hpp"
#include "tests/fuzz/fuzz_input.hpp"

namespace plumb {
namespace {

void read_mask(fuzz::Bytes bytes) {
  static const fuzz::MemoryFile kFile;
  kFile.write(bytes);
  const MaskPicture mask = read_mask_picture(kFile.path());
  if (mask.empty()) return;
  fuzz::require(mask.width_px > 0 && mask.height_px > 0);
  fuzz::require(mask.marked.size() ==
                static_cast<std::size_t>(mask.width_px) * static_cast<std::size_t>(mask.height_px));
  MaskPainter painter(mask.width_px, mask.height_px);
  painter.add_bytes(mask.marked.data());
}

void read_image_file(fuzz::Bytes bytes) {
  PngHeader header;
  if (read_png_header(bytes, &header) != nullptr) return;
  if (std::int64_t{header.width_px} * header.height_px > 1'000'000) return;  // only slow
  try {
    const cv::Mat image = decode_grey_png({bytes.begin(), bytes.end()}, "fuzz.png", true);
    fuzz::require(image.cols == header.width_px && image.rows == header.height_px);
  } catch (const InputError&) {
  }
}

}  // namespace
}  // namespace plumb

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const plumb::fuzz::TightCopy copy({data, size});
  plumb::read_mask(copy.bytes());
  plumb::read_image_file(copy.bytes());
  return 0;
}
