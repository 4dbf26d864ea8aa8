/// plumb-monitor as a program: what it refuses.
#include "tests/support/run_program.hpp"

namespace plumb {
namespace {

TEST(MonitorProgram, RefusesWhatDoesNotFitTogether) {
  const test::TempFolder folder;
  const std::pair<const char*, const char*> calls[] = {
      {"--prot 80", "unknown option --prot; did you mean --port?"},
      {"drive.lcm --trace live.can", "LOG excludes --trace"},
      {"--interface can0 --trace live.can", "--interface excludes --trace"},
      {"--port 70000", "--port"},
      {"--rate 0", "--rate"},
      {"--config nosuch.toml", "nosuch.toml"},
      {"nosuch.lcm", "nosuch.lcm: cannot read"}};
  for (const auto& [arguments, sentence] : calls)
    test::expect_refused(folder, "plumb-monitor", arguments, sentence);
}

}  // namespace
}  // namespace plumb
