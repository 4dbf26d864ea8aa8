/// Compares the results of a rendered drive, run through the whole chain, with committed ones.
///
/// Another test checks that a binary gives the same bits every time. Here, compilers and maths
/// libraries may differ in the last bits, so numbers are compared to 1e-6, and words and integers
/// exactly. A larger difference means that the estimators changed. Look at it, then write the new
/// results with
///
///     PLUMB_UPDATE_EXPECTED=1 build/release/tests/replay_test --gtest_filter='Golden.*'
///
/// and commit them with a sentence that says why they changed.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "modules/datasets/number_file.hpp"
#include "plumb_paths.hpp"
#include "tests/replay/street_log.hpp"
#include "tools/run/replay/frame_csv.hpp"

namespace plumb {
namespace {

constexpr double kTolerance = 1e-6;

std::filesystem::path expected_file() {
  return std::filesystem::path(PLUMB_SOURCE_DIR) / "tests/replay/street.expected.csv";
}

bool same_cell(std::string_view a, std::string_view b) {
  if (a == b) return true;
  const auto x = parse_number(a);
  const auto y = parse_number(b);
  const bool integers = a.find_first_of(".e") == a.npos && b.find_first_of(".e") == b.npos;
  if (!x || !y || integers) return false;
  return std::abs(*x - *y) <= kTolerance * std::max({1.0, std::abs(*x), std::abs(*y)});
}

TEST(Golden, TheRenderedStreetGivesTheCommittedResults) {
  std::vector<std::string> lines = {frame_csv_header(false)};
  test::replay_events(test::street_events(), nullptr, [&](const Chain&, const FrameRecord& record) {
    lines.push_back(frame_csv_row(record, false));
  });
  if (std::getenv("PLUMB_UPDATE_EXPECTED") != nullptr) {
    std::ofstream file(expected_file());
    for (const std::string& line : lines) file << line << "\n";
    GTEST_SKIP() << "wrote " << expected_file();
  }
  const std::vector<std::string> expected = read_lines(expected_file());
  ASSERT_EQ(lines.size(), expected.size());
  EXPECT_EQ(lines[0], expected[0]) << "columns changed";
  const auto names = split_cells(lines[0]);
  int num_shown = 0;
  for (std::size_t i = 1; i < lines.size() && num_shown < 10; ++i) {
    const auto now = split_cells(lines[i]);
    const auto then = split_cells(expected[i]);
    ASSERT_EQ(now.size(), then.size()) << "row " << i;
    for (std::size_t c = 0; c < now.size() && num_shown < 10; ++c) {
      if (same_cell(now[c], then[c])) continue;
      ++num_shown;
      ADD_FAILURE() << "frame " << now[0] << ", " << names[c] << ": " << now[c] << ", expected "
                    << then[c];
    }
  }
}

TEST(Golden, ComparisonSeesASmallChangeAndForgivesARoundingOne) {
  EXPECT_TRUE(same_cell("1.65", "1.6500000000001"));
  EXPECT_FALSE(same_cell("1.65", "1.65001"));
  EXPECT_FALSE(same_cell("400", "401"));
  EXPECT_FALSE(same_cell("ok", "held"));
  EXPECT_FALSE(same_cell("", "0.1"));
}

}  // namespace
}  // namespace plumb
