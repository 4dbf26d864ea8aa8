/// Runs a faulty drive through the chain and compares the results marked as valid with the truth.
///
/// A result is wrong when its speed is off by more than three stated standard deviations and by
/// more than 0.3 m/s.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "modules/chain/chain.hpp"
#include "modules/chain/plumb_config.hpp"
#include "tools/evaluate/faults/fault.hpp"

namespace plumb {

/// Whether the message gives a speed. A speed that is not measured is NaN.
[[nodiscard]] bool is_speed_valid(const ego_motion_t& ego);
/// Whether a valid speed with this error is wrong.
[[nodiscard]] bool is_speed_wrong(double error_m_s, double std_m_s);

struct FaultResult {
  std::int64_t num_images = 0;
  std::int64_t num_results = 0;  ///< EGO_MOTION messages
  std::int64_t num_valid = 0;    ///< of them, status ok, scale held, standstill or coasting
  std::int64_t num_wrong = 0;    ///< of the valid ones
  double worst_error_m_s = 0.0;  ///< largest error of the speed while valid
  /// From the first faulty image until no wrong result follows within the fault; 0 when none was
  /// wrong.
  double detect_s = 0.0;
  /// From the first sound image after the fault until results are valid and right; negative: never.
  double recover_s = 0.0;
  std::string last_reason;  ///< what the chain said of the newest invalid result

  [[nodiscard]] double wrong_ratio() const;
  /// Adds the result of another drive: sums the counts and keeps the larger errors and times.
  void add(const FaultResult& other);
};

/// Runs the images through the chain. `sink` gets each with what the chain made of it.
using ShotSink = std::function<void(const Shot&, const FrameRecord&)>;
void run_chain(const FaultRun& run, const PlumbConfig& config, const ShotSink& sink);

[[nodiscard]] FaultResult run_fault(const FaultRun& run, const PlumbConfig& config);

/// The table of docs/faults.md: one row of Markdown, and its head.
[[nodiscard]] std::string fault_table_head();
[[nodiscard]] std::string fault_table_row(const Fault& fault, const std::string& drive,
                                          const FaultResult& result);

}  // namespace plumb
