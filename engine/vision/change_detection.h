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

/// Converts a colour by the paper's printed formulas; the hue is θ if B ≤ G, otherwise 2π − θ.
Hsi ToHsi(Rgb8 colour);

/// A colour's point in the plane of equal intensity. The point's polar angle is the hue; grey is at the origin. The
/// point is (x / 2, √3/2 · y), in grey levels, with x = 2R − G − B and y = G − B. As x and y are integers, hues can be
/// compared exactly, without an arc cosine for each pixel.
struct Chroma {
  int x = 0;
  int y = 0;

  explicit constexpr Chroma(Rgb8 colour) : x(2 * colour.r - colour.g - colour.b), y(colour.g - colour.b) {}
  bool IsGrey() const { return x == 0 && y == 0; }
};

/// Returns four times the dot product of two chroma points: 4·|a||b|·cos of the angle between the hues.
inline int Dot4(Chroma a, Chroma b) { return a.x * b.x + 3 * a.y * b.y; }

/// Returns the largest difference of a channel between two colours, levels.
inline int MaxDifference(Rgb8 a, Rgb8 b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

enum class Segmenter {
  /// "rgb": compares red, green and blue separately. Paper B, chapter 4, begins with this test and abandons it because
  /// it takes shadows for a person.
  kRgb,
  kHue,  ///< "hue": compares hues only (paper B, chapter 4)
  /// "hue-gated" (ours): compares hues if the colours of pixel and background are far enough from grey, and saturations
  /// otherwise. Then compares intensities, allowing for shadows and drift of the lamp.
  kHueGated,
  /// "ratio": tests whether the pixel's colour is the background's colour times one factor, as in a shadow or under
  /// more light (Horprasert et al. 1999: brightness and chromaticity distortion, without their per-pixel standard
  /// deviations).
  kRatio,
  /// "running": needs no picture of the empty room. Each pixel's background colour has a mean and a variance, which are
  /// updated with every picture (Wren et al. 1997, Pfinder). A person who stands still becomes background. Where
  /// somebody stood at the beginning, a ghost remains for a while. Only `PersonFinder` supports this segmenter, because
  /// it depends on all earlier pictures.
  kRunning,
  /// "likelihood" (ours): compares the likelihoods of two causes of a pixel's colour: the room, and the person's
  /// clothes, whose colours are learnt from earlier pictures (`ColourLikelihood`). Only `PersonFinder` supports this
  /// segmenter.
  kLikelihood,
};

/// Returns the names used in scenarios: "rgb", "hue", "hue-gated", "ratio", "running", "likelihood".
std::vector<std::string> SegmenterNames();
/// Returns the segmenter with this name. `name` must be one of SegmenterNames().
Segmenter SegmenterNamed(std::string_view name);

struct ChangeOptions {
  /// The difference between hues, radians, above which a pixel has changed. Pixel noise of 2 levels rotates the hue
  /// of a moderately coloured wall (30 levels of chroma) by 4° rms, so this is about four standard deviations.
  double hue_threshold = Radians(16);
  /// hue-gated: hues are compared only if pixel and background are more saturated than this.
  double min_saturation = 0.10;
  /// hue-gated: hues are compared only if pixel and background are at least this far from grey, levels. In the dark,
  /// saturation is noise.
  double min_chroma = 14;
  /// hue-gated: if hues are not compared, a larger difference between saturations is a change.
  double saturation_threshold = 0.18;
  /// hue-gated and ratio: the range of the pixel's intensity, as shares of the background's intensity. Within the
  /// range, a shadow or drift of the lamp may be the cause; outside, the pixel has changed.
  double darkest_shadow = 0.45;
  double brightest_light = 1.30;
  /// rgb: the largest allowed difference of a channel, levels. It is ten standard deviations of pixel noise, so that a
  /// slow change of the light on a wall does not count.
  int rgb_threshold = 24;
  /// ratio: the largest allowed distance, levels, of a pixel's colour from the line through black and the background's
  /// colour.
  double ratio_threshold = 14;
  /// running: the learning rate of mean and variance at background pixels, per frame. Foreground pixels use a tenth of
  /// this rate.
  double learning_rate = 0.05;
  /// running: a pixel has changed if a channel differs from the pixel's mean by more than this number of standard
  /// deviations.
  double running_deviations = 4;
  double min_deviation = 4;  ///< running: the minimum standard deviation of a channel, levels
};

/// Finds the pixels in which `picture` differs from `background`, which must have the same size. For `kHue`, a grey
/// pixel has hue 0, because the paper's formula gives grey no hue. Must not be called with `kRunning` or `kLikelihood`.
Mask DetectChange(const ColourImage& background, const ColourImage& picture, Segmenter segmenter,
                  const ChangeOptions& options = {});

/// The rule that selects the changed components that belong to the person.
enum class PersonPieces {
  kLargest,  ///< only the largest component (paper B)
  /// *Ours*: the largest component, and all components near it above a minimum size. Forearms and feet are separate
  /// components where a sleeve ends or skin has the wall's hue; kLargest would lose these limbs. But kLarge may include
  /// a shadow.
  kLarge,
};

struct PersonOptions {
  Segmenter segmenter = Segmenter::kHue;
  ChangeOptions change;
  PersonPieces pieces = PersonPieces::kLargest;
  /// kLarge: components with fewer pixels count as noise.
  int min_piece_px = 120;
  /// kLarge: the largest distance between the bounding boxes of a component and of the largest component, pixels. It is
  /// the length of a forearm four metres away.
  int piece_reach = 40;
  /// Holes of at most this many pixels are filled; the gap between an arm and the trunk is larger.
  int max_hole_px = 60;
};

/// Finds the person in the picture (paper B, chapter 4): detects changes, selects 8-connected components by
/// `options.pieces`, and fills small holes in the result. All pixels are 0 if nothing changed. Recorded takes use the
/// faster `PersonFinder`, which tests compare with this function.
Mask ExtractPerson(const ColourImage& background, const ColourImage& picture, const PersonOptions& options);

}  // namespace etude
