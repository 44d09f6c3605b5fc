#pragma once

#include <array>

#include "engine/base/image.h"
#include "engine/vision/limb_evidence.h"
#include "engine/vision/limb_regions.h"
#include "engine/vision/strokes.h"

namespace etude {

/// A suit on which every marked limb has its own plain colour, known from its design or measured in a picture. No
/// colour is grey, and no two have the same chromaticity.
struct LimbColours {
  Rgb8 trunk;
  std::array<Rgb8, kStrokeCount> limbs;  ///< by stroke; the last colour covers head and neck
};

struct LimbColourOptions {
  FigureLook look;
  int margin_px = kFrayedEdgePx;
  /// The largest distance between the chromaticity of a pixel, (R, G, B) / (R + G + B), and the nearest colour of the
  /// suit. It must exceed the shift of colours by tinted lamps. The default also exceeds half the distance between
  /// the two most similar colours if 14 hues are spread evenly over two thirds of the colour circle. Colours of rooms
  /// and furniture must differ from the suit's colours by at least twice this distance.
  double reach = 0.1;
  int darkest = 45;  ///< if R + G + B is lower, noise determines the chromaticity
  /// A limb that other limbs cross has several components. A component is ignored if its size, as a share of the
  /// largest component's size, is smaller than this.
  double piece_share = 0.2;
  int min_piece_px = 20;  ///< components with fewer pixels are ignored
  /// Every component must contain a square with this side, pixels: along edges two colours mix, and the mixture
  /// resembles a third colour.
  int min_side_px = 4;
  int border_px = 3;  ///< width of the strip between two limbs in which the limbs' colours mix, pixels
};

/// Segments the person into limbs by chromaticity alone, because shading does not change it. Each pixel gets the
/// nearest colour of the suit, then the majority of its 3 × 3 neighbourhood; small components are removed.
/// @param person mask of the picture's size; pixels outside the person are ignored
LimbRegions FindColouredLimbs(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                              const LimbColourOptions& options = {});

/// Makes marks from a picture without annotation: a stroke along the middle of every limb that is sufficiently visible,
/// and a disc on each end effector (`FindLimbEvidence`). A limb that is hidden, cut off or of another colour gets no
/// mark.
Marks ReadLimbColours(const ColourImage& picture, const Mask& person, const LimbColours& suit,
                      const LimbColourOptions& options = {});

}  // namespace etude
