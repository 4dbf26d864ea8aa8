#include "modules/camera/jpeg_source.hpp"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>
#include <vector>

// They use FILE and size_t without including what declares them.
#include <jpeglib.h>
//
#include <jerror.h>

namespace plumb {
namespace {

constexpr std::size_t kAlign = 64;  // [bytes] libjpeg-turbo's vector code wants 32

std::size_t rounded_up(std::size_t bytes) { return (bytes + kAlign - 1) / kAlign * kAlign; }

/// Memory that one image uses and gives back as a whole.
class Arena {
 public:
  explicit Arena(std::size_t bytes) : storage_(bytes + kAlign) {}

  /// Null when it is used up.
  void* take(std::size_t bytes) {
    bytes = rounded_up(bytes);
    const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
    const std::size_t begin = rounded_up(address) - address + used_;
    if (begin + bytes > storage_.size()) return nullptr;
    used_ += bytes;
    return storage_.data() + begin;
  }
  void give_back() { used_ = 0; }

 private:
  std::vector<std::uint8_t> storage_;
  std::size_t used_ = 0;
};

/// libjpeg's state with ours behind it. Its callbacks get a pointer to its part alone.
struct Decompressor {
  explicit Decompressor(std::size_t arena_bytes);
  ~Decompressor() { jpeg_destroy_decompress(&jpeg); }
  Decompressor(const Decompressor&) = delete;
  Decompressor& operator=(const Decompressor&) = delete;

  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_memory_mgr heap{};  ///< libjpeg's own memory
  Arena arena;
  std::jmp_buf on_error{};
  bool is_damaged = false;
};

Decompressor& owner_of(j_common_ptr jpeg) { return *static_cast<Decompressor*>(jpeg->client_data); }

void leave(j_common_ptr jpeg) { std::longjmp(owner_of(jpeg).on_error, 1); }

void note(j_common_ptr jpeg, int level) {
  if (level >= 0) return;
  // Many cameras put padding between the segments of an image.
  if (jpeg->err->msg_code != JWRN_EXTRANEOUS_DATA) owner_of(jpeg).is_damaged = true;
}

void say_nothing(j_common_ptr /*jpeg*/) {}

void* take_small(j_common_ptr jpeg, int pool, std::size_t bytes) {
  Decompressor& owner = owner_of(jpeg);
  void* memory = pool == JPOOL_IMAGE ? owner.arena.take(bytes) : nullptr;
  return memory != nullptr ? memory : owner.heap.alloc_small(jpeg, pool, bytes);
}

void* take_large(j_common_ptr jpeg, int pool, std::size_t bytes) {
  Decompressor& owner = owner_of(jpeg);
  void* memory = pool == JPOOL_IMAGE ? owner.arena.take(bytes) : nullptr;
  return memory != nullptr ? memory : owner.heap.alloc_large(jpeg, pool, bytes);
}

/// Rows of samples that begin aligned, and the table of their addresses; null without room.
JSAMPARRAY take_rows(Arena* arena, JDIMENSION width, JDIMENSION height) {
  const std::size_t stride = rounded_up(width * sizeof(JSAMPLE));
  auto* rows = static_cast<JSAMPARRAY>(arena->take(height * sizeof(JSAMPROW)));
  auto* samples = static_cast<JSAMPROW>(arena->take(height * stride));
  if (rows == nullptr || samples == nullptr) return nullptr;
  for (JDIMENSION v = 0; v < height; ++v) rows[v] = samples + v * stride;
  return rows;
}

JSAMPARRAY take_sample_array(j_common_ptr jpeg, int pool, JDIMENSION width, JDIMENSION height) {
  Decompressor& owner = owner_of(jpeg);
  JSAMPARRAY rows = pool == JPOOL_IMAGE ? take_rows(&owner.arena, width, height) : nullptr;
  return rows != nullptr ? rows : owner.heap.alloc_sarray(jpeg, pool, width, height);
}

void give_back(j_common_ptr jpeg, int pool) {
  Decompressor& owner = owner_of(jpeg);
  owner.heap.free_pool(jpeg, pool);
  if (pool == JPOOL_IMAGE) owner.arena.give_back();
}

Decompressor::Decompressor(std::size_t arena_bytes) : arena(arena_bytes) {
  jpeg.err = jpeg_std_error(&errors);
  errors.error_exit = leave;
  errors.emit_message = note;
  errors.output_message = say_nothing;
  jpeg.client_data = this;
  if (setjmp(on_error) != 0) throw std::bad_alloc();
  jpeg_create_decompress(&jpeg);
  heap = *jpeg.mem;
  jpeg.mem->alloc_small = take_small;
  jpeg.mem->alloc_large = take_large;
  jpeg.mem->alloc_sarray = take_sample_array;
  jpeg.mem->free_pool = give_back;
}

/// [bytes] Tables, and for up to four components the sixteen rows of blocks that are being decoded,
/// twice, because libjpeg keeps their neighbours.
std::size_t working_bytes(int width_px) {
  return (std::size_t{128} << 10U) + rounded_up(static_cast<std::size_t>(width_px)) * 160;
}

}  // namespace

struct JpegDecoder::Impl {
  Impl(int width, int height)
      : width_px(width),
        height_px(height),
        grey(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
        decompressor(working_bytes(width)) {}

  int width_px;
  int height_px;
  std::vector<std::uint8_t> grey;
  Decompressor decompressor;

  /// Nothing with a destructor lives here, because errors leave by longjmp().
  bool decode(const std::uint8_t* bytes, std::size_t size) {
    jpeg_decompress_struct& jpeg = decompressor.jpeg;
    decompressor.is_damaged = false;
    if (setjmp(decompressor.on_error) != 0) {
      jpeg_abort_decompress(&jpeg);
      return false;
    }
    jpeg_mem_src(&jpeg, bytes, static_cast<unsigned long>(size));
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = JCS_GRAYSCALE;
    const bool fits = static_cast<int>(jpeg.image_width) == width_px &&
                      static_cast<int>(jpeg.image_height) == height_px;
    if (fits) {
      jpeg_start_decompress(&jpeg);
      while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = grey.data() + std::size_t{jpeg.output_scanline} * jpeg.output_width;
        jpeg_read_scanlines(&jpeg, &row, 1);
      }
    }
    jpeg_abort_decompress(&jpeg);
    return fits && !decompressor.is_damaged;
  }
};

JpegDecoder::JpegDecoder(int width_px, int height_px)
    : impl_(std::make_unique<Impl>(width_px, height_px)) {}
JpegDecoder::~JpegDecoder() = default;
JpegDecoder::JpegDecoder(JpegDecoder&&) noexcept = default;

const char* JpegDecoder::decode(std::span<const std::uint8_t> jpeg, ImageView* view) {
  if (!impl_->decode(jpeg.data(), jpeg.size())) return "JPEG does not decode";
  *view = {impl_->grey.data(), impl_->width_px, impl_->height_px, impl_->width_px};
  return nullptr;
}

}  // namespace plumb
