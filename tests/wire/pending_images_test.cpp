// Tests the store of images that wait for their motion.
#include "modules/ground/pending_images.hpp"

#include <gtest/gtest.h>

namespace plumb {
namespace {

constexpr int kSlotWidth = 4;
constexpr int kSlotHeight = 3;

/// A grey image of `width` x `height`, whose rows have a gap of one byte that is 99.
struct StoredImage {
  StoredImage(std::int64_t seq, int width = kSlotWidth, int height = kSlotHeight) {
    const int stride = width + 1;
    bytes.resize(static_cast<std::size_t>(stride * height));
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < stride; ++u)
        bytes[static_cast<std::size_t>(v * stride + u)] =
            u == width ? 99 : static_cast<std::uint8_t>(10 * seq + v * width + u);
    frame.seq = seq;
    frame.capture_us = 1'000 * seq;
    frame.width_px = width;
    frame.height_px = height;
    frame.row_stride_bytes = stride;
    frame.data = bytes;
  }
  std::vector<std::uint8_t> bytes;
  ImageFrame frame;
};

class PendingImagesTest : public ::testing::Test {
 protected:
  void put(std::int64_t seq) { ASSERT_TRUE(images_.put(StoredImage(seq).frame)); }
  [[nodiscard]] const ImageFrame* find(std::int64_t seq) const {
    return images_.find(seq, 1'000 * seq);
  }
  void expect_pixels(std::int64_t seq) const {
    const ImageFrame* frame = find(seq);
    ASSERT_NE(nullptr, frame) << seq;
    EXPECT_EQ(kSlotWidth, frame->row_stride_bytes) << "the gaps between the rows are left out";
    ASSERT_EQ(std::size_t{kSlotWidth * kSlotHeight}, frame->data.size());
    for (std::size_t i = 0; i < frame->data.size(); ++i)
      EXPECT_EQ(static_cast<std::uint8_t>(10 * seq + static_cast<int>(i)), frame->data[i]) << i;
  }

  PendingImages images_{kSlotWidth, kSlotHeight, 3};
};

TEST_F(PendingImagesTest, KeepsCopiesWithoutGaps) {
  put(1);
  put(2);
  put(3);
  for (const std::int64_t seq : {1, 2, 3}) expect_pixels(seq);
  EXPECT_EQ(0, images_.num_overflowed());
}

TEST_F(PendingImagesTest, FindsByNumberAndTime) {
  put(1);
  EXPECT_NE(nullptr, images_.find(1, 1'000));
  EXPECT_EQ(nullptr, images_.find(1, 2'000));
  EXPECT_EQ(nullptr, images_.find(2, 1'000));
}

TEST_F(PendingImagesTest, LetsTheOldestGoWhenFull) {
  for (const std::int64_t seq : {1, 2, 3, 4, 5}) put(seq);
  EXPECT_EQ(2, images_.num_overflowed());
  EXPECT_EQ(nullptr, find(1));
  EXPECT_EQ(nullptr, find(2));
  for (const std::int64_t seq : {3, 4, 5}) expect_pixels(seq);
}

TEST_F(PendingImagesTest, DropsAnImageAndAllBefore) {
  for (const std::int64_t seq : {1, 2, 3, 4}) put(seq);  // begins in the middle of the ring
  images_.drop_through(find(3));
  EXPECT_EQ(nullptr, find(2));
  EXPECT_EQ(nullptr, find(3));
  expect_pixels(4);
  put(5);
  put(6);
  for (const std::int64_t seq : {4, 5, 6}) expect_pixels(seq);
  EXPECT_EQ(1, images_.num_overflowed());
  images_.drop_through(find(6));
  for (const std::int64_t seq : {4, 5, 6}) EXPECT_EQ(nullptr, find(seq));
}

TEST_F(PendingImagesTest, RefusesWhatDoesNotFitASlot) {
  EXPECT_FALSE(images_.put(StoredImage(1, kSlotWidth + 1, kSlotHeight).frame));
  EXPECT_FALSE(images_.put(StoredImage(1, kSlotWidth, kSlotHeight + 1).frame));
  EXPECT_EQ(nullptr, find(1));
  EXPECT_EQ(0, images_.num_overflowed());
}

TEST_F(PendingImagesTest, KeepsCompressedImagesUpToASlot) {
  StoredImage image(1);
  image.frame.compressed = true;
  image.frame.row_stride_bytes = 0;
  image.bytes.resize(kSlotWidth * kSlotHeight);
  for (std::size_t i = 0; i < image.bytes.size(); ++i)
    image.bytes[i] = static_cast<std::uint8_t>(i + 1);
  image.frame.data = image.bytes;
  ASSERT_TRUE(images_.put(image.frame));
  const ImageFrame* kept = find(1);
  ASSERT_NE(nullptr, kept);
  EXPECT_EQ(0, kept->row_stride_bytes);
  EXPECT_TRUE(
      std::equal(image.bytes.begin(), image.bytes.end(), kept->data.begin(), kept->data.end()));
  image.bytes.push_back(0);
  image.frame.data = image.bytes;
  EXPECT_FALSE(images_.put(image.frame)) << "one byte more than a slot";
}

}  // namespace
}  // namespace plumb
