/// Writes a text file row by row and reports failures at once.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace plumb {

class TextOutput {
 public:
  /// With an empty path, the output takes rows and writes nothing. Throws InputError.
  explicit TextOutput(const std::filesystem::path& path);
  /// Throws InputError ("cannot write FILE"), for example on a full disk.
  void row(const std::string& text);
  /// Throws InputError when the last rows did not reach the file.
  void close();
  [[nodiscard]] bool wanted() const { return !path_.empty(); }

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace plumb
