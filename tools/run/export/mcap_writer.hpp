/// Writes MCAP files (mcap.dev/spec): messages in chunks with an index, so that readers seek, and a
/// summary with statistics. Chunks are not compressed, because images already are.
///
/// Errors:
///   Functions throw InputError ("cannot write FILE") when the file cannot be written.
/// Memory:
///   One chunk of about 1 MiB, and 16 bytes per message of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plumb {

/// Little-endian bytes of MCAP records.
class McapBytes {
 public:
  void u8(std::uint8_t value) { number(value, 1); }
  void u16(std::uint16_t value) { number(value, 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  /// The number of bytes (32 bits), then the bytes.
  void text(std::string_view value);
  void bytes(std::span<const std::uint8_t> value) {
    bytes_.insert(bytes_.end(), value.begin(), value.end());
  }
  void clear() { bytes_.clear(); }
  [[nodiscard]] const std::vector<std::uint8_t>& all() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

 private:
  void number(std::uint64_t value, int num_bytes) {
    for (int i = 0; i < num_bytes; ++i)
      bytes_.push_back(static_cast<std::uint8_t>(value >> static_cast<unsigned>(8 * i)));
  }
  std::vector<std::uint8_t> bytes_;
};

class McapWriter {
 public:
  using Words = std::map<std::string, std::string>;

  /// Creates or replaces the file.
  /// @param profile  "ros2", or empty
  McapWriter(const std::filesystem::path& path, std::string_view profile, std::string_view library);

  /// Adds the definition of a type and returns its number.
  [[nodiscard]] std::uint16_t add_schema(std::string_view name, std::string_view encoding,
                                         std::string_view definition);
  /// Adds a topic and returns its number.
  [[nodiscard]] std::uint16_t add_channel(std::string_view topic, std::string_view encoding,
                                          std::uint16_t schema, const Words& metadata = {});
  /// @param time_ns  both log and publish time
  void write(std::uint16_t channel, std::uint64_t time_ns, std::span<const std::uint8_t> message);
  /// Writes index and summary and closes the file.
  void close();

  [[nodiscard]] std::uint64_t num_messages() const { return num_messages_; }

 private:
  struct Span {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    void add(std::uint64_t time_ns, bool is_first);
  };
  struct ChunkPlace {
    Span span;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::map<std::uint16_t, std::uint64_t> index_offsets;
    std::uint64_t index_bytes = 0;
    std::uint64_t record_bytes = 0;
  };
  void put(std::span<const std::uint8_t> bytes);
  void put_record(std::uint8_t opcode, const McapBytes& content);
  void end_chunk();
  void end_summary_group(std::uint8_t opcode, std::uint64_t start, McapBytes* offsets) const;
  void put_chunk_indexes();
  void put_statistics();

  std::filesystem::path path_;
  std::ofstream file_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;                   ///< of what was put since it was last set to 0
  std::vector<McapBytes> schemas_;          ///< contents, for the summary
  std::vector<McapBytes> channels_;         ///< contents, for the summary
  std::vector<std::uint32_t> num_written_;  ///< per channel, which is also the next sequence number
  McapBytes chunk_;                         ///< records of the chunk that is being filled
  Span chunk_span_;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_index_;
  std::vector<ChunkPlace> chunks_;
  std::uint64_t num_messages_ = 0;
  Span span_;
};

}  // namespace plumb
