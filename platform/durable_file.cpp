#include "platform/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

namespace plumb {
namespace {

bool write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) text.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// Closes the descriptor and keeps errno of an earlier failure.
bool close_after(int fd, bool is_good) {
  const int error = errno;
  const bool is_closed = ::close(fd) == 0;
  if (!is_good) errno = error;
  return is_good && is_closed;
}

/// A folder on a file system that cannot be synchronised is as durable as it gets.
bool sync_folder(const std::string& path) {
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) folder = ".";
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return false;
  return close_after(fd, ::fsync(fd) == 0 || errno == EINVAL);
}

}  // namespace

bool replace_file(const std::string& path, std::string_view text) {
  const std::string part = path + ".part";
  const int fd = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return false;
  if (!close_after(fd, write_all(fd, text) && ::fsync(fd) == 0)) return false;
  return std::rename(part.c_str(), path.c_str()) == 0 && sync_folder(path);
}

}  // namespace plumb
