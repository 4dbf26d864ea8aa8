/// Every setting of the picture memory; visit() is the one list of keys, ranges and meanings.
#pragma once

namespace plumb {

struct PictureConfig {
  int memory_images = 8;
  double still_ratio = 0.5;
  double moving_px = 2.0;
  double stale_moving_px = 3.0;
  double equal_share = 0.75;
  double noise_floor_grey = 0.7;
  double region_share = 0.1;
  int rest_images = 50;

  template <typename Config, typename Visit>
  static void visit(Config& c, Visit&& field) {
    field("picture.memory_images", c.memory_images, 2, 16,
          "earlier images that each new one is compared with");
    field("picture.still_ratio", c.still_ratio, 0.1, 0.7,
          "two images are alike when their median block differs by less than this share of its "
          "own contrast over 2 px");
    field("picture.moving_px", c.moving_px, 0.5, 16.0,
          "apparent shift per image, at 10 images/s or faster, from which no car stops within "
          "one image");
    field("picture.stale_moving_px", c.stale_moving_px, 0.5, 16.0,
          "apparent shift per image above which a return to an earlier image is no oscillation");
    field("picture.equal_share", c.equal_share, 0.3, 1.0,
          "share of bit-equal blocks that is no sensor noise");
    field("picture.noise_floor_grey", c.noise_floor_grey, 0.1, 10.0,
          "a camera whose calmest blocks always differ by more than this shows its noise; when "
          "the noise vanishes the picture is frozen");
    field("picture.region_share", c.region_share, 0.03, 0.5,
          "share of the textured blocks that makes a repeated region");
    field("picture.rest_images", c.rest_images, 5, 10000,
          "bit-equal images for which a seen stop still vouches, on a camera that shows no noise");
  }
};

}  // namespace plumb
