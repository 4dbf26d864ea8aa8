#include "modules/datasets/file_bytes.hpp"

#include <fstream>
#include <iterator>

#include "core/input_error.hpp"

namespace plumb {

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw InputError("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace plumb
