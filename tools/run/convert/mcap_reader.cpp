#include "tools/run/convert/mcap_reader.hpp"

#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>

#include "core/input_error.hpp"
#include "modules/datasets/text.hpp"
#include "tools/run/convert/byte_cursor.hpp"

namespace plumb {
namespace {

constexpr std::array<std::uint8_t, 8> kMcapMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
constexpr std::uint8_t kMcapSchema = 0x03, kMcapChannel = 0x04, kMcapMessage = 0x05,
                       kMcapChunk = 0x06, kMcapStatistics = 0x0B, kMcapDataEnd = 0x0F;
constexpr std::uint64_t kRecordHead = 9;         ///< opcode and length
constexpr std::uint64_t kFooterBytes = 9 + 20;   ///< the record
constexpr std::uint64_t kMaxRecord = 1U << 30U;  ///< a larger one is damage

/// [bytes] The most that `packed` bytes can hold. The densest block of zstd is 128 KiB in four
/// bytes, and a byte of lz4 stands for 255 at most.
std::uint64_t most_unpacked(const std::string& compression, std::uint64_t packed) {
  if (compression == "zstd") return packed * (128U << 10U) / 4;
  return compression == "lz4" ? packed * 255 : packed;
}

bool unpack_lz4(std::span<const std::uint8_t> packed, std::span<std::uint8_t> out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> owner(
      context, &LZ4F_freeDecompressionContext);
  std::size_t used = 0, made = 0;
  while (used < packed.size()) {
    std::size_t num_in = packed.size() - used, num_out = out.size() - made;
    const std::size_t left = LZ4F_decompress(context, out.data() + made, &num_out,
                                             packed.data() + used, &num_in, nullptr);
    if (LZ4F_isError(left) || (num_in == 0 && num_out == 0)) return false;
    used += num_in;
    made += num_out;
  }
  return made == out.size();
}

}  // namespace

McapReader::McapReader(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  std::array<std::uint8_t, 8> magic{};
  if (!file_) throw InputError("cannot read " + path);
  file_.seekg(0, std::ios::end);
  file_bytes_ = static_cast<std::uint64_t>(file_.tellg());
  file_.seekg(0);
  file_.read(reinterpret_cast<char*>(magic.data()), magic.size());
  if (!file_ || magic != kMcapMagic) throw InputError(path + ": is not an MCAP file");
  read_summary();
  offset_ = magic.size();
}

void McapReader::fail(const std::string& reason) const {
  throw InputError(format("%s: byte %llu: %s", path_.c_str(),
                          static_cast<unsigned long long>(offset_), reason.c_str()));
}

/// Reads the record at offset_ into record_ and moves on. Returns false at the end of the file.
bool McapReader::read_record(std::uint8_t* opcode) {
  std::array<std::uint8_t, kRecordHead> head{};
  if (offset_ >= file_bytes_) return false;
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(offset_));
  file_.read(reinterpret_cast<char*>(head.data()), head.size());
  ByteCursor cursor(head);
  *opcode = static_cast<std::uint8_t>(cursor.number(1));
  const std::uint64_t size = cursor.number(8);
  if (!file_ || size > file_bytes_ - std::min(file_bytes_, offset_ + kRecordHead))
    fail("the file is cut off");
  if (size > kMaxRecord) fail("a record of " + std::to_string(size) + " bytes");
  record_.resize(size);
  file_.read(reinterpret_cast<char*>(record_.data()), static_cast<std::streamsize>(size));
  if (!file_) fail("cannot read");
  offset_ += kRecordHead + size;
  return true;
}

/// Takes channels and counts from the summary of a complete file.
void McapReader::read_summary() {
  if (file_bytes_ < 2 * kMcapMagic.size() + kFooterBytes) return;
  const std::uint64_t footer = file_bytes_ - kMcapMagic.size() - kFooterBytes;
  std::array<std::uint8_t, kFooterBytes> bytes{};
  file_.seekg(static_cast<std::streamoff>(footer));
  file_.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
  ByteCursor cursor(bytes);
  constexpr std::uint64_t kMcapFooter = 0x02;
  if (cursor.number(1) != kMcapFooter || cursor.number(8) != 20) return;  // cut off
  const std::uint64_t summary = cursor.number(8);
  if (summary == 0 || summary > footer) return;
  std::uint8_t opcode = 0;
  for (offset_ = summary; offset_ < footer && read_record(&opcode);) take_record(opcode, record_);
}

