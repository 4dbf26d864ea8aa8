#include "modules/ground_paper/gaussian_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace plumb {
namespace {

/// A dip of known shape over [low, high].
Slice make_slice(double low, double high, double centre, double width, double depth) {
  Slice slice;
  for (std::size_t i = 0; i < kSliceSamples; ++i) {
    slice.x[i] = low + (high - low) * static_cast<double>(i) / (kSliceSamples - 1);
    const double u = (slice.x[i] - centre) / width;
    slice.f[i] = 0.9 - depth * std::exp(-0.5 * u * u);
  }
  return slice;
}

TEST(GaussianFit, RecoversTheWidthsThatThePaperShows) {
  for (const double width : {0.02, 0.085, 0.25}) {
    const GaussianDip dip = fit_gaussian(make_slice(0.8, 2.4, 1.6, width, 0.24));
    ASSERT_TRUE(dip.ok) << width;
    EXPECT_NEAR(dip.width, width, 1e-4 * width);
    EXPECT_NEAR(dip.centre, 1.6, 1e-5);
    EXPECT_NEAR(dip.depth, 0.24, 1e-5);
    EXPECT_NEAR(dip.offset, 0.9, 1e-5);
  }
}

TEST(GaussianFit, RecoversAShallowDipBesideTheMiddleUnderNoise) {
  Slice slice = make_slice(-0.1, 0.1, 0.02, 0.012, 0.02);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.001);
  for (double& f : slice.f) f += noise(random);
  const GaussianDip dip = fit_gaussian(slice);
  ASSERT_TRUE(dip.ok);
  EXPECT_NEAR(dip.width, 0.012, 0.0015);
  EXPECT_NEAR(dip.centre, 0.02, 0.002);
}

TEST(GaussianFit, SeesNoDipInAHillASlopeOrAFlat) {
  Slice slice = make_slice(0.0, 1.0, 0.5, 0.1, -0.3);
  EXPECT_FALSE(fit_gaussian(slice).ok);
  slice.f = slice.x;
  EXPECT_FALSE(fit_gaussian(slice).ok);
  slice.f.fill(0.7);
  EXPECT_FALSE(fit_gaussian(slice).ok);
}

TEST(GaussianFit, RefusesSamplesThatAreNoNumbers) {
  Slice slice = make_slice(0.0, 1.0, 0.5, 0.1, 0.3);
  slice.f[20] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit_gaussian(slice).ok);
}

}  // namespace
}  // namespace plumb
