#include "platform/log.hpp"

#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>

#include "platform/clock.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kQuiet_us = 1'000'000;

struct Site {
  const char* format = nullptr;
  std::int64_t next_us = 0;
  std::int64_t num_suppressed = 0;
};

const char* g_name = "plumb";
std::array<Site, 32> g_sites;

void print(const char* format, std::va_list arguments, std::int64_t num_suppressed) {
  std::array<char, 512> line{};
  std::vsnprintf(line.data(), line.size(), format, arguments);
  if (num_suppressed > 0) {
    std::fprintf(stderr, "%s: %s (%lld more like it)\n", g_name, line.data(),
                 static_cast<long long>(num_suppressed));
  } else {
    std::fprintf(stderr, "%s: %s\n", g_name, line.data());
  }
}

// When the table is full, further formats share its last entry. Their lines are then suppressed
// together, but each is counted.
Site& site_of(const char* format) {
  for (Site& site : g_sites) {
    if (site.format == format) return site;
    if (site.format == nullptr) {
      site.format = format;
      return site;
    }
  }
  return g_sites.back();
}

}  // namespace

void set_log_name(const char* name) { g_name = name; }

void log_line(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  print(format, arguments, 0);
  va_end(arguments);
}

void log_limited(const char* format, ...) {
  Site& site = site_of(format);
  const std::int64_t now_us = monotonic_us();
  if (now_us < site.next_us) {
    ++site.num_suppressed;
    return;
  }
  std::va_list arguments;
  va_start(arguments, format);
  print(format, arguments, site.num_suppressed);
  va_end(arguments);
  site.num_suppressed = 0;
  site.next_us = now_us + kQuiet_us;
}

}  // namespace plumb
