/// Progress of a long job on stderr: a bar that redraws itself on a terminal, a line every two
/// seconds elsewhere.
#pragma once

#include <cstdint>
#include <string>

namespace plumb {

class Progress {
 public:
  /// `what` is counted: "frames". @pre total >= 0
  Progress(std::string label, std::string what, std::int64_t total);
  /// Ends the bar's line if finish() was not called.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the total, `count` of what is counted (the two differ when the total is in bytes).
  void update(std::int64_t done, std::int64_t count);
  /// The last line: 100 % when `complete`, else where it stopped.
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
