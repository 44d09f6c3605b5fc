#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/image.h"

namespace etude {

/// A colour as hue, saturation and intensity (Gonzalez & Woods; paper B, section 4.1.1).
struct Hsi {
  double hue = 0;         ///< radians, [0, 2π): red 0, green 2π/3, blue 4π/3; 0 for grey, which has none
  double saturation = 0;  ///< 1 − 3·min / (R + G + B), in [0, 1]; 0 for black
  double intensity = 0;   ///< (R + G + B) / 3, in [0, 255]
};

/// Converts a colour by the paper's formulas as printed; θ is the hue when B ≤ G, else 2π − θ.
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

/// Returns four times the dot product of two such points: 4·|a||b|·cos of the angle between the hues.
inline int Dot4(Chroma a, Chroma b) { return a.x * b.x + 3 * a.y * b.y; }

/// Returns by how many levels the most different of the three colours differs.
inline int MostDifference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

enum class Segmenter {
  /// "rgb": red, green and blue compared by themselves: what paper B, chapter 4, starts from, and leaves because it
  /// takes shadows for a person.
  kRgb,
  kHue,  ///< "hue": hues compared, nothing else (paper B, chapter 4)
  /// "hue-gated" (ours): compares hues only where both colours are far enough from grey to have one, else
  /// greyness; then the light, beyond what a shadow or the lamp explains.
  kHueGated,
  /// "ratio": is the pixel its background's colour times one factor, as in a shadow or under more light? (Horprasert et
  /// al. 1999: brightness and chromaticity distortion, without their per-pixel deviations.)
  kRatio,
  /// "running": no picture of the empty room. Each pixel's background is a mean and a deviation that follow the film
  /// (Wren et al. 1997, Pfinder); who stands still becomes background, and where somebody stood at the beginning a
  /// ghost stays for a while. Only `PersonFinder` has it: it needs all pictures before.
  kRunning,
  /// "likelihood" (ours): is the room likelier there, or a colour that the person wears, as learnt from the pictures
  /// before? (`ColourLikelihood`.) Only `PersonFinder` has it.
  kLikelihood,
};

/// Returns the names used in scenarios: "rgb", "hue", "hue-gated", "ratio", "running", "likelihood".
std::vector<std::string> SegmenterNames();
/// Returns the segmenter of that name, which is one of SegmenterNames().
Segmenter SegmenterNamed(std::string_view name);

struct ChangeOptions {
  /// Hues further apart than this are a change. Pixel noise of 2 levels turns the hue of a moderately
  /// coloured wall (30 levels of chroma) by 4° rms, so this is about four deviations.
  double hue_threshold = Radians(16);
  /// hue-gated: a hue counts only when both pixels are more saturated than this …
  double min_saturation = 0.10;
  /// … and this far from grey, in levels: in the dark, saturation is noise.
  double min_chroma = 14;
  /// hue-gated: saturations further apart than this are a change, when a hue is missing.
  double saturation_threshold = 0.18;
  /// hue-gated: light between these shares of the background's is shadow or lamp drift, and outside them
  /// a change.
  double darkest_shadow = 0.45;
  double brightest_light = 1.30;
  /// rgb: levels by which the most different of the three colours may differ. Ten deviations of pixel noise: light
  /// changes slowly over a wall.
  int rgb_threshold = 24;
  /// ratio: levels by which a pixel may be off the line from black through its background's colour.
  double ratio_threshold = 14;
  /// running: how fast mean and deviation follow what is background, per frame; of what is foreground a tenth.
  double learning_rate = 0.05;
  /// running: deviations from the mean that are a change, and the least deviation of a colour, levels.
  double running_deviations = 4;
  double least_deviation = 4;
};

/// Finds the pixels in which `picture` shows something else than `background`. The two have the same size. A grey pixel
/// has hue 0 for `kHue`, as in the paper's formula. Not for `kRunning` and `kLikelihood`.
Mask DetectChange(const ColourImage& background, const ColourImage& picture, Segmenter segmenter,
                  const ChangeOptions& options = {});

/// The pieces of what changed that are taken for the person.
enum class PersonPieces {
  kLargest,  ///< the largest one alone (paper B)
  /// *Ours*: the largest, and every one of some size beside it. Where a sleeve ends, or skin is of the wall's hue,
  /// forearms and feet are pieces of their own, and the largest one has lost them; but so may be a shadow.
  kLarge,
};

struct PersonOptions {
  Segmenter segmenter = Segmenter::kHue;
  ChangeOptions change;
  PersonPieces pieces = PersonPieces::kLargest;
  /// kLarge: pieces of fewer pixels are noise. 120 is a hand four metres away in a picture of 640 × 480.
  int smallest_piece = 120;
  /// kLarge: the largest distance of the box about a piece from that about the largest one, pixels: a forearm's length
  /// there.
  int piece_reach = 40;
  /// Holes of at most this many pixels are filled; the gap between an arm and the trunk is larger.
  int largest_hole = 60;
};

/// Finds the person in the picture (paper B, chapter 4): change detection, then the 8-connected component or components
/// that `pieces` names, then their small holes filled. All zero when nothing changed. Takes go through `PersonFinder`,
/// which tests compare with this plain form.
Mask ExtractPerson(const ColourImage& background, const ColourImage& picture, const PersonOptions& options);

}  // namespace etude
