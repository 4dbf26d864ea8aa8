#include "platform/udpm/udpm_outcome.hpp"

namespace plumb {
namespace {

// In the order of the enumeration.
constexpr std::array<const char*, kNumUdpmOutcomes> kOutcomeTexts{
    "a message is complete",
    "a fragment was stored",
    "nobody reads the channel",
    "the sender is neither on this machine nor named as a source",
    "the packet is shorter than its header",
    "the packet is not LCM",
    "the channel is not terminated",
    "the channel is empty",
    "the channel is too long",
    "the fragment's number is not below the number of fragments",
    "the fragment reaches beyond its message",
    "the message is larger than its channel allows",
    "the message has too many fragments",
    "the fragment came twice",
    "the fragment contradicts others of its message",
    "the fragment came before the first one of its message and there is no room",
    "the fragment's message was given up",
};

}  // namespace

const char* describe(UdpmOutcome outcome) {
  return kOutcomeTexts[static_cast<std::size_t>(outcome)];
}

}  // namespace plumb
