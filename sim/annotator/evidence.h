#pragma once

#include "engine/base/image.h"
#include "engine/vision/limb_evidence.h"

namespace etude {

/// One picture as the annotator is shown it; all three of one size.
struct AnnotatedPicture {
  const LabelImage& labels;    ///< which part is seen where: stands for the eye that tells limbs apart
  const ColourImage& colours;  ///< decides only how clearly a limb stands out
  const Mask& person;          ///< what the segmenter cut out; the rest is not seen
};

/// What the annotator looks with.
struct EvidenceOptions {
  FigureKind figure = FigureKind::kCapsules;  ///< `FigureLook::figure`
  /// A pixel this close to the extracted person still counts as on it: extraction frays edges by a pixel or two.
  int margin_px = 3;
  double head_below_crown = 1.3;  ///< `FigureLook::head_below_crown`
};

/// What the annotator can know from one picture and from anatomy (`FindLimbEvidence`); nothing else enters. What these
/// rules cost in exact joint centres: README.md, by joint.
PictureEvidence SeePicture(const AnnotatedPicture& picture, const EvidenceOptions& options = {});

}  // namespace etude
