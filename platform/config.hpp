/// Strict TOML configuration. Exactly one visit() owns each key,
/// and a wrong value is refused, never repaired.
///
/// Errors:
///   Every function that reads throws ConfigError. Its text names the file, the line, the key and
///   the allowed range.
/// Memory:
///   A ConfigFile allocates; it is used before a process begins to serve.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace plumb {

/// The exception for a wrong configuration. Programs print it and exit with 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A parsed TOML file and the keys that were read from it.
class ConfigFile {
 public:
  /// Reads and parses a file. Throws ConfigError ("cannot read F", "F:line:column: ...").
  static ConfigFile load(const std::string& path);
  ~ConfigFile();
  ConfigFile(ConfigFile&&) noexcept;

  /// Replaces `value` by the value of a dotted key when the file has that key. Throws ConfigError
  /// on a wrong type or range.
  void read(const char* key, double& value, double low, double high);
  void read(const char* key, int& value, double low, double high);
  void read(const char* key, bool& value);
  void read(const char* key, std::string& value);
  /// Reads a text that must be one of `choices`.
  void read(const char* key, std::string& value, const std::vector<std::string>& choices);

  /// Whether the file has a dotted key.
  [[nodiscard]] bool has(const char* key) const;

  /// Throws ConfigError for the first key that no read() asked for.
  void refuse_unread() const;

 private:
  ConfigFile();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A field visitor that reads a ConfigFile. Its calls are field(key, member, low, high, meaning)
/// for numbers, field(key, member, meaning) for bool and text, and field(key, member, choices,
/// meaning) for a text out of a list.
class ConfigReader {
 public:
  explicit ConfigReader(ConfigFile* file) : file_(file) {}
  template <typename T, typename L, typename H>
  requires std::is_arithmetic_v<L>
  void operator()(const char* key, T& value, L low, H high, const char* /*meaning*/) {
    file_->read(key, value, static_cast<double>(low), static_cast<double>(high));
  }
  template <typename T>
  void operator()(const char* key, T& value, const char* /*meaning*/) {
    file_->read(key, value);
  }
  void operator()(const char* key, std::string& value, const std::vector<std::string>& choices,
                  const char* /*meaning*/) {
    file_->read(key, value, choices);
  }

 private:
  ConfigFile* file_;
};

/// A field visitor that writes every key with its value, range and meaning as TOML that
/// ConfigReader accepts.
class ConfigWriter {
 public:
  template <typename T, typename L, typename H>
  requires std::is_arithmetic_v<L>
  void operator()(const char* key, const T& value, L low, H high, const char* meaning) {
    add_number(key, static_cast<double>(value), static_cast<double>(low), static_cast<double>(high),
               std::is_integral_v<T>, meaning);
  }
  void operator()(const char* key, const bool& value, const char* meaning) {
    add(key, value ? "true" : "false", meaning, "true or false");
  }
  void operator()(const char* key, const std::string& value, const char* meaning) {
    add(key, quoted(value), meaning, "text");
  }
  void operator()(const char* key, const std::string& value,
                  const std::vector<std::string>& choices, const char* meaning);

  /// The whole text: a remark, then one section per key prefix in the order of first appearance.
  [[nodiscard]] std::string text() const;
  /// The text without the remark.
  [[nodiscard]] std::string sections() const;

  /// The shortest text that reads back to the same number. A `whole` number is written without an
  /// exponent and without ".0".
  static std::string number(double value, bool whole);
  static std::string quoted(const std::string& text);

 private:
  void add_number(const char* key, double value, double low, double high, bool whole,
                  const char* meaning);
  void add(const std::string& key, const std::string& value, const std::string& meaning,
           const std::string& range);
  std::vector<std::pair<std::string, std::string>> sections_;  ///< name, lines
};

/// Writes `config` as TOML with a comment on every key.
/// config/default.toml is this text for the default values.
template <typename Config>
[[nodiscard]] std::string render_config(const Config& config) {
  ConfigWriter writer;
  Config::visit(config, writer);
  return writer.text();
}

/// Fills `config` from the file `path`, whose keys replace the values that are there. Throws
/// ConfigError.
template <typename Config>
void read_config(const std::string& path, Config* config) {
  ConfigFile file = ConfigFile::load(path);
  Config::visit(*config, ConfigReader(&file));
  file.refuse_unread();
}

/// Throws ConfigError when values that are each allowed contradict each other, where `Config` has a
/// contradiction() that says so. `path` names the last file that was read.
template <typename Config>
void refuse_contradiction(const std::string& path, const Config& config) {
  if constexpr (requires { config.contradiction(); }) {
    const std::string why = config.contradiction();
    if (!why.empty()) throw ConfigError(path + ": " + why);
  }
}

/// Reads one file and judges what comes out. An empty path changes nothing. Throws ConfigError.
template <typename Config>
void load_config(const std::string& path, Config* config) {
  if (path.empty()) return;
  read_config(path, config);
  refuse_contradiction(path, *config);
}

}  // namespace plumb
