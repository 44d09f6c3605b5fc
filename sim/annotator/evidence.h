#pragma once

#include "engine/base/image.h"
#include "engine/vision/limb_evidence.h"
#include "engine/vision/limb_regions.h"

namespace etude {

/// One picture as the annotator is shown it; all three of one size.
struct AnnotatedPicture {
  const LabelImage& labels;    ///< which part is seen where: stands for the eye that tells limbs apart
  const ColourImage& colours;  ///< decides only how clearly a limb stands out
  const Mask& person;          ///< what the segmenter cut out; the rest is not seen
};

/// What the annotator looks with.
struct EvidenceOptions {
  FigureLook look;
  int margin_px = kFrayedEdgePx;
};

/// What the annotator can know from one picture and from anatomy (`FindLimbEvidence`); nothing else enters. What these
/// rules cost in exact joint centres: docs/annotator.md, by joint.
PictureEvidence SeePicture(const AnnotatedPicture& picture, const EvidenceOptions& options = {});

}  // namespace etude
