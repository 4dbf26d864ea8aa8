#include "tools/evaluate/eval/paired_samples.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/input_error.hpp"
#include "tests/support/expect_throw.hpp"
#include "tests/support/temp_folder.hpp"

namespace plumb {
namespace {

/// Errors about 1 of which all in ten neighbouring frames share their deviation.
std::vector<ErrorSample> correlated(int num_frames, double offset, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<ErrorSample> samples;
  double shared = 0.0;
  for (int k = 0; k < num_frames; ++k) {
    if (k % 10 == 0) shared = normal(random);
    samples.push_back({"04", k, "fused", 1.0 + offset + 0.3 * shared});
  }
  return samples;
}

TEST(PairedSamples, FindsADifferenceThatIsThere) {
  const auto worse = correlated(1000, 0.2, 1);
  auto better = worse;
  for (ErrorSample& sample : better) sample.value -= 0.2;
  const PairedComparison result = compare_samples(better, worse, {});
  EXPECT_EQ(result.num_pairs, 1000);
  EXPECT_EQ(result.num_blocks, 50);
  EXPECT_NEAR(result.difference.mean, -0.2, 1e-9);
  EXPECT_NEAR(result.difference.low, -0.2, 1e-9);
  EXPECT_LT(result.of.low, result.of.mean);
  EXPECT_GT(result.of.high, result.of.mean);
}

TEST(PairedSamples, ItsIntervalHoldsTheTruthAsOftenAsItSays) {
  int num_inside = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto a = correlated(400, 0.0, 2 * seed + 10);
    const auto b = correlated(400, 0.0, 2 * seed + 11);
    const Interval d = compare_samples(a, b, {}).difference;
    if (d.low <= 0.0 && 0.0 <= d.high) ++num_inside;
  }
  EXPECT_GE(num_inside, 85);  // 95 expected; twenty blocks make intervals a little too short
  EXPECT_LE(num_inside, 99);  // single frames as independent would give about 70, and never all
}

TEST(PairedSamples, PairsKindsOfOneFrame) {
  std::vector<ErrorSample> samples;
  for (int k = 0; k < 40; ++k) {
    samples.push_back({"04", k, "fused", 1.0});
    if (k < 20) samples.push_back({"04", k, "dense", 3.0});
  }
  const PairedComparison result = compare_samples(samples, samples, {"fused", "dense", 20});
  EXPECT_EQ(result.num_pairs, 20);
  EXPECT_NEAR(result.difference.mean, -2.0, 1e-12);
}

TEST(PairedSamples, GivesTheSameBitsAgain) {
  const auto a = correlated(200, 0.0, 1);
  const auto b = correlated(200, 0.1, 2);
  EXPECT_EQ(compare_samples(a, b, {}).difference.low, compare_samples(a, b, {}).difference.low);
}

TEST(PairedSamples, RefusesWhatHasNothingInCommon) {
  const auto a = correlated(20, 0.0, 1);
  test::expect_contains(test::input_error_of([&] {
                          (void)compare_samples(a, a, {"fused", "dense", 20});
                        }),
                        "no sample in common");
}

TEST(PairedSamples, FilesKeepTheSamples) {
  const test::TempFolder folder;
  const auto written = correlated(20, 0.0, 1);
  write_error_samples(written, folder / "s.csv");
  const auto read = read_error_samples(folder / "s.csv");
  ASSERT_EQ(read.size(), written.size());
  EXPECT_EQ(read[7].drive, "04");
  EXPECT_EQ(read[7].frame, 7);
  EXPECT_NEAR(read[7].value, written[7].value, 1e-8);
}

}  // namespace
}  // namespace plumb
