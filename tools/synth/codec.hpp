/// The marks that a video codec leaves: a small codec in the manner of H.264.
///
/// A block of 16 pixels is predicted from the previous decoded picture by whole-pixel motion. The
/// cosine transform of what is left, 8x8, is quantised with a dead zone. Where nothing is left, the
/// block keeps the previous content, as it is or shifted as its neighbours are. Edges of blocks are
/// smoothed as in H.264's loop filter. Every `kGroup` frames a picture is coded by itself.
#pragma once

#include <cstdint>
#include <vector>

namespace plumb::synth {

class Codec {
 public:
  static constexpr int kGroup = 60;

  /// `step` is the quantiser's step in grey levels.
  Codec(double step, int width_px, int height_px);

  /// Codes and decodes a picture in place. Pictures must come in order, from frame 0.
  void pass(int frame, std::vector<std::uint8_t>& picture);

 private:
  struct Motion {
    int du = 0;
    int dv = 0;
  };
  static constexpr int kBlock = 16;
  static constexpr int kTransform = 8;

  [[nodiscard]] float at_previous(int u, int v) const;
  [[nodiscard]] float difference(int u0, int v0, const Motion& motion, float best) const;
  [[nodiscard]] Motion search(int u0, int v0, const Motion& guess) const;
  void predict(int u0, int v0, const Motion& motion);
  void predict_flat(int u0, int v0);
  void code_residual(int u0, int v0, bool alone);
  void smooth_edges();

  float step_;
  int width_;  ///< padded to whole blocks
  int height_;
  int picture_width_;
  int picture_height_;
  std::vector<float> source_;
  std::vector<float> previous_;
  std::vector<float> decoded_;
  std::vector<Motion> motions_;
};

}  // namespace plumb::synth
