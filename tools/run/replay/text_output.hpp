/// A text file that is written row by row and says at once when it cannot be.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace plumb {

class TextOutput {
 public:
  /// An empty path makes an output that takes everything and writes nothing. Throws InputError.
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
