/// Runs one of the project's programs as a child process: starts it, sends signals, waits for it
/// and reads its output.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "plumb_paths.hpp"

namespace plumb::test {

class ChildProcess {
 public:
  /// Starts `arguments[0]`, which is a program in bin/ or a path.
  /// stdout and stderr are collected together.
  explicit ChildProcess(std::vector<std::string> arguments) {
    if (arguments[0].find('/') == std::string::npos && arguments[0].rfind("plumb-", 0) == 0)
      arguments[0] = std::string(PLUMB_BIN_DIR) + "/" + arguments[0];
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(ends[1], 1);
      ::dup2(ends[1], 2);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      ::execvp(argv[0], argv.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    output_fd_ = ends[0];
    ::fcntl(output_fd_, F_SETFL, O_NONBLOCK);
  }
  ~ChildProcess() {
    if (!exited_ && pid_ > 0) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    if (output_fd_ >= 0) ::close(output_fd_);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) const { ::kill(pid_, number); }

  /// Returns the exit code, 128 + signal when a signal ended the program, or -1 when it still runs
  /// after `timeout_s`.
  int wait(double timeout_s = 20.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
    while (!exited_) {
      drain();
      int status = 0;
      if (::waitpid(pid_, &status, WNOHANG) == pid_) {
        exited_ = true;
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      } else if (std::chrono::steady_clock::now() >= end) {
        break;
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
    drain();
    return exited_ ? code_ : -1;
  }

  [[nodiscard]] const std::string& output() {
    drain();
    return output_;
  }
  [[nodiscard]] int pid() const { return pid_; }

 private:
  void drain() {
    char buffer[4096];
    ssize_t got = 0;
    while ((got = ::read(output_fd_, buffer, sizeof buffer)) > 0)
      output_.append(buffer, static_cast<std::size_t>(got));
  }
  int pid_ = -1;
  int output_fd_ = -1;
  bool exited_ = false;
  int code_ = -1;
  std::string output_;
};

}  // namespace plumb::test
