#include "modules/can/signals/signal_tables.hpp"

#include <algorithm>

namespace plumb {

Messages can_messages(const CanConfig& config) {
  std::array<SignalTable, kNumMessages> tables{};
  auto end = tables.begin();
  for (const std::span<const SignalTable> some :
       {motion_signals(), plane_signals(), frame_signals(), mount_signals(), status_signals(),
        object_signals()}) {
    end = std::copy(some.begin(), some.end(), end);
  }
  return make_messages(config, tables);
}

}  // namespace plumb
