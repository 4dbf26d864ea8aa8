#include "tests/can/dbc.hpp"

#include <regex>
#include <sstream>

namespace plumb::test {
namespace {

const std::regex kVersion(R"re(VERSION "(.*)")re");
const std::regex kMessage(R"re(BO_ (\d+) (\w+): (\d+) \w+)re");
const std::regex kSignal(R"re( SG_ (\w+)(?: (M|m\d))? : (\d+)\|(\d+)@([01])([+-]) )re"
                         R"re(\(([-0-9.eE]+),([-0-9.eE]+)\) \[([-0-9.eE]+)\|([-0-9.eE]+)\] )re"
                         R"re("(.*)" \w+)re");
const std::regex kMessageComment(R"re(CM_ BO_ (\d+) "(.*)";)re");
const std::regex kSignalComment(R"re(CM_ SG_ (\d+) (\w+) "(.*)";)re");
const std::regex kMessageAttribute(R"re(BA_ "(\w+)" BO_ (\d+) "?([^"]*)"?;)re");
const std::regex kSignalAttribute(R"re(BA_ "(\w+)" SG_ (\d+) (\w+) "?([^"]*)"?;)re");
const std::regex kValues(R"re(VAL_ (\d+) (\w+) (.*) ;)re");
const std::regex kValue(R"re((\d+) "([^"]*)")re");

unsigned id_of(const std::string& text) { return static_cast<unsigned>(std::stoul(text)); }

DbcSignal signal_of(const std::smatch& m) {
  DbcSignal s;
  s.name = m[1];
  s.multiplexing = m[2];
  s.start_bit = std::stoi(m[3]);
  s.length = std::stoi(m[4]);
  s.is_intel = m[5] == "1";
  s.is_signed = m[6] == "-";
  s.factor = std::stod(m[7]);
  s.offset = std::stod(m[8]);
  s.min = std::stod(m[9]);
  s.max = std::stod(m[10]);
  s.unit = m[11];
  return s;
}

void read_details(const std::string& line, Dbc* dbc) {
  std::smatch m;
  if (std::regex_match(line, m, kMessageComment)) {
    dbc->messages[id_of(m[1])].comment = m[2];
  } else if (std::regex_match(line, m, kSignalComment)) {
    if (DbcSignal* s = dbc->messages[id_of(m[1])].find(m[2])) s->comment = m[3];
  } else if (std::regex_match(line, m, kMessageAttribute)) {
    dbc->messages[id_of(m[2])].attributes[m[1]] = m[3];
  } else if (std::regex_match(line, m, kSignalAttribute)) {
    if (DbcSignal* s = dbc->messages[id_of(m[2])].find(m[3])) s->attributes[m[1]] = m[4];
  } else if (std::regex_match(line, m, kValues)) {
    DbcSignal* s = dbc->messages[id_of(m[1])].find(m[2]);
    const std::string list = m[3];
    for (std::sregex_iterator i(list.begin(), list.end(), kValue), end; s != nullptr && i != end;
         ++i) {
      s->values[std::stol((*i)[1])] = (*i)[2];
    }
  }
}

}  // namespace

DbcSignal* DbcMessage::find(const std::string& signal) {
  for (DbcSignal& s : signals) {
    if (s.name == signal) return &s;
  }
  return nullptr;
}

Dbc read_dbc(const std::string& text) {
  Dbc dbc;
  std::istringstream file(text);
  DbcMessage* message = nullptr;
  for (std::string line; std::getline(file, line);) {
    std::smatch m;
    if (std::regex_match(line, m, kVersion)) {
      dbc.version = m[1];
    } else if (std::regex_match(line, m, kMessage)) {
      message = &dbc.messages[id_of(m[1])];
      message->id = id_of(m[1]);
      message->name = m[2];
      message->bytes = std::stoi(m[3]);
    } else if (message != nullptr && std::regex_match(line, m, kSignal)) {
      message->signals.push_back(signal_of(m));
    } else {
      read_details(line, &dbc);
    }
  }
  return dbc;
}

}  // namespace plumb::test
