#include "platform/config.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "platform/nearest_word.hpp"

namespace plumb {
namespace {

constexpr std::size_t kCommentColumn = 32;

std::string render(const toml::node& node) {
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << value; });
  return out.str();
}

struct Leaf {
  std::string key;
  toml::source_index line;
  bool is_section;
};

// Lists every value, and every table without values, by its dotted key.
std::vector<Leaf> leaves_of(const toml::table& root) {
  std::vector<Leaf> leaves;
  std::vector<std::pair<std::string, const toml::table*>> open = {{"", &root}};
  while (!open.empty()) {
    const auto [prefix, table] = open.back();
    open.pop_back();
    for (const auto& [name, node] : *table) {
      const std::string key = prefix + std::string(name.str());
      const toml::table* inner = node.as_table();
      if (inner != nullptr && !inner->empty()) {
        open.emplace_back(key + ".", inner);
      } else {
        leaves.push_back({key, node.source().begin.line, inner != nullptr});
      }
    }
  }
  return leaves;
}

}  // namespace

struct ConfigFile::Impl {
  std::string path;
  toml::table root;
  std::set<std::string> known;

  const toml::node* find(const char* key) {
    known.insert(key);
    return root.at_path(key).node();
  }
  [[noreturn]] void refuse(const char* key, const toml::node& node, const std::string& why) const {
    throw ConfigError(path + ":" + std::to_string(node.source().begin.line) + ": " + key + " = " +
                      render(node) + " " + why);
  }
  void check_range(const char* key, const toml::node& node, double value, double low,
                   double high) const {
    if (value >= low && value <= high) return;  // false for NaN
    refuse(key, node,
           "is outside [" + ConfigWriter::number(low, true) + ", " +
               ConfigWriter::number(high, true) + "]");
  }
};

ConfigFile::ConfigFile() : impl_(std::make_unique<Impl>()) {}
ConfigFile::~ConfigFile() = default;
ConfigFile::ConfigFile(ConfigFile&&) noexcept = default;

ConfigFile ConfigFile::load(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    // Copying an empty file also sets the fail bit, but an empty file is a valid configuration.
    if (!stream.is_open() || errno != 0)
      throw ConfigError("cannot read " + path + ": " + std::strerror(errno));
  }
  ConfigFile file;
  file.impl_->path = path;
  try {
    file.impl_->root = toml::parse(text.str());
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw ConfigError(path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) +
                      ": " + std::string(error.description()));
  }
  return file;
}

void ConfigFile::read(const char* key, double& value, double low, double high) {
  const toml::node* node = impl_->find(key);
  if (node == nullptr) return;
  if (!node->is_number()) impl_->refuse(key, *node, "is not a number");
  const double number = *node->value<double>();
  impl_->check_range(key, *node, number, low, high);
  value = number;
}

void ConfigFile::read(const char* key, int& value, double low, double high) {
  const toml::node* node = impl_->find(key);
  if (node == nullptr) return;
  if (!node->is_integer()) impl_->refuse(key, *node, "is not a whole number");
  const auto number = *node->value<std::int64_t>();
  impl_->check_range(key, *node, static_cast<double>(number), low, high);
  value = static_cast<int>(number);
}

void ConfigFile::read(const char* key, bool& value) {
  const toml::node* node = impl_->find(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) impl_->refuse(key, *node, "is neither true nor false");
  value = *node->value<bool>();
}

void ConfigFile::read(const char* key, std::string& value) {
  const toml::node* node = impl_->find(key);
  if (node == nullptr) return;
  if (!node->is_string()) impl_->refuse(key, *node, "is not text in quotes");
  value = *node->value<std::string>();
}

void ConfigFile::read(const char* key, std::string& value,
                      const std::vector<std::string>& choices) {
  std::string text = value;
  read(key, text);
  const toml::node* node = impl_->find(key);
  if (node == nullptr) return;
  if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
    impl_->refuse(key, *node, "is none of " + word_list(choices) + did_you_mean(text, choices));
  }
  value = text;
}

bool ConfigFile::has(const char* key) const { return impl_->root.at_path(key).node() != nullptr; }

void ConfigFile::refuse_unread() const {
  std::vector<Leaf> leaves = leaves_of(impl_->root);
  std::stable_sort(leaves.begin(), leaves.end(),
                   [](const Leaf& a, const Leaf& b) { return a.line < b.line; });
  for (const Leaf& leaf : leaves) {
    const auto next = impl_->known.lower_bound(leaf.key + ".");
    const bool owns_keys =
        next != impl_->known.end() && next->compare(0, leaf.key.size() + 1, leaf.key + ".") == 0;
    if (impl_->known.count(leaf.key) > 0 || (leaf.is_section && owns_keys)) continue;
    const std::vector<std::string> keys(impl_->known.begin(), impl_->known.end());
    throw ConfigError(impl_->path + ":" + std::to_string(leaf.line) + ": " + leaf.key +
                      (leaf.is_section ? " is not a known section" : " is not a known key") +
                      did_you_mean(leaf.key, keys));
  }
}

void ConfigWriter::operator()(const char* key, const std::string& value,
                              const std::vector<std::string>& choices, const char* meaning) {
  std::string list;
  for (const std::string& choice : choices) list += (list.empty() ? "" : ", ") + quoted(choice);
  add(key, quoted(value), meaning, "one of " + list);
}

std::string ConfigWriter::text() const {
  return "# Every setting of every plumb-* program with its default value. A file may contain any "
         "part of\n"
         "# it; a missing key keeps its default. Written by: plumb-vo --print-config\n" +
         sections();
}

std::string ConfigWriter::sections() const {
  std::string out;
  for (const auto& [name, lines] : sections_) {
    out += name.empty() ? "" : "\n[" + name + "]\n";
    out += lines;
  }
  return out;
}

std::string ConfigWriter::number(double value, bool whole) {
  std::array<char, 64> text{};
  char* const last = text.data() + text.size();
  const auto end = whole ? std::to_chars(text.data(), last, value, std::chars_format::fixed).ptr
                         : std::to_chars(text.data(), last, value).ptr;
  std::string out(text.data(), end);
  const bool bare = out.find_first_not_of("-0123456789") == std::string::npos;
  return !whole && bare ? out + ".0" : out;
}

std::string ConfigWriter::quoted(const std::string& text) {
  std::string out("\"");
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out.append(1, '\\').append(1, c);
    } else if (code < 0x20 || code == 0x7F) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04X", static_cast<unsigned>(code));
      out.append(escape.data());
    } else {
      out.append(1, c);
    }
  }
  return out.append(1, '"');
}

void ConfigWriter::add_number(const char* key, double value, double low, double high, bool whole,
                              const char* meaning) {
  std::string range("[");
  range.append(number(low, true)).append(", ").append(number(high, true)).append("]");
  add(key, number(value, whole), meaning, range);
}

void ConfigWriter::add(const std::string& key, const std::string& value, const std::string& meaning,
                       const std::string& range) {
  const std::size_t dot = key.rfind('.');
  const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
  auto found = std::find_if(sections_.begin(), sections_.end(),
                            [&section](const auto& s) { return s.first == section; });
  if (found == sections_.end()) {
    // TOML requires that keys outside any section come first.
    found = sections_.insert(section.empty() ? sections_.begin() : sections_.end(), {section, ""});
  }
  std::string line = (dot == std::string::npos ? key : key.substr(dot + 1)) + " = " + value;
  line.resize(std::max(line.size() + 1, kCommentColumn), ' ');
  found->second += line + "# " + range + " " + meaning + "\n";
}

}  // namespace plumb
