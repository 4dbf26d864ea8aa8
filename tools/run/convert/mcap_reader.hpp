/// Reads the messages of an MCAP file (mcap.dev/spec) from front to back: plain, or in chunks that
/// are plain or compressed with zstd or lz4.
///
/// Errors:
///   Functions throw InputError ("FILE: byte OFFSET: reason") for what breaks the format. Every
///   length is checked before it is used.
/// Memory:
///   One chunk.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

struct McapChannel {
  std::string topic;
  std::string encoding;  ///< of the messages: "cdr", "json", "protobuf"
  std::string schema;    ///< the name of their type
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::span<const std::uint8_t> data;  ///< valid until the next call
};

class McapReader {
 public:
  explicit McapReader(const std::string& path);

  /// Reads the next message. Returns false at the end of the data.
  [[nodiscard]] bool next(McapMessage* message);

  /// The channels as far as they are known: those in the summary, and those that came before the
  /// newest message.
  [[nodiscard]] const std::map<std::uint16_t, McapChannel>& channels() const { return channels_; }
  /// Messages of a channel as the summary counts them; 0 when it does not say.
  [[nodiscard]] std::int64_t num_messages(std::uint16_t channel) const;

 private:
  [[noreturn]] void fail(const std::string& reason) const;
  bool read_record(std::uint8_t* opcode);
  void read_summary();
  void take_record(std::uint8_t opcode, std::span<const std::uint8_t> content);
  void open_chunk(std::span<const std::uint8_t> content);
  bool next_in_chunk(McapMessage* message);
  bool take_message(std::span<const std::uint8_t> content, McapMessage* message) const;

  std::string path_;
  std::ifstream file_;
  std::uint64_t file_bytes_ = 0;
  std::uint64_t offset_ = 0;  ///< of the next record
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::vector<std::uint8_t> record_;  ///< content of the newest record
  std::vector<std::uint8_t> chunk_;   ///< records of the chunk that is being read
  std::size_t chunk_at_ = 0;
};

}  // namespace plumb
