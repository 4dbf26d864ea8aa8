/// A descriptor that an event loop polls: readable while one of ours is or while it is raised.
///
/// Messages that wait in our memory leave the socket empty, so the socket alone would not wake the
/// loop.
#pragma once

#include "platform/udpm/file_descriptor.hpp"

namespace plumb {

class ReadySignal {
 public:
  /// `also_fd` makes it readable, too; -1 for none. Throws std::system_error.
  explicit ReadySignal(int also_fd = -1);

  [[nodiscard]] int fileno() const { return poll_.get(); }
  void raise(bool raised);

 private:
  FileDescriptor event_;
  FileDescriptor poll_;
  bool is_raised_ = false;
};

}  // namespace plumb
