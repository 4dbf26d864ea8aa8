#include "modules/can/can_dbc.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "modules/can/can_load.hpp"
#include "modules/can/can_text.hpp"

namespace plumb {
namespace {

using can_text::has_sna;
using can_text::join;
using can_text::number_text;
using can_text::with_index;

constexpr const char* kHead =
    "NS_ :\n\tCM_\n\tBA_DEF_\n\tBA_\n\tVAL_\n\tBA_DEF_DEF_\n\n"
    "BS_:\n\n";

constexpr const char* kAttributeDefinitions =
    "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\n"
    "BA_DEF_ BO_ \"GenMsgSendType\" ENUM \"Cyclic\",\"CyclicAndSpontaneous\",\"NoMsgSendType\";\n"
    "BA_DEF_ BO_ \"E2EProfile\" STRING ;\n"
    "BA_DEF_ BO_ \"E2EDataID\" INT 0 65535;\n"
    "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"StandardCAN_FD\";\n"
    "BA_DEF_ SG_ \"GenSigStartValue\" INT 0 16777215;\n"
    "BA_DEF_ SG_ \"GenSigInactiveValue\" INT 0 16777215;\n"
    "BA_DEF_ \"BusType\" STRING ;\n"
    "BA_DEF_ \"DBName\" STRING ;\n"
    "BA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n"
    "BA_DEF_DEF_ \"GenMsgSendType\" \"Cyclic\";\n"
    "BA_DEF_DEF_ \"E2EProfile\" \"\";\n"
    "BA_DEF_DEF_ \"E2EDataID\" 0;\n"
    "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\n"
    "BA_DEF_DEF_ \"GenSigStartValue\" 0;\n"
    "BA_DEF_DEF_ \"GenSigInactiveValue\" 0;\n"
    "BA_DEF_DEF_ \"BusType\" \"CAN\";\n"
    "BA_DEF_DEF_ \"DBName\" \"plumbline\";\n"
    "BA_ \"BusType\" \"CAN\";\n"
    "BA_ \"DBName\" \"plumbline\";\n";

/// One signal as a DBC has it: of an object's signal there is one for every index.
struct DbcSignal {
  const Signal* row;
  std::string name;
  std::string comment;
  std::string multiplexing;  ///< "", "M", "m3"
};

std::string comment_of(const Signal& signal) {
  std::string text = signal.comment;
  if (!has_sna(signal)) return text;
  return join(text, " All ones: not available", *signal.absence != '\0' ? ", " : "", signal.absence,
              ".");
}

std::vector<DbcSignal> signals_of(const Message& message) {
  std::vector<DbcSignal> all;
  for (const Signal& row : message.signals) {
    if (source_of(row) == CanSource::kObject) continue;
    all.push_back(
        {&row, row.name, comment_of(row), is_framing(row, Framing::kObjectIndex) ? "M" : ""});
  }
  if (message.row->trigger != CanTrigger::kObject) return all;
  for (std::size_t k = 0; k < kMaxCanObjects; ++k) {
    for (const Signal& row : message.signals) {
      if (source_of(row) != CanSource::kObject) continue;
      all.push_back({&row, with_index(row.name, k), with_index(comment_of(row), k),
                     join("m", std::to_string(k))});
    }
  }
  return all;
}

std::string id_text(const Message& message) {
  constexpr std::uint32_t kExtended = 0x80000000U;
  return std::to_string(message.address.extended ? message.address.id | kExtended
                                                 : message.address.id);
}

std::string signal_line(const DbcSignal& signal) {
  const SignalLayout& l = signal.row->layout;
  return join(" SG_ ", signal.name, signal.multiplexing.empty() ? "" : " ", signal.multiplexing,
              " : ", std::to_string(l.start_bit), "|", std::to_string(l.length),
              l.order == ByteOrder::kIntel ? "@1+ (" : "@0+ (", number_text(l.factor), ",",
              number_text(l.offset), ") [", number_text(min_physical(l)), "|",
              number_text(max_physical(l)), "] \"", signal.row->unit, "\" Receiver\n");
}

std::string values_line(const Message& message, const DbcSignal& signal) {
  const Signal& row = *signal.row;
  std::string list;
  const std::vector<std::string> names = can_text::value_names(row);
  for (std::size_t i = 0; i < names.size(); ++i)
    list += join(" ", std::to_string(i), " \"", names[i], "\"");
  if (has_sna(row)) list += join(" ", std::to_string(sna_raw(row.layout)), " \"SNA\"");
  if (list.empty()) return "";
  return join("VAL_ ", id_text(message), " ", signal.name, list, " ;\n");
}

const char* send_type(const Message& message) {
  if (message.address.cycle_ms == 0) return "2";
  return message.row->trigger == CanTrigger::kNone ? "0" : "1";
}

std::string attribute_lines(const Message& message) {
  const std::string id = id_text(message);
  const CanAddress& address = message.address;
  std::string text =
      join("BA_ \"GenMsgCycleTime\" BO_ ", id, " ", std::to_string(address.cycle_ms), ";\n",  //
           "BA_ \"GenMsgSendType\" BO_ ", id, " ", send_type(message), ";\n",                 //
           "BA_ \"E2EProfile\" BO_ ", id, " \"PROFILE_11A\";\n",                              //
           "BA_ \"E2EDataID\" BO_ ", id, " ", std::to_string(address.data_id), ";\n",         //
           "BA_ \"VFrameFormat\" BO_ ", id, address.extended ? " 1;\n" : " 0;\n");
  for (const DbcSignal& signal : signals_of(message)) {
    if (!has_sna(*signal.row)) continue;
    const std::string raw = std::to_string(sna_raw(signal.row->layout));
    for (const char* const name : {"GenSigStartValue", "GenSigInactiveValue"}) {
      text += join("BA_ \"", name, "\" SG_ ", id, " ", signal.name, " ", raw, ";\n");
    }
  }
  return text;
}

/// The load of a bus of 500 kbit/s, in per cent.
std::string load_text(const Messages& messages, const CanTraffic& traffic) {
  return number_text(std::round(100.0 * max_bus_load(messages, traffic, 500e3)));
}

std::string database_comment(const CanConfig& config, const Messages& messages) {
  return join(
      "CM_ \"Plumbline: metric ego-motion and ground plane of one forward camera. Axes and signs "
      "per ISO 8855: x forward, y left, z up, rotations right-handed; SI units. Every signal is "
      "unsigned with an offset. All ones means not available, unless its comment says otherwise; a "
      "value outside the range is not available, too, unless its comment names a modulus or says "
      "that it stays. A value and its standard deviation are sent together or not at all. Every "
      "message is protected by AUTOSAR E2E profile 11A (CRC in byte 0, alive counter in byte 1). "
      "An image taken more than ",
      number_text(config.stale_s),
      " s ago (configurable) is sent as not available within one cycle; the mount check, which "
      "speaks "
      "once a second, when it is older than 3 s. The signals of objects are multiplexed by the "
      "object's index. Load of a bus of 500 kbit/s at 10 camera frames a second, with the most "
      "stuff bits: ",
      load_text(messages, {10.0, 0.0, 0}), " percent; with eight objects in every frame: ",
      load_text(messages, {10.0, 10.0, kMaxCanObjects}), " percent.\";\n");
}

}  // namespace

std::string render_dbc(const CanConfig& config, const Messages& messages) {
  std::string text = join("VERSION \"", std::to_string(kDatabaseVersion), "\"\n\n", kHead,
                          "BU_: ", config.node, " Receiver\n");
  std::string comments, attributes, values;
  for (const Message& message : messages) {
    const std::string id = id_text(message);
    text += join("\nBO_ ", id, " ", config.node, "_", message.row->name, ": ",
                 std::to_string(kMessageBytes), " ", config.node, "\n");
    comments += join("CM_ BO_ ", id, " \"", message.row->comment, "\";\n");
    for (const DbcSignal& signal : signals_of(message)) {
      text += signal_line(signal);
      comments += join("CM_ SG_ ", id, " ", signal.name, " \"", signal.comment, "\";\n");
      values += values_line(message, signal);
    }
    attributes += attribute_lines(message);
  }
  return join(text, "\n", database_comment(config, messages), comments, kAttributeDefinitions,
              attributes, values);
}

}  // namespace plumb
