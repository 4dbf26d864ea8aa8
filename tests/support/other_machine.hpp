/// Another machine: a process in a network namespace of its own at the other end of a virtual
/// cable, 10.7.0.2 to our 10.7.0.1.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <string>

#include "platform/udpm/file_descriptor.hpp"

namespace plumb::test {

inline bool run(const std::string& command) { return std::system(command.c_str()) == 0; }

class OtherMachine {
 public:
  /// `send` runs there whenever send() is called here. It says whether it worked.
  /// @pre this process is in a private network and has no thread yet
  explicit OtherMachine(const std::function<bool()>& send) {
    int go[2] = {-1, -1};
    int done[2] = {-1, -1};
    if (::pipe(go) != 0 || ::pipe(done) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) serve(go[0], done[1], send);
    go_ = FileDescriptor(go[1]);
    done_ = FileDescriptor(done[0]);
    ::close(go[0]);
    ::close(done[1]);
    char ok = 0;
    is_connected_ =
        ::read(done_.get(), &ok, 1) == 1 && ok == 'y' &&
        run("ip link add here type veth peer name there netns " + std::to_string(pid_)) &&
        run("ip addr add 10.7.0.1/24 dev here && ip link set here multicast on up && "
            "ip route add 239.255.76.67/32 dev here") &&
        order('c');
  }
  ~OtherMachine() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  OtherMachine(const OtherMachine&) = delete;
  OtherMachine& operator=(const OtherMachine&) = delete;

  [[nodiscard]] bool is_connected() const { return is_connected_; }
  bool send() { return order('s'); }

 private:
  bool order(char what) {
    char ok = 0;
    return ::write(go_.get(), &what, 1) == 1 && ::read(done_.get(), &ok, 1) == 1 && ok == 'y';
  }

  [[noreturn]] static void serve(int go, int done, const std::function<bool()>& send) {
    char ok = ::unshare(CLONE_NEWNET) == 0 ? 'y' : 'n';
    char what = 0;
    while (::write(done, &ok, 1) == 1 && ::read(go, &what, 1) == 1) {
      const bool worked = what == 'c' ? run("ip addr add 10.7.0.2/24 dev there && "
                                            "ip link set there multicast on up && "
                                            "ip route add 224.0.0.0/4 dev there")
                                      : send();
      ok = worked ? 'y' : 'n';
    }
    ::_exit(0);
  }

  int pid_ = -1;
  FileDescriptor go_;
  FileDescriptor done_;
  bool is_connected_ = false;
};

}  // namespace plumb::test
