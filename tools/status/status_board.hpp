/// What is known of the processes of the chain and of its motion, as one screen of text.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/channels.hpp"
#include "plumb/ego_motion_t.hpp"
#include "plumb/process_health_t.hpp"

namespace plumb {

class StatusBoard {
 public:
  /// In the order of the data flow.
  static constexpr std::array<const Channel*, 6> kProcesses = {
      &kHealthCamera, &kHealthVo, &kHealthGround, &kHealthObjects, &kHealthCan, &kHealthDetect};

  /// `needed` names processes that have to run, such as "vo".
  explicit StatusBoard(std::vector<std::string> needed) : needed_(std::move(needed)) {}

  /// Messages that arrived at the monotonic time `now_us`. Those of other processes are ignored.
  void take(const process_health_t& message, std::int64_t now_us);
  void take(const ego_motion_t& message, std::int64_t now_us);

  /// Do all that are needed run? Others do not count.
  [[nodiscard]] bool is_well(std::int64_t now_us) const;
  /// The screen: a line for each process that was heard or is needed, the motion, the verdict.
  [[nodiscard]] std::string text(std::int64_t now_us) const;

 private:
  struct Row {
    process_health_t health;
    std::int64_t heard_us = 0;  ///< 0: never
  };
  struct Motion {
    ego_motion_t newest;
    std::int64_t first_us = 0;
    std::int64_t heard_us = 0;  ///< 0: never
    std::int64_t count = 0;
  };
  [[nodiscard]] bool is_needed(std::string_view process) const;
  [[nodiscard]] bool runs(std::size_t process, std::int64_t now_us) const;
  [[nodiscard]] std::string row_text(std::size_t process, std::int64_t now_us) const;
  [[nodiscard]] std::string motion_text(std::int64_t now_us) const;
  [[nodiscard]] std::string verdict(std::int64_t now_us) const;

  std::vector<std::string> needed_;
  std::array<Row, kProcesses.size()> rows_{};
  Motion motion_;
};

}  // namespace plumb
