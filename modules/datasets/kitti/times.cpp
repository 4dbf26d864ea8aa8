#include "modules/datasets/kitti/times.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/input_error.hpp"
#include "modules/datasets/kitti/sequence.hpp"
#include "modules/datasets/number_file.hpp"

namespace plumb {
namespace {

constexpr double kLongestDrive_s = 1e7;

/// Microseconds since 1970-01-01, or -1 when the text is not a time.
std::int64_t parse_timestamp_us(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, length = 0;
  double second = 0.0;
  if (std::sscanf(text.c_str(), "%4d-%2d-%2d %2d:%2d:%lf%n", &year, &month, &day, &hour, &minute,
                  &second, &length) != 6 ||
      text.find_first_not_of(" \t", static_cast<std::size_t>(length)) != std::string::npos) {
    return -1;
  }
  using namespace std::chrono;
  const year_month_day date(std::chrono::year(year),
                            std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day)));
  const bool clock_ok =
      hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0 && second < 61.0;
  if (!date.ok() || year < 1970 || !clock_ok) return -1;
  const auto whole = sys_days(date).time_since_epoch() + hours(hour) + minutes(minute);
  return duration_cast<microseconds>(whole).count() + std::llround(second * 1e6);
}

}  // namespace

std::vector<std::int64_t> read_odometry_times_us(const std::filesystem::path& path) {
  std::vector<std::int64_t> times_us;
  for (const NumberRow& row : read_number_rows(path, 1, 1)) {
    const double time_s = row.values.front();
    if (time_s < 0.0 || time_s > kLongestDrive_s) {
      throw InputError(path.string() + ":" + std::to_string(row.line) +
                       ": time is outside [0, 1e7] s");
    }
    times_us.push_back(kOdometryEpoch_us + std::llround(time_s * 1e6));
  }
  return times_us;
}

std::vector<std::int64_t> read_raw_times_us(const std::filesystem::path& path) {
  std::vector<std::int64_t> times_us;
  int line = 0;
  for (const std::string& text : read_lines(path)) {
    ++line;
    if (text.empty()) continue;
    times_us.push_back(parse_timestamp_us(text));
    if (times_us.back() < 0) {
      throw InputError(path.string() + ":" + std::to_string(line) + ": '" + text +
                       "' is not a time (2011-09-26 13:02:25.964389445)");
    }
  }
  return times_us;
}

}  // namespace plumb
