#include "platform/overwrite_guard.hpp"

#include <sys/stat.h>

#include <algorithm>

#include "core/input_error.hpp"

namespace plumb {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as the kernel: a longer chain of links is a loop

/// The place that `path` leads to through links, even when nothing is there yet.
fs::path resolved(fs::path path) {
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, error)); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return fs::weakly_canonical(fs::absolute(path, error), error);
}

bool same_file(const fs::path& a, const fs::path& b) {
  struct stat of_a {};
  struct stat of_b {};
  const bool a_exists = ::stat(a.c_str(), &of_a) == 0;
  const bool b_exists = ::stat(b.c_str(), &of_b) == 0;
  if (a_exists != b_exists) return false;
  if (!a_exists) return resolved(a) == resolved(b);
  return S_ISREG(of_a.st_mode) && of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

}  // namespace

OverwriteGuard& OverwriteGuard::reads(std::string name, const fs::path& path) {
  if (!path.empty()) inputs_.push_back({std::move(name), path});
  return *this;
}

OverwriteGuard& OverwriteGuard::reads_folder(std::string name, const fs::path& folder,
                                             std::vector<std::string> extensions) {
  if (!folder.empty()) {
    input_folders_.push_back({{std::move(name), folder}, std::move(extensions)});
  }
  return *this;
}

OverwriteGuard& OverwriteGuard::writes(std::string name, const fs::path& path) {
  if (!path.empty()) outputs_.push_back({std::move(name), path});
  return *this;
}

void OverwriteGuard::check() const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Named& output = outputs_[i];
    const auto is_output = [&output](const Named& other) {
      return same_file(other.path, output.path);
    };
    const auto input = std::find_if(inputs_.begin(), inputs_.end(), is_output);
    if (input != inputs_.end()) {
      throw InputError(output.name + " " + output.path.string() + " would overwrite the input " +
                       input->name + " " + input->path.string());
    }
    const auto before = outputs_.begin() + static_cast<std::ptrdiff_t>(i);
    const auto other = std::find_if(outputs_.begin(), before, is_output);
    if (other == before) continue;
    throw InputError(output.name + " " + output.path.string() + " is the same file as " +
                     other->name + " " + other->path.string());
  }
  for (const Folder& folder : input_folders_) check_folder(folder);
}

void OverwriteGuard::check_folder(const Folder& input) const {
  std::vector<const Named*> existing;
  std::error_code error;
  for (const Named& output : outputs_) {
    if (fs::is_regular_file(output.path, error)) existing.push_back(&output);
  }
  if (existing.empty()) return;
  using Walk = fs::recursive_directory_iterator;
  const auto options = fs::directory_options::follow_directory_symlink |
                       fs::directory_options::skip_permission_denied;
  for (Walk entry(input.folder.path, options, error); !error && entry != Walk();
       entry.increment(error)) {
    const fs::path& path = entry->path();
    if (std::find(input.extensions.begin(), input.extensions.end(), path.extension().string()) ==
        input.extensions.end()) {
      continue;
    }
    for (const Named* output : existing) {
      if (!same_file(path, output->path)) continue;
      throw InputError(output->name + " " + output->path.string() + " would overwrite " +
                       path.string() + " of the input " + input.folder.name);
    }
  }
}

}  // namespace plumb
