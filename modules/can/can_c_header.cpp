#include "modules/can/can_c_header.hpp"

#include <algorithm>
#include <cctype>

#include "modules/can/can_text.hpp"

namespace plumb {
namespace {

using can_text::join;

constexpr const char* kHeaderHead =
    R"(/* Plumbline's CAN messages for receivers in C99, printed by plumb-can --print-c-header.
 *
 * plumbline_MESSAGE_unpack() reads the raw values of a message, ..._SIGNAL_decode() makes one physical,
 * and ..._SIGNAL_is_in_range() says whether it is available. The frame must have passed its E2E check.
 * An object's message carries its index; the same members serve all indices.
 */
#ifndef PLUMBLINE_H
#define PLUMBLINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* `length` bits from `start` on, counted from the least significant bit of byte 0. */
static inline uint32_t plumbline_bits(const uint8_t *src_p, unsigned start, unsigned length)
{
    uint32_t value = 0u;
    for (unsigned i = 0u; i < length; ++i) {
        const unsigned at = start + i;
        value |= (uint32_t)((src_p[at / 8u] >> (at % 8u)) & 1u) << i;
    }
    return value;
}
)";

constexpr const char* kHeaderFoot = R"(
#ifdef __cplusplus
}
#endif

#endif
)";

/// "PLB_EgoMotion" -> "plb_ego_motion"
std::string snake_case(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto is = [&](std::size_t at, int (*test)(int)) {
      return at < name.size() && test(static_cast<unsigned char>(name[at])) != 0;
    };
    const bool begins = i > 0 && is(i, std::isupper) &&
                        (is(i - 1, std::islower) || is(i - 1, std::isdigit) ||
                         (is(i - 1, std::isupper) && is(i + 1, std::islower)));
    if (begins && text.back() != '_') text += '_';
    text += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return text;
}

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// The name of a signal; that of an object's has no index.
std::string member_of(const Signal& signal) {
  std::string name = signal.name;
  name.erase(std::remove(name.begin(), name.end(), '#'), name.end());
  return snake_case(name);
}

const char* type_of(const Signal& signal) {
  return signal.layout.length <= 8    ? "uint8_t"
         : signal.layout.length <= 16 ? "uint16_t"
                                      : "uint32_t";
}

std::string unsigned_text(std::uint64_t value) { return join("(", std::to_string(value), "u)"); }

std::string define(const std::string& name, const std::string& value) {
  return join("#define ", capitals(name), " ", value, "\n");
}

/// A number that C reads as a double.
std::string double_text(double value) {
  std::string text = can_text::number_text(value);
  if (text.find('.') == std::string::npos) text += ".0";
  return text;
}

std::string defines(const std::string& prefix, const Message& message) {
  const CanAddress& address = message.address;
  std::string text = join(define(prefix + "_frame_id", unsigned_text(address.id)),
                          define(prefix + "_length", unsigned_text(kMessageBytes)),
                          define(prefix + "_is_extended", address.extended ? "(1)" : "(0)"),
                          define(prefix + "_cycle_time_ms",
                                 unsigned_text(static_cast<std::uint64_t>(address.cycle_ms))),
                          define(prefix + "_e2e_data_id", unsigned_text(address.data_id)));
  for (const Signal& signal : message.signals) {
    const std::string name = join(prefix, "_", member_of(signal));
    const std::vector<std::string> words = can_text::value_names(signal);
    for (std::size_t i = 0; i < words.size(); ++i)
      text += define(join(name, "_", words[i], "_choice"), unsigned_text(i));
    if (can_text::has_sna(signal))
      text += define(name + "_sna_choice", unsigned_text(sna_raw(signal.layout)));
  }
  return text;
}

std::string structure(const std::string& prefix, const Message& message) {
  std::string text = join("struct ", prefix, "_t {\n");
  for (const Signal& signal : message.signals) {
    const std::string unit = signal.unit;
    text += join("    ", type_of(signal), " ", member_of(signal), ";  /* ",
                 can_text::number_text(signal.layout.factor), " ", unit.empty() ? "-" : unit,
                 ", offset ", can_text::number_text(signal.layout.offset), " */\n");
  }
  return text + "};\n";
}

std::string unpack_function(const std::string& prefix, const Message& message) {
  std::string text = join("static inline int ", prefix, "_unpack(struct ", prefix,
                          "_t *dst_p, const uint8_t *src_p, size_t size)\n{\n    if (size < ",
                          std::to_string(kMessageBytes), "u) {\n        return -1;\n    }\n");
  for (const Signal& signal : message.signals) {
    text += join("    dst_p->", member_of(signal), " = (", type_of(signal),
                 ")plumbline_bits(src_p, ", std::to_string(signal.layout.start_bit), "u, ",
                 std::to_string(signal.layout.length), "u);\n");
  }
  return text + "    return 0;\n}\n";
}

/// C compilers warn of a comparison that no value of the type can fail.
std::string range_test(const Signal& signal) {
  const int type_bits = signal.layout.length <= 8 ? 8 : signal.layout.length <= 16 ? 16 : 32;
  const std::uint64_t most = max_raw(signal.layout);
  if (most + 1 == std::uint64_t{1} << static_cast<unsigned>(type_bits)) return "(void)value, true";
  return join("value <= ", std::to_string(most), "u");
}

std::string signal_functions(const std::string& prefix, const Signal& signal) {
  const std::string name = join(prefix, "_", member_of(signal));
  const std::string head = join("(", type_of(signal), " value)\n{\n    return ");
  return join("static inline double ", name, "_decode", head, "(double)value * ",
              double_text(signal.layout.factor), " + (", double_text(signal.layout.offset),
              ");\n}\nstatic inline bool ", name, "_is_in_range", head, range_test(signal),
              ";\n}\n");
}

}  // namespace

std::string render_c_header(const CanConfig& config, const Messages& messages) {
  std::string text = kHeaderHead;
  text += join("\n#define PLUMBLINE_DATABASE_VERSION ", unsigned_text(kDatabaseVersion), "\n");
  for (const Message& message : messages) {
    const std::string prefix =
        join("plumbline_", snake_case(join(config.node, "_", message.row->name)));
    text += join("\n/* ", message.row->comment, " */\n", defines(prefix, message), "\n",
                 structure(prefix, message), "\n", unpack_function(prefix, message));
    for (const Signal& signal : message.signals) text += signal_functions(prefix, signal);
  }
  return text + kHeaderFoot;
}

}  // namespace plumb
