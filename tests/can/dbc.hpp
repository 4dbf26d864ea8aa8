/// A small reader of DBC files, with which the tests compare the text with the C++ tables.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace plumb::test {

struct DbcSignal {
  std::string name;
  std::string multiplexing;  ///< "", "M", "m3"
  int start_bit = 0;
  int length = 0;
  bool is_intel = false;
  bool is_signed = false;
  double factor = 0.0;
  double offset = 0.0;
  double min = 0.0;
  double max = 0.0;
  std::string unit;
  std::string comment;
  std::map<std::string, std::string> attributes;
  std::map<long, std::string> values;  ///< VAL_
};

struct DbcMessage {
  unsigned id = 0;
  std::string name;
  int bytes = 0;
  std::string comment;
  std::map<std::string, std::string> attributes;
  std::vector<DbcSignal> signals;

  [[nodiscard]] DbcSignal* find(const std::string& signal);
};

struct Dbc {
  std::string version;
  std::map<unsigned, DbcMessage> messages;
};

[[nodiscard]] Dbc read_dbc(const std::string& text);

}  // namespace plumb::test
