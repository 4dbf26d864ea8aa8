#include "tools/support/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "platform/clock.hpp"

namespace plumb {
namespace {

constexpr std::int64_t kRedraw_us = 100'000;
constexpr int kBarCells = 30;

}  // namespace

Progress::Progress(std::string label, std::string what, std::int64_t total)
    : label_(std::move(label)),
      what_(std::move(what)),
      total_(total),
      start_us_(monotonic_us()),
      drawn_us_(start_us_),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (!finished_ && terminal_ && count_ > 0) std::fputc('\n', stderr);
}

double Progress::per_second() const {
  const auto passed_us = static_cast<double>(std::max<std::int64_t>(monotonic_us() - start_us_, 1));
  return 1e6 * static_cast<double>(count_) / passed_us;
}

void Progress::update(std::int64_t done, std::int64_t count) {
  count_ = count;
  percent_ = total_ > 0 ? static_cast<int>(100 * std::min(done, total_) / total_) : 0;
  const std::int64_t now_us = monotonic_us();
  if (now_us - drawn_us_ < kRedraw_us) return;
  drawn_us_ = now_us;
  draw(percent_);
}

void Progress::finish(bool complete) {
  if (finished_) return;
  finished_ = true;
  draw(complete ? 100 : percent_);
  if (terminal_) std::fputc('\n', stderr);
}

void Progress::draw(int percent) {
  if (!terminal_) return;
  std::string bar(kBarCells, '.');
  std::fill_n(bar.begin(), percent * kBarCells / 100, '#');
  std::fprintf(stderr, "\r%s [%s] %3d %% %lld %s %.1f/s ", label_.c_str(), bar.c_str(), percent,
               static_cast<long long>(count_), what_.c_str(), per_second());
}

}  // namespace plumb
