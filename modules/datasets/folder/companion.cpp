#include "modules/datasets/folder/companion.hpp"

namespace plumb {

namespace fs = std::filesystem;

fs::path find_companion(const fs::path& recording, std::initializer_list<const char*> names) {
  fs::path inside = fs::absolute(recording).lexically_normal();
  if (fs::is_directory(inside)) inside /= "";  // so that its parent path is the folder itself
  inside = inside.parent_path();
  for (const fs::path& folder : {inside, inside.parent_path()}) {
    for (const char* name : names) {
      if (fs::is_regular_file(folder / name)) return folder / name;
    }
  }
  return {};
}

}  // namespace plumb
