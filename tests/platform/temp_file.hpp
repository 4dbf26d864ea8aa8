/// A file with given content in the test's scratch folder, gone with the object.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace plumb::test {

class TempFile {
 public:
  explicit TempFile(const std::string& suffix, const std::string& content = "") {
    static std::atomic<int> count{0};
    path_ = (std::filesystem::temp_directory_path() /
             ("plumb_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++) + suffix))
                .string();
    write(content);
  }
  ~TempFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TempFile(const TempFile&) = delete;
  TempFile& operator=(const TempFile&) = delete;

  void write(const std::string& content) const {
    std::ofstream(path_, std::ios::binary) << content;
  }
  [[nodiscard]] std::string read() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace plumb::test
