#pragma once

#include "engine/base/image.h"

namespace etude {

/// A colour as hue, saturation and intensity (Gonzalez & Woods; paper B, section 4.1.1).
struct Hsi {
  double hue = 0;         ///< radians, [0, 2π): red 0, green 2π/3, blue 4π/3; 0 for grey, which has none
  double saturation = 0;  ///< 1 − 3·min / (R + G + B), in [0, 1]; 0 for black
  double intensity = 0;   ///< (R + G + B) / 3, in [0, 255]
};

/// The paper's formulas as printed; θ is the hue when B ≤ G, else 2π − θ.
Hsi ToHsi(Rgb8 colour);

/// A colour's point in the plane of colours of equal intensity, whose polar angle is the hue; grey is the
/// origin. The point is (x / 2, √3/2 · y), in grey levels, with x = 2R − G − B and y = G − B: whole
/// numbers, so that hues can be compared exactly and without an arc cosine per pixel.
struct Chroma {
  int x = 0;
  int y = 0;

  explicit constexpr Chroma(Rgb8 colour) : x(2 * colour.r - colour.g - colour.b), y(colour.g - colour.b) {}
  bool IsGrey() const { return x == 0 && y == 0; }
};

/// Four times the dot product of two such points: 4·|a||b|·cos of the angle between the hues.
inline int Dot4(Chroma a, Chroma b) { return a.x * b.x + 3 * a.y * b.y; }

}  // namespace etude
