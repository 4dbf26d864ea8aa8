#include "modules/vehicle/dbc_signal_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include "core/input_error.hpp"

namespace plumb {
namespace {

constexpr std::uint32_t kExtendedFlag = 0x80000000U;
constexpr int kMostBits = 512;

/// A row of the database, cut to what a name or a number can need.
using DbcLine = std::array<char, 512>;
using DbcWord = std::array<char, 128>;

/// Takes the next line off `text`. Returns false at the end.
bool next_line(std::string_view* text, DbcLine* line) {
  if (text->empty()) return false;
  const std::size_t end = text->find('\n');
  const std::string_view whole = text->substr(0, end);
  const std::size_t length = std::min(whole.size(), line->size() - 1);
  std::memcpy(line->data(), whole.data(), length);
  (*line)[length] = '\0';
  text->remove_prefix(end == std::string_view::npos ? text->size() : end + 1);
  return true;
}

/// True when the line is the row of the signal; throws when it cannot be read.
bool read_signal_row(const DbcLine& line, const std::string& wanted, const std::string& at,
                     DbcSignal* signal) {
  DbcWord name{};
  DbcWord next{};
  if (std::sscanf(line.data(), " SG_ %127s %127s", name.data(), next.data()) != 2) return false;
  if (wanted != name.data()) return false;
  if (std::strcmp(next.data(), ":") != 0 && std::strcmp(next.data(), "M") != 0)
    throw InputError(at + ": the signal " + wanted + " is multiplexed; name one that always holds");
  const char* colon = std::strchr(line.data(), ':');
  int order = 0;
  char sign = 0;
  DbcWord unit{};
  const int num_read =
      colon == nullptr
          ? 0
          : std::sscanf(colon, ": %d|%d@%d%c (%lf,%lf) [%lf|%lf] \"%127[^\"]\"", &signal->start_bit,
                        &signal->num_bits, &order, &sign, &signal->factor, &signal->offset,
                        &signal->min, &signal->max, unit.data());
  const bool is_finite = std::isfinite(signal->factor) && std::isfinite(signal->offset) &&
                         std::isfinite(signal->min) && std::isfinite(signal->max);
  if (num_read < 8 || !is_finite)
    throw InputError(at + ": the row of the signal " + wanted + " cannot be read");
  signal->is_intel = order == 1;
  signal->is_signed = sign == '-';
  signal->unit = unit.data();
  return true;
}

void check_bits(const DbcSignal& signal, const std::string& at) {
  const bool sized = signal.num_bits >= 1 && signal.num_bits <= 64 && signal.start_bit >= 0 &&
                     signal.start_bit < kMostBits;
  const int last = sized ? signal.place_of_bit(signal.is_intel ? signal.num_bits - 1 : 0) : 0;
  if (!sized || last < 0 || last >= kMostBits)
    throw InputError(at + ": the signal does not fit a CAN frame");
}

struct SpeedUnit {
  const char* name;
  double m_s;
};
constexpr std::array<SpeedUnit, 7> kSpeedUnits{{{"m/s", 1.0},
                                                {"km/h", 1.0 / 3.6},
                                                {"kmh", 1.0 / 3.6},
                                                {"kph", 1.0 / 3.6},
                                                {"KPH", 1.0 / 3.6},
                                                {"mph", 0.44704},
                                                {"MPH", 0.44704}}};

double in_m_s(const std::string& unit, const std::string& at) {
  for (const SpeedUnit& known : kSpeedUnits) {
    if (unit == known.name) return known.m_s;
  }
  throw InputError(at + " has the unit \"" + unit + "\", which is not m/s, km/h or mph");
}

}  // namespace

DbcSignal find_dbc_signal(std::string_view text, const std::string& name, const std::string& file) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos)
    throw InputError("vehicle_speed.signal \"" + name + "\" is not Message.Signal");
  const std::string message = name.substr(0, dot);
  const std::string wanted = name.substr(dot + 1);
  DbcSignal signal;
  bool is_inside = false;
  bool has_message = false;
  int number = 0;
  for (DbcLine line{}; next_line(&text, &line);) {
    ++number;
    const std::string at = file + ":" + std::to_string(number);
    unsigned long id = 0;
    DbcWord found{};
    if (std::sscanf(line.data(), "BO_ %lu %127[^: ]", &id, found.data()) == 2) {
      is_inside = message == found.data();
      has_message = has_message || is_inside;
      signal.extended = (id & kExtendedFlag) != 0;
      signal.id = static_cast<std::uint32_t>(id) & ~kExtendedFlag;
    } else if (is_inside && read_signal_row(line, wanted, at, &signal)) {
      check_bits(signal, at);
      return signal;
    }
  }
  throw InputError(file + (has_message ? ": the message " + message + " has no signal " + wanted
                                       : ": no message " + message));
}

DbcSignal load_speed_signal(const VehicleSpeedConfig& config) {
  if (config.dbc_file.empty()) throw InputError("vehicle_speed.dbc_file states no CAN database");
  if (config.signal.empty()) throw InputError("vehicle_speed.signal states no signal");
  std::ifstream file(config.dbc_file);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file || text.empty()) throw InputError("cannot read " + config.dbc_file);
  DbcSignal signal = find_dbc_signal(text, config.signal, config.dbc_file);
  const double m_s = in_m_s(signal.unit, config.dbc_file + ": the signal " + config.signal);
  for (double* value : {&signal.factor, &signal.offset, &signal.min, &signal.max}) *value *= m_s;
  signal.unit = "m/s";
  return signal;
}

}  // namespace plumb
