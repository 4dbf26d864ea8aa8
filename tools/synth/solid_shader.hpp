/// Shades solids: how facades, roofs, hedges, bark, paint, glass and tyres reflect light.
#pragma once

#include "tools/synth/primitive.hpp"
#include "tools/synth/surface.hpp"

namespace plumb::synth {

class SolidShader {
 public:
  explicit SolidShader(const Textures& textures) : textures_(textures) {}

  [[nodiscard]] Reflectance shade(const Primitive& solid, const Hit& hit, const Patch& patch) const;

 private:
  struct Face {  ///< the hit on an upright face
    double u_m;  ///< along it
    double v_m;  ///< up from the solid's foot
    double reach_u;
    double reach_v;
    Footprint pixel;
  };
  [[nodiscard]] Face face_of(const Primitive& solid, const Hit& hit, const Patch& patch) const;
  void facade(const Primitive& solid, const Hit& hit, const Face& face, Reflectance& out) const;
  void brick(const Face& face, Reflectance& out) const;
  void roof(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;
  void leaves(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;
  void hedge(const Hit& hit, const Patch& patch, const Primitive& solid, Reflectance& out) const;
  void bodywork(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;
  void cabin(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;
  void coach(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;
  void tyre(const Primitive& solid, const Hit& hit, Reflectance& out) const;
  void sign(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;
  void tarp(const Primitive& solid, const Hit& hit, const Patch& patch, Reflectance& out) const;

  const Textures& textures_;
};

}  // namespace plumb::synth
