/// A ConfigReader that requires every key.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "platform/config.hpp"

namespace plumb {

/// Reads fields as ConfigReader does, and throws ConfigError for a key that the file lacks.
class CompleteReader {
 public:
  CompleteReader(const std::string& path, ConfigFile* file)
      : path_(path), file_(file), reader_(file) {}

  template <typename T, typename... Rest>
  void operator()(const char* key, T& value, Rest&&... rest) {
    need(key);
    reader_(key, value, std::forward<Rest>(rest)...);
  }
  void operator()(const char* key, std::string& value, const std::vector<std::string>& choices,
                  const char* meaning) {
    need(key);
    reader_(key, value, choices, meaning);
  }

 private:
  void need(const char* key) const {
    if (!file_->has(key)) throw ConfigError(path_ + ": " + key + " is missing");
  }
  const std::string& path_;
  ConfigFile* file_;
  ConfigReader reader_;
};

}  // namespace plumb
