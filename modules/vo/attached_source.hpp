/// The file that keeps over restarts what is attached to the camera: TOML with a schema, a version,
/// the size of the image and one line of digits for each row of cells.
///
/// Memory:
///   The text of the file, allocated by the constructor. A thread of its own writes it.
#pragma once

#include <span>
#include <string>

#include "modules/vo/attached_regions.hpp"
#include "platform/file_thread.hpp"

namespace plumb {

/// Gives the regions of an image of this size what the file says. Throws ConfigError ("FILE: ...")
/// for one that cannot be read or is of images of another size; then the regions stay as they were.
void load_attached_regions(const std::string& path, int width_px, int height_px,
                           vo::AttachedRegions* regions);

class AttachedFile {
 public:
  AttachedFile(const std::string& path, int width_px, int height_px);

  /// Has the file written when it does not say this yet. Returns whether there was something to
  /// write.
  bool save(const vo::AttachedRegions& regions);
  /// Returns errno of the last time that the file was written, 0 when it succeeded.
  [[nodiscard]] int error() const { return thread_.error(); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  int width_px_;
  int height_px_;
  std::string text_;       // that was handed over last
  std::string next_text_;  // that is made now
  FileThread thread_;
};

}  // namespace plumb
