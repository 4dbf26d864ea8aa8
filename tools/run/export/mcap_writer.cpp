#include "tools/run/export/mcap_writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "core/input_error.hpp"

namespace plumb {
namespace {

constexpr std::size_t kChunkBytes = 1 << 20;
constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

constexpr std::uint8_t kHeader = 0x01, kFooter = 0x02, kSchema = 0x03, kTopic = 0x04,
                       kMessage = 0x05, kChunk = 0x06, kMessageIndex = 0x07, kChunkIndex = 0x08,
                       kStatistics = 0x0B, kSummaryOffset = 0x0E, kDataEnd = 0x0F;

std::uint32_t crc_of(std::uint32_t before, std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32_z(before, bytes.data(), bytes.size()));
}

void add_record(std::uint8_t opcode, std::span<const std::uint8_t> content, McapBytes* out) {
  out->u8(opcode);
  out->u64(content.size());
  out->bytes(content);
}

}  // namespace

void McapBytes::text(std::string_view value) {
  u32(static_cast<std::uint32_t>(value.size()));
  bytes({reinterpret_cast<const std::uint8_t*>(value.data()), value.size()});
}

void McapWriter::Span::add(std::uint64_t time_ns, bool is_first) {
  first_ns = is_first ? time_ns : std::min(first_ns, time_ns);
  last_ns = is_first ? time_ns : std::max(last_ns, time_ns);
}

McapWriter::McapWriter(const std::filesystem::path& path, std::string_view profile,
                       std::string_view library)
    : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw InputError("cannot write " + path.string());
  put(kMagic);
  McapBytes header;
  header.text(profile);
  header.text(library);
  put_record(kHeader, header);
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view encoding,
                                     std::string_view definition) {
  const auto number = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0 means "no schema"
  McapBytes& content = schemas_.emplace_back();
  content.u16(number);
  content.text(name);
  content.text(encoding);
  content.text(definition);
  put_record(kSchema, content);
  return number;
}

std::uint16_t McapWriter::add_channel(std::string_view topic, std::string_view encoding,
                                      std::uint16_t schema, const Words& metadata) {
  const auto number = static_cast<std::uint16_t>(channels_.size());
  McapBytes words;
  for (const auto& [key, value] : metadata) {
    words.text(key);
    words.text(value);
  }
  McapBytes& content = channels_.emplace_back();
  content.u16(number);
  content.u16(schema);
  content.text(topic);
  content.text(encoding);
  content.u32(static_cast<std::uint32_t>(words.size()));
  content.bytes(words.all());
  put_record(kTopic, content);
  num_written_.push_back(0);
  return number;
}

void McapWriter::write(std::uint16_t channel, std::uint64_t time_ns,
                       std::span<const std::uint8_t> message) {
  chunk_span_.add(time_ns, chunk_index_.empty());
  span_.add(time_ns, num_messages_ == 0);
  chunk_index_[channel].emplace_back(time_ns, chunk_.size());
  chunk_.u8(kMessage);
  chunk_.u64(2 + 4 + 8 + 8 + message.size());
  chunk_.u16(channel);
  chunk_.u32(num_written_[channel]++);
  chunk_.u64(time_ns);
  chunk_.u64(time_ns);
  chunk_.bytes(message);
  ++num_messages_;
  if (chunk_.size() >= kChunkBytes) end_chunk();
}

