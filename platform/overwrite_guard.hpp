/// Refuses output files that would overwrite an input or each other, before any of them is opened.
///
/// Two paths name the same file when both exist with the same device and inode, whatever links lead
/// there, or when neither exists and both resolve to the same place. Devices and pipes are never
/// refused: writing to /dev/null twice loses nothing.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace plumb {

class OverwriteGuard {
 public:
  /// `name` is what messages call the file, for example "LOG" or "--config". Empty paths are
  /// ignored.
  OverwriteGuard& reads(std::string name, const std::filesystem::path& path);
  /// A folder of inputs: its files with one of `extensions` (".png") count, those in its
  /// subfolders, too.
  OverwriteGuard& reads_folder(std::string name, const std::filesystem::path& folder,
                               std::vector<std::string> extensions);
  OverwriteGuard& writes(std::string name, const std::filesystem::path& path);

  /// Throws InputError when an output is an input or another output.
  void check() const;

 private:
  struct Named {
    std::string name;
    std::filesystem::path path;
  };
  struct Folder {
    Named folder;
    std::vector<std::string> extensions;
  };
  void check_folder(const Folder& input) const;

  std::vector<Named> inputs_;
  std::vector<Folder> input_folders_;
  std::vector<Named> outputs_;
};

}  // namespace plumb
