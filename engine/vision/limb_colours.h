#pragma once

#include <array>

#include "engine/base/image.h"
#include "engine/vision/limb_evidence.h"
#include "engine/vision/limb_regions.h"
#include "engine/vision/strokes.h"

namespace etude {

/// A suit in which every limb that is marked has a plain colour of its own, known from its making or measured in a
/// picture. No two are grey or share a chromaticity.
struct LimbColours {
  Rgb8 trunk;
  std::array<Rgb8, kStrokeCount> limbs;  ///< by stroke; the last is the head's, with the neck
};

struct LimbColourOptions {
  FigureLook look;
  int margin_px = kFrayedEdgePx;
  /// The largest distance of a pixel's chromaticity, (R, G, B) / (R + G + B), from the suit's nearest. Half of what
  /// lies between the nearest two of 14 hues that share two thirds of the circle, and lamps that are tinted, must stay
  /// below; what people live with is less colourful than a suit by twice as much.
  double reach = 0.1;
  int darkest = 45;  ///< R + G + B below which noise decides about a chromaticity
  /// The smallest piece of a limb that others cross, as a share of its largest piece.
  double piece_share = 0.2;
  int smallest_piece = 20;  ///< pixels; of a hand four metres away in a picture of 640 × 480 there are some 80
  /// The side of the square that every piece must hold, pixels: along edges two colours mix to a third.
  int least_side_px = 4;
  int seam_px = 3;  ///< so many pixels between two limbs may show neither: both colours mix there
};

/// Tells the person's limbs apart by chromaticity alone, which shading leaves as it is: the nearest of the suit's, then
/// the majority of nine pixels, then pieces of some size.
/// @param person of the picture's size; what lies outside is not looked at
LimbRegions FindColouredLimbs(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                              const LimbColourOptions& options = {});

/// Makes the marks of a picture that nobody marked: a stroke along the middle of every limb of which enough is seen, a
/// disc on each of its ends (`FindLimbEvidence`). A limb that is hidden, cut off or of no colour of the suit has none.
Marks ReadLimbColours(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                      const LimbColourOptions& options = {});

}  // namespace etude