void McapWriter::end_chunk() {
  if (chunk_index_.empty()) return;
  ChunkPlace& place = chunks_.emplace_back();
  place.span = chunk_span_;
  place.offset = offset_;
  place.record_bytes = chunk_.size();
  McapBytes head;
  head.u64(chunk_span_.first_ns);
  head.u64(chunk_span_.last_ns);
  head.u64(chunk_.size());
  head.u32(crc_of(0, chunk_.all()));
  head.text("");  // not compressed
  head.u64(chunk_.size());
  McapBytes front;
  front.u8(kChunk);
  front.u64(head.size() + chunk_.size());
  front.bytes(head.all());
  put(front.all());
  put(chunk_.all());
  place.bytes = offset_ - place.offset;

  const std::uint64_t index_start = offset_;
  for (auto& [channel, entries] : chunk_index_) {
    std::stable_sort(entries.begin(), entries.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    McapBytes index;
    index.u16(channel);
    index.u32(static_cast<std::uint32_t>(16 * entries.size()));
    for (const auto& [time_ns, offset] : entries) {
      index.u64(time_ns);
      index.u64(offset);
    }
    place.index_offsets[channel] = offset_;
    put_record(kMessageIndex, index);
  }
  place.index_bytes = offset_ - index_start;
  chunk_.clear();
  chunk_index_.clear();
}

void McapWriter::end_summary_group(std::uint8_t opcode, std::uint64_t start,
                                   McapBytes* offsets) const {
  if (offset_ == start) return;
  McapBytes content;
  content.u8(opcode);
  content.u64(start);
  content.u64(offset_ - start);
  add_record(kSummaryOffset, content.all(), offsets);
}

void McapWriter::put_chunk_indexes() {
  for (const ChunkPlace& chunk : chunks_) {
    McapBytes content;
    content.u64(chunk.span.first_ns);
    content.u64(chunk.span.last_ns);
    content.u64(chunk.offset);
    content.u64(chunk.bytes);
    content.u32(static_cast<std::uint32_t>(10 * chunk.index_offsets.size()));
    for (const auto& [channel, offset] : chunk.index_offsets) {
      content.u16(channel);
      content.u64(offset);
    }
    content.u64(chunk.index_bytes);
    content.text("");
    content.u64(chunk.record_bytes);
    content.u64(chunk.record_bytes);
    put_record(kChunkIndex, content);
  }
}

void McapWriter::put_statistics() {
  McapBytes content;
  content.u64(num_messages_);
  content.u16(static_cast<std::uint16_t>(schemas_.size()));
  content.u32(static_cast<std::uint32_t>(channels_.size()));
  content.u32(0);  // attachments
  content.u32(0);  // metadata
  content.u32(static_cast<std::uint32_t>(chunks_.size()));
  content.u64(span_.first_ns);
  content.u64(span_.last_ns);
  content.u32(static_cast<std::uint32_t>(10 * num_written_.size()));
  for (std::size_t i = 0; i < num_written_.size(); ++i) {
    content.u16(static_cast<std::uint16_t>(i));
    content.u64(num_written_[i]);
  }
  put_record(kStatistics, content);
}

void McapWriter::close() {
  end_chunk();
  McapBytes end;
  end.u32(0);  // no checksum: the chunks have their own
  put_record(kDataEnd, end);

  const std::uint64_t summary_start = offset_;
  crc_ = 0;
  McapBytes offsets;
  std::uint64_t start = offset_;
  for (const McapBytes& schema : schemas_) put_record(kSchema, schema);
  end_summary_group(kSchema, start, &offsets);
  start = offset_;
  for (const McapBytes& channel : channels_) put_record(kTopic, channel);
  end_summary_group(kTopic, start, &offsets);
  start = offset_;
  put_statistics();
  end_summary_group(kStatistics, start, &offsets);
  start = offset_;
  put_chunk_indexes();
  end_summary_group(kChunkIndex, start, &offsets);
  const std::uint64_t offsets_start = offset_;
  put(offsets.all());

  // The checksum covers the footer up to itself.
  McapBytes footer;
  footer.u8(kFooter);
  footer.u64(8 + 8 + 4);
  footer.u64(summary_start);
  footer.u64(offsets_start);
  put(footer.all());
  McapBytes checksum;
  checksum.u32(crc_);
  put(checksum.all());
  put(kMagic);
  file_.close();
  if (!file_) throw InputError("cannot write " + path_.string() + " to its end");
}

void McapWriter::put(std::span<const std::uint8_t> bytes) {
  file_.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  if (!file_) throw InputError("cannot write " + path_.string() + " any further");
  crc_ = crc_of(crc_, bytes);
  offset_ += bytes.size();
}

void McapWriter::put_record(std::uint8_t opcode, const McapBytes& content) {
  McapBytes record;
  add_record(opcode, content.all(), &record);
  put(record.all());
}

}  // namespace plumb
