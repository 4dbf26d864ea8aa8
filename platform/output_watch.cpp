#include "platform/output_watch.hpp"

namespace plumb {

bool OutputWatch::judge(std::int64_t now_us, const Bus& bus, const Counters& counters,
                        bool is_excused) {
  const bool has_published = counters.num_published > num_published_;
  num_published_ = counters.num_published;
  if (!has_published && !is_excused && is_due(bus)) return false;
  well_us_ = now_us;
  return true;
}

bool OutputWatch::is_due(const Bus& bus) const {
  if (is_cyclic_) return true;
  bool has_input = false;
  for (const RawSubscriber* input : bus.subscribers()) {
    if (input->input() != Input::kPeriodic) continue;
    if (input->accepted_us() <= well_us_) return false;
    has_input = true;
  }
  return has_input;
}

}  // namespace plumb
