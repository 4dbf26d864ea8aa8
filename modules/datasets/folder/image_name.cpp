#include "modules/datasets/folder/image_name.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "modules/datasets/number_file.hpp"

namespace plumb {
namespace {

constexpr std::size_t kMostDigits = 18;  // what std::int64_t holds
constexpr std::int64_t kMostFramesPerImage = 10;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::int64_t to_number(const std::string& digits) {
  std::int64_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return number;
}

std::vector<NamePiece> split_name(const std::string& stem) {
  std::vector<NamePiece> pieces;
  auto at = stem.begin();
  do {
    const auto number = std::find_if(at, stem.end(), is_digit);
    const auto end = std::find_if_not(number, stem.end(), is_digit);
    auto first = std::find_if(number, end, [](char c) { return c != '0'; });
    if (first == end && number != end) --first;  // the number is 0
    NamePiece piece;
    piece.text.assign(at, number);
    piece.digits.assign(first, end);
    piece.num_digits = piece.digits.size();
    pieces.push_back(std::move(piece));
    at = end;
  } while (at != stem.end());
  return pieces;
}

/// Without leading zeros, each of these lengths means a time from 2001 on.
std::optional<std::int64_t> parse_time_us(const std::string& text) {
  if (text.empty() || text.front() == '0') return {};
  const std::size_t point = text.find('.');
  if (point == 10 && text.size() > 11) {
    const std::optional<double> time_s = parse_number(text);  // nothing when a second point follows
    return time_s ? std::optional(std::llround(*time_s * 1e6)) : std::nullopt;
  }
  if (point != std::string::npos) return {};
  if (text.size() == 19) return to_number(text.substr(0, 16));
  if (text.size() == 16) return to_number(text);
  if (text.size() == 13) return 1000 * to_number(text);
  return {};
}

/// Index of the only piece whose number differs between the names, or nothing.
std::optional<std::size_t> find_counter(const std::vector<ImageName>& names) {
  const std::vector<NamePiece>& first = names.front().pieces;
  std::optional<std::size_t> counter;
  for (const ImageName& name : names) {
    if (name.pieces.size() != first.size()) return {};
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (name.pieces[i].text != first[i].text) return {};
      if (name.pieces[i].digits == first[i].digits) continue;
      if (counter.value_or(i) != i) return {};
      counter = i;
    }
  }
  return counter;
}

}  // namespace

ImageName read_image_name(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  const std::size_t before = stem.find_last_not_of("0123456789.") + 1;
  ImageName name{path, split_name(stem), parse_time_us(stem.substr(before)), {}};
  name.before_time = stem.substr(0, before);
  return name;
}

std::int64_t common_step(const std::vector<std::int64_t>& numbers) {
  std::int64_t step = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i)
    step = std::gcd(step, numbers[i] - numbers[i - 1]);
  return std::max<std::int64_t>(step, 1);
}

std::optional<std::vector<std::int64_t>> count_by_names(const std::vector<ImageName>& names) {
  const std::optional<std::size_t> counter = find_counter(names);
  if (!counter) return {};
  std::vector<std::int64_t> numbers;
  for (const ImageName& name : names) {
    const std::string& digits = name.pieces[*counter].digits;
    if (digits.empty() || digits.size() > kMostDigits) return {};
    numbers.push_back(to_number(digits));
    if (numbers.size() > 1 && numbers.back() <= numbers[numbers.size() - 2]) return {};
  }
  const std::int64_t num_frames = (numbers.back() - numbers.front()) / common_step(numbers) + 1;
  if (num_frames > kMostFramesPerImage * static_cast<std::int64_t>(numbers.size())) return {};
  return numbers;
}

bool are_named_by_time(const std::vector<ImageName>& names) {
  return std::all_of(names.begin(), names.end(), [&](const ImageName& name) {
    return name.time_us && name.before_time == names.front().before_time;
  });
}

}  // namespace plumb
