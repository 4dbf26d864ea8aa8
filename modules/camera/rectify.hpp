/// Rectifies a distorted image to a pinhole image with tables that are computed once.
///
/// Frames:
///   img: (0,0) is the centre of the upper left pixel.
/// Model:
///   plumb_bob (Brown 1966), with r2 = x^2 + y^2 and radial = 1 + k1 r2 + k2 r2^2 + k3 r2^3:
///   x_d = x radial + 2 p1 x y + p2 (r2 + 2 x^2),  y_d = y radial + p1 (r2 + 2 y^2) + 2 p2 x y.
///   fisheye (Kannala and Brandt 2006), with r = tan(theta):
///   x_d = x theta_d / r,  theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8).
///   The coefficients are those of OpenCV.
/// Memory:
///   8 bytes per pixel, allocated at construction.
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
  /// Computes the tables.
  /// @pre width_px, height_px in [2, 32767]; focal lengths > 0
  Rectifier(int width_px, int height_px, const PinholePx& captured, const Lens& lens,
            const PinholePx& published);

  /// True when apply() only copies, because there is no distortion and
  /// both pinhole cameras are equal.
  [[nodiscard]] bool is_identity() const { return identity_; }

  /// Interpolates bilinearly with 8-bit weights. Pixels that the camera did not see repeat the
  /// nearest pixel at the border.
  /// @pre `captured` has the constructed size; `out` has width_px * height_px bytes
  void apply(const ImageView& captured, std::uint8_t* out) const;

  /// 1 for pixels that the camera did not see or where the lens polynomial folds over;
  /// rows without gaps.
  [[nodiscard]] const std::vector<std::uint8_t>& unseen() const { return unseen_; }

 private:
  /// The upper left source pixel and the weights [1/256] of its right and lower neighbours.
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
};

}  // namespace plumb
