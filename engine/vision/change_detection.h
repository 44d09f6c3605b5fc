#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/image.h"

namespace [[gnu::visibility("default")]] etude {

/// A colour as hue, saturation and intensity (Gonzalez & Woods; paper B, section 4.1.1).
struct Hsi {
  double hue = 0;         ///< radians, [0, 2π): red 0, green 2π/3, blue 4π/3; 0 for grey, which has no hue
  double saturation = 0;  ///< 1 − 3·min / (R + G + B), in [0, 1]; 0 for black
  double intensity = 0;   ///< (R + G + B) / 3, in [0, 255]
};

/// Converts a colour by the paper's formulas as printed; the hue is θ if B ≤ G, else 2π − θ.
Hsi ToHsi(Rgb8 colour);

/// A colour's point in the plane of equal intensity: its polar angle is the hue, and grey is the origin. The point is
/// (x / 2, √3/2 · y), in grey levels, with x = 2R − G − B and y = G − B. x and y are integers, so hues can be compared
/// exactly and without an arc cosine for each pixel.
struct Chroma {
  int x = 0;
  int y = 0;

  explicit constexpr Chroma(Rgb8 colour) : x(2 * colour.r - colour.g - colour.b), y(colour.g - colour.b) {}
  bool IsGrey() const { return x == 0 && y == 0; }
};

/// Returns four times the dot product of two such points: 4·|a||b|·cos of the angle between the hues.
inline int Dot4(Chroma a, Chroma b) { return a.x * b.x + 3 * a.y * b.y; }

/// Returns the largest difference of the three channels, levels.
inline int MaxDifference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

enum class Segmenter {
  /// "rgb": compares red, green and blue separately. Paper B, chapter 4, starts from it and abandons it because it
  /// takes shadows for a person.
  kRgb,
  kHue,  ///< "hue": compares hues only (paper B, chapter 4)
  /// "hue-gated" (ours): compares hues only if both colours are far enough from grey, otherwise saturations; then the
  /// intensity, allowing for shadows and drift of the lamp.
  kHueGated,
  /// "ratio": tests if the pixel is its background's colour times one factor, as in a shadow or under more light
  /// (Horprasert et al. 1999: brightness and chromaticity distortion, without their per-pixel standard deviations).
  kRatio,
  /// "running": needs no picture of the empty room. Each pixel's background is a mean and a variance that follow the
  /// film (Wren et al. 1997, Pfinder). A person who stands still becomes background, and where somebody stood at the
  /// beginning a ghost remains for a while. Only `PersonFinder` supports it because it depends on all earlier pictures.
  kRunning,
  /// "likelihood" (ours): compares the likelihood of the room with that of the colours that the person wears, learnt
  /// from earlier pictures (`ColourLikelihood`). Only `PersonFinder` supports it.
  kLikelihood,
};

/// Returns the names used in scenarios: "rgb", "hue", "hue-gated", "ratio", "running", "likelihood".
std::vector<std::string> SegmenterNames();
/// Returns the segmenter of that name, which must be one of SegmenterNames().
Segmenter SegmenterNamed(std::string_view name);

struct ChangeOptions {
  /// Hues that differ by more than this are a change. Pixel noise of 2 levels rotates the hue of a moderately coloured
  /// wall (30 levels of chroma) by 4° rms, so this is about four standard deviations.
  double hue_threshold = Radians(16);
  /// hue-gated: a hue counts only if both pixels are more saturated than this …
  double min_saturation = 0.10;
  /// … and at least this far from grey, in levels: in the dark, saturation is noise.
  double min_chroma = 14;
  /// hue-gated: if a hue is missing, saturations that differ by more than this are a change.
  double saturation_threshold = 0.18;
  /// hue-gated and ratio: an intensity between these shares of the background's is a shadow or drift of the lamp;
  /// outside them it is a change.
  double darkest_shadow = 0.45;
  double brightest_light = 1.30;
  /// rgb: the largest allowed difference of the three channels, levels. Ten standard deviations of pixel noise, because
  /// light varies slowly over a wall.
  int rgb_threshold = 24;
  /// ratio: the largest allowed distance of a pixel's colour from the line through black and its background, levels.
  double ratio_threshold = 14;
  /// running: learning rate of mean and variance for background pixels, per frame; a tenth of it for foreground pixels.
  double learning_rate = 0.05;
  /// running: the number of standard deviations from the mean that is a change, and the minimal standard deviation of a
  /// channel, levels.
  double running_deviations = 4;
  double min_deviation = 4;
};

/// Finds the pixels in which `picture` differs from `background`. Both have the same size. For `kHue` a grey pixel has
/// hue 0, as in the paper's formula. Not for `kRunning` and `kLikelihood`.
Mask DetectChange(const ColourImage& background, const ColourImage& picture, Segmenter segmenter,
                  const ChangeOptions& options = {});

/// The changed components that are taken for the person.
enum class PersonPieces {
  kLargest,  ///< only the largest one (paper B)
  /// *Ours*: the largest one and all others near it above a minimal size. Forearms and feet are separate components
  /// where a sleeve ends or skin has the wall's hue; kLargest would lose them. However, a shadow may be included.
  kLarge,
};

struct PersonOptions {
  Segmenter segmenter = Segmenter::kHue;
  ChangeOptions change;
  PersonPieces pieces = PersonPieces::kLargest;
  /// kLarge: components of fewer pixels are noise. A hand four metres away has 120 in a picture of 640 × 480.
  int min_piece_px = 120;
  /// kLarge: the largest distance between the bounding box of a component and that of the largest one, pixels: the
  /// length of a forearm at that distance.
  int piece_reach = 40;
  /// Holes of at most this many pixels are filled; the gap between an arm and the trunk is larger.
  int max_hole_px = 60;
};

/// Finds the person in the picture (paper B, chapter 4): change detection, then the 8-connected components that
/// `pieces` selects, then their small holes filled. All pixels are 0 if nothing changed. Recorded takes use
/// `PersonFinder`; tests compare it with this plain form.
Mask ExtractPerson(const ColourImage& background, const ColourImage& picture, const PersonOptions& options);

}  // namespace etude
