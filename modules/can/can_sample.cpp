#include "modules/can/can_sample.hpp"

#include <cmath>

#include "modules/can/can_codec.hpp"

namespace plumb {
namespace {

std::size_t index_of(Group group) { return static_cast<std::size_t>(group); }

/// Calls `visit(signal, its slot, its message, its number there)` for the signals of one source.
template <typename Visit>
void for_each_of(CanSource source, const Messages& messages, Visit visit) {
  for (const Message& message : messages) {
    for (std::size_t i = 0; i < message.signals.size(); ++i) {
      if (source_of(message.signals[i]) != source) continue;
      visit(message.signals[i], message.slot[i], message, i);
    }
  }
}

void drop_what_cannot_be_sent(CanSource source, const Messages& messages, SourceValues* values) {
  for_each_of(source, messages, [&](const Signal& signal, std::size_t slot, auto&&...) {
    if (!is_sendable(signal.layout, (*values)[slot])) (*values)[slot] = kNotAvailable;
  });
  for_each_of(source, messages,
              [&](const Signal&, std::size_t slot, const Message& message, std::size_t i) {
                if (message.deviation_slot[i] == kNoSlot) return;
                double& value = (*values)[slot];
                double& deviation = (*values)[message.deviation_slot[i]];
                if (std::isnan(value) || std::isnan(deviation)) value = deviation = kNotAvailable;
              });
}

}  // namespace

void settle_values(CanSource source, const Messages& messages, GroupValidities* validities,
                   SourceValues* values) {
  drop_what_cannot_be_sent(source, messages, values);
  std::array<int, kNumGroups> num_needed{};
  std::array<int, kNumGroups> num_missing{};
  for_each_of(source, messages, [&](const Signal& signal, std::size_t slot, auto&&...) {
    const Need need = signal.value.need;
    if (need != Need::kWanted && need != Need::kEssential) return;
    const std::size_t group = index_of(signal.value.group);
    ++num_needed[group];
    if (!std::isnan((*values)[slot])) return;
    ++num_missing[group];
    lower_validity(need == Need::kEssential ? CanValidity::kInvalid : CanValidity::kDegraded,
                   &(*validities)[group]);
  });
  for (std::size_t g = 0; g < kNumGroups; ++g) {
    if (num_needed[g] > 0 && num_missing[g] == num_needed[g])
      lower_validity(CanValidity::kInvalid, &(*validities)[g]);
  }
  for_each_of(source, messages, [&](const Signal& signal, std::size_t slot, auto&&...) {
    const CanValidity validity = (*validities)[index_of(signal.value.group)];
    if (signal.value.need == Need::kIsValidity) {
      (*values)[slot] = static_cast<double>(validity);
    } else if (signal.value.group != Group::kAlways && validity == CanValidity::kInvalid) {
      (*values)[slot] = kNotAvailable;
    }
  });
}

}  // namespace plumb
