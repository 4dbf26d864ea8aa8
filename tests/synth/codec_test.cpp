#include "tools/synth/codec.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tools/synth/random.hpp"

namespace plumb::synth {
namespace {

constexpr int kWidth = 100;
constexpr int kHeight = 52;  // neither is a whole number of blocks

using Picture = std::vector<std::uint8_t>;

/// Noise of a standard deviation around a grey level; bright stripes up to `stripes_to`.
Picture picture(double sd, std::uint64_t seed, int stripes_to = 0) {
  Random random(seed);
  Picture out;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double stripe = u < stripes_to && u % 8 < 4 ? 80.0 : 0.0;
      out.push_back(static_cast<std::uint8_t>(60.0 + stripe + sd * random.normal()));
    }
  }
  return out;
}

double rms(const Picture& a, const Picture& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += (static_cast<double>(a[k]) - b[k]) * (static_cast<double>(a[k]) - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(Codec, ErrorIsThatOfTheQuantiser) {
  const Picture original = picture(20.0, 1);
  for (const double step : {1.0, 8.0}) {
    Codec codec(step, kWidth, kHeight);
    Picture coded = original;
    codec.pass(0, coded);
    // A uniform error within a step; the dead zone adds a little.
    EXPECT_GT(rms(original, coded), 0.2 * step);
    EXPECT_LT(rms(original, coded), 0.45 * step + 0.4);
  }
}

TEST(Codec, KeepsWhatWasThereWhereLittleChanges) {
  Codec codec(12.0, kWidth, kHeight);
  Picture first = picture(1.0, 1);
  codec.pass(0, first);
  Picture second = picture(1.0, 2);
  codec.pass(1, second);
  EXPECT_EQ(second, first);
  Picture third = picture(1.0, 3, kWidth);
  const Picture wanted = third;
  codec.pass(2, third);
  EXPECT_LT(rms(third, wanted), 8.0) << "a large change is coded";
}

TEST(Codec, APictureByItselfDoesNotDependOnThoseBefore) {
  Codec used(10.0, kWidth, kHeight);
  for (int frame = 0; frame < Codec::kGroup; ++frame) {
    Picture any = picture(30.0, static_cast<std::uint64_t>(frame) + 9);
    used.pass(frame, any);
  }
  Codec fresh(10.0, kWidth, kHeight);
  Picture a = picture(10.0, 4, 40);
  Picture b = a;
  used.pass(Codec::kGroup, a);
  fresh.pass(0, b);
  EXPECT_EQ(a, b);
}

}  // namespace
}  // namespace plumb::synth
