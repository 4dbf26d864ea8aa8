/// Shows the progress of a long job as a bar on stderr when that is a terminal, and nothing
/// elsewhere.
#pragma once

#include <cstdint>
#include <string>

namespace plumb {

class Progress {
 public:
  /// `what` names the things that are counted, for example "frames". @pre total >= 0
  Progress(std::string label, std::string what, std::int64_t total);
  /// Ends the line of the bar if finish() was not called.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Takes how much of the total is done and how many things were counted. The two differ when the
  /// total is a number of bytes.
  void update(std::int64_t done, std::int64_t count);
  /// Draws the bar for the last time: full when `complete`, else as far as the job came.
  void finish(bool complete);
  [[nodiscard]] double per_second() const;

 private:
  void draw(int percent);

  std::string label_;
  std::string what_;
  std::int64_t total_;
  std::int64_t count_ = 0;
  std::int64_t start_us_;
  std::int64_t drawn_us_;
  int percent_ = 0;
  bool terminal_;
  bool finished_ = false;
};

}  // namespace plumb
