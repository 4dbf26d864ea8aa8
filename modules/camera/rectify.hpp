/// Distorted image -> pinhole image, by tables computed once.
///
/// Frames   img: (0,0) is the centre of the upper left pixel.
/// Model    plumb_bob: x_d = x (1 + k1 r2 + k2 r2^2 + k3 r2^3) + 2 p1 x y + p2 (r2 + 2 x^2), y
/// alike;
///          fisheye: x_d = x theta_d / r, theta_d = theta (1 + k1 theta^2 + ... + k4 theta^8).
///          (Brown 1966; Kannala and Brandt 2006; coefficients in OpenCV's order.)
/// Memory   8 bytes a pixel, allocated at construction.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image_view.hpp"

namespace plumb {

struct PinholePx {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
};

enum class LensModel : std::int8_t { kPlumbBob = 0, kFisheye = 1 };

struct Lens {
  LensModel model = LensModel::kPlumbBob;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;  ///< kPlumbBob only
  double p2 = 0.0;  ///< kPlumbBob only
  double k3 = 0.0;
  double k4 = 0.0;  ///< kFisheye only
};

class Rectifier {
 public:
  /// Computes the tables. @pre width_px, height_px in [2, 32767], focal lengths > 0
  Rectifier(int width_px, int height_px, const PinholePx& captured, const Lens& lens,
            const PinholePx& published);

  /// True when `apply` would copy: no distortion, and the same pinhole on both sides.
  [[nodiscard]] bool is_identity() const { return identity_; }

  /// Bilinear, 8-bit weights. Pixels the camera did not see repeat the nearest border pixel.
  /// @pre `captured` has the constructed size; `out` holds width_px * height_px bytes
  void apply(const ImageView& captured, std::uint8_t* out) const;

  /// 1 where the camera saw nothing or the lens polynomial has folded over; rows without gaps.
  [[nodiscard]] const std::vector<std::uint8_t>& unseen() const { return unseen_; }
  [[nodiscard]] double unseen_ratio() const { return unseen_ratio_; }

 private:
  /// Upper left source pixel and the weights [1/256] of its right and lower neighbours.
  struct Tap {
    std::int16_t u;
    std::int16_t v;
    std::uint16_t wu;
    std::uint16_t wv;
  };
  [[nodiscard]] Tap tap_for(double u_px, double v_px) const;

  int width_px_;
  int height_px_;
  bool identity_;
  std::vector<Tap> taps_;
  std::vector<std::uint8_t> unseen_;
  double unseen_ratio_ = 0.0;
};

}  // namespace plumb
