#include "tools/run/replay/text_output.hpp"

#include "core/input_error.hpp"

namespace plumb {

TextOutput::TextOutput(const std::filesystem::path& path) : path_(path) {
  if (!wanted()) return;
  file_.open(path);
  if (!file_) throw InputError("cannot write " + path.string());
}

void TextOutput::row(const std::string& text) {
  if (!wanted()) return;
  file_ << text << '\n';
  if (!file_) throw InputError("cannot write " + path_.string() + " any further");
}

void TextOutput::close() {
  if (!wanted()) return;
  file_.close();
  if (!file_) throw InputError("cannot write " + path_.string() + " to its end");
}

}  // namespace plumb
