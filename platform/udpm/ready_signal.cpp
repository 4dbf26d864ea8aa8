#include "platform/udpm/ready_signal.hpp"

#include <sys/epoll.h>
#include <sys/eventfd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace plumb {
namespace {

bool watch(int poll_fd, int fd) {
  epoll_event event{};
  event.events = EPOLLIN;
  return ::epoll_ctl(poll_fd, EPOLL_CTL_ADD, fd, &event) == 0;
}

}  // namespace

ReadySignal::ReadySignal(int also_fd)
    : event_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), poll_(::epoll_create1(EPOLL_CLOEXEC)) {
  const bool works = event_.get() >= 0 && poll_.get() >= 0 && watch(poll_.get(), event_.get()) &&
                     (also_fd < 0 || watch(poll_.get(), also_fd));
  if (!works) throw std::system_error(errno, std::generic_category(), "epoll and eventfd");
}

void ReadySignal::raise(bool raised) {
  if (raised == is_raised_) return;
  is_raised_ = raised;
  // Neither can fail: the counter is 0 before the write and 1 before the read.
  std::uint64_t one = 1;
  if (raised) {
    (void)!::write(event_.get(), &one, sizeof one);
  } else {
    (void)!::read(event_.get(), &one, sizeof one);
  }
}

}  // namespace plumb