std::int64_t McapReader::num_messages(std::uint16_t channel) const {
  const auto count = counts_.find(channel);
  return count == counts_.end() ? 0 : static_cast<std::int64_t>(count->second);
}

/// Takes a record that describes others.
void McapReader::take_record(std::uint8_t opcode, std::span<const std::uint8_t> content) {
  ByteCursor cursor(content);
  if (opcode == kMcapSchema) {
    const auto number = static_cast<std::uint16_t>(cursor.number(2));
    schemas_[number] = cursor.text();
  } else if (opcode == kMcapChannel) {
    const auto number = static_cast<std::uint16_t>(cursor.number(2));
    const auto schema = static_cast<std::uint16_t>(cursor.number(2));
    McapChannel& channel = channels_[number];
    channel.topic = cursor.text();
    channel.encoding = cursor.text();
    channel.schema = schemas_[schema];
  } else if (opcode == kMcapStatistics) {
    (void)cursor.take(8 + 2 + 4 * 4 + 2 * 8);
    ByteCursor counts(cursor.blob());
    while (!counts.at_end()) {
      const auto channel = static_cast<std::uint16_t>(counts.number(2));
      counts_[channel] = counts.number(8);
    }
  }
  if (!cursor.ok()) fail("a record is shorter than its content");
}

void McapReader::open_chunk(std::span<const std::uint8_t> content) {
  ByteCursor cursor(content);
  (void)cursor.take(8 + 8);
  const std::uint64_t size = cursor.number(8);
  const std::uint64_t crc = cursor.number(4);  // 0: not stated
  const std::string compression(cursor.text());
  const auto packed = cursor.take(cursor.number(8));
  if (!cursor.ok() || size > kMaxRecord) fail("a chunk is damaged");
  if (size > most_unpacked(compression, packed.size())) fail("a chunk states more than it holds");
  chunk_.resize(size);
  chunk_at_ = 0;
  bool good = false;
  if (compression.empty() && packed.size() == size) {
    std::copy(packed.begin(), packed.end(), chunk_.begin());
    good = true;
  } else if (compression == "zstd") {
    good = ZSTD_decompress(chunk_.data(), size, packed.data(), packed.size()) == size;
  } else if (compression == "lz4") {
    good = unpack_lz4(packed, chunk_);
  } else if (!compression.empty()) {
    fail("unknown compression '" + compression + "'");
  }
  if (!good || (crc != 0 && crc != crc32_z(0, chunk_.data(), size))) fail("a chunk is damaged");
}

bool McapReader::take_message(std::span<const std::uint8_t> content, McapMessage* message) const {
  ByteCursor cursor(content);
  message->channel = static_cast<std::uint16_t>(cursor.number(2));
  (void)cursor.take(4 + 8 + 8);
  if (!cursor.ok() || channels_.count(message->channel) == 0) fail("a message of no channel");
  message->data = content.subspan(2 + 4 + 8 + 8);
  return true;
}

bool McapReader::next_in_chunk(McapMessage* message) {
  while (chunk_at_ < chunk_.size()) {
    ByteCursor cursor(std::span<const std::uint8_t>(chunk_).subspan(chunk_at_));
    const auto opcode = static_cast<std::uint8_t>(cursor.number(1));
    const auto content = cursor.take(cursor.number(8));
    if (!cursor.ok()) fail("a chunk is damaged");
    chunk_at_ += kRecordHead + content.size();
    if (opcode == kMcapMessage) return take_message(content, message);
    take_record(opcode, content);
  }
  return false;
}

bool McapReader::next(McapMessage* message) {
  if (next_in_chunk(message)) return true;
  std::uint8_t opcode = 0;
  while (read_record(&opcode)) {
    if (opcode == kMcapDataEnd) return false;
    if (opcode == kMcapMessage) return take_message(record_, message);
    if (opcode == kMcapChunk) {
      open_chunk(record_);
      if (next_in_chunk(message)) return true;
    } else {
      take_record(opcode, record_);
    }
  }
  fail("the file is cut off");
}

}  // namespace plumb
