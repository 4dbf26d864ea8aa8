/// What a page asks the server for, in one line of text: "ack 12", "frame 340".
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>

namespace plumb {

struct PageRequest {
  enum class Kind : std::uint8_t { kNone, kAcknowledge, kFrame };
  Kind kind = Kind::kNone;
  std::int64_t number = -1;  ///< never negative with a kind
};

/// Reads a request; kNone for whatever is not exactly one.
[[nodiscard]] inline PageRequest read_page_request(std::string_view text) {
  const auto space = text.find(' ');
  if (space == std::string_view::npos) return {};
  PageRequest request;
  const std::string_view word = text.substr(0, space);
  if (word == "ack") request.kind = PageRequest::Kind::kAcknowledge;
  if (word == "frame") request.kind = PageRequest::Kind::kFrame;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + space + 1, end, request.number);
  if (read.ec != std::errc{} || read.ptr != end || request.number < 0) return {};
  return request;
}

}  // namespace plumb
