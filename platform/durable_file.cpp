#include "platform/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>

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

using Path = std::array<char, PATH_MAX>;

/// A folder on a file system that cannot be synchronised is as durable as it gets.
bool sync_folder(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string_view::npos)
    path = ".";
  else
    path = path.substr(0, std::max<std::size_t>(1, slash));
  Path folder{};
  std::copy(path.begin(), path.end(), folder.begin());
  const int fd = ::open(folder.data(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return false;
  return close_after(fd, ::fsync(fd) == 0 || errno == EINVAL);
}

}  // namespace

bool replace_file(const std::string& path, std::string_view text) {
  Path part{};
  const int length = std::snprintf(part.data(), part.size(), "%s.part", path.c_str());
  if (length < 0 || static_cast<std::size_t>(length) >= part.size()) {
    errno = ENAMETOOLONG;
    return false;
  }
  const int fd = ::open(part.data(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return false;
  if (!close_after(fd, write_all(fd, text) && ::fsync(fd) == 0)) return false;
  return std::rename(part.data(), path.c_str()) == 0 && sync_folder(path);
}

}  // namespace plumb
