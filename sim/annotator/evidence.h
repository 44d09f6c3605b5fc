#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"
#include "engine/vision/limb_evidence.h"
#include "engine/vision/limb_regions.h"
#include "sim/body/shape.h"

namespace etude {

/// The part that a stroke runs along, and the part that it hangs from; the joint between the two is the stroke's
/// `from`. The table is in the order of `StrokeMarks`.
struct LimbParts {
  Part limb;
  Part inner;
};
constexpr std::array<LimbParts, kStrokeCount> kLimbParts = {{
    {Part::kLeftThigh, Part::kTrunk},
    {Part::kLeftShank, Part::kLeftThigh},
    {Part::kLeftFoot, Part::kLeftShank},
    {Part::kRightThigh, Part::kTrunk},
    {Part::kRightShank, Part::kRightThigh},
    {Part::kRightFoot, Part::kRightShank},
    {Part::kLeftUpperArm, Part::kTrunk},
    {Part::kLeftForearm, Part::kLeftUpperArm},
    {Part::kLeftHand, Part::kLeftForearm},
    {Part::kRightUpperArm, Part::kTrunk},
    {Part::kRightForearm, Part::kRightUpperArm},
    {Part::kRightHand, Part::kRightForearm},
    {Part::kHead, Part::kTrunk},
}};

/// The regions that an annotator can tell apart in one picture.
struct Regions {
  int width = 0, height = 0;
  std::array<Region, kPartCount> parts;
  /// The borders between a limb and the part it hangs from: the middles of all pixel sides between them, by stroke.
  std::array<std::vector<glm::dvec2>, kStrokeCount> borders;

  const Region& operator[](Part part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Finds the visible parts of the performer that lie on `person` or at most `margin_px` beside it (in u and in v): what
/// the segmenter lost is not seen. All pictures have the same size.
Regions FindRegions(const LabelImage& labels, const ColourImage& colours, const Mask& person, int margin_px);

/// A picture as the annotator is shown it; all three images have one size.
struct AnnotatedPicture {
  const LabelImage& labels;    ///< which part is seen where: stands for the eye that tells limbs apart
  const ColourImage& colours;  ///< decides only how clearly a limb stands out
  const Mask& person;          ///< what the segmenter cut out; the rest is not seen
};

/// The options of the annotator's view of a picture.
struct EvidenceOptions {
  FigureLook look;
  int margin_px = kFrayedEdgePx;
};

/// Returns what the annotator can know from one picture and from anatomy (`FindLimbEvidence`); nothing else enters.
/// What these rules cost in exact joint centres: docs/annotator.md, by joint.
PictureEvidence SeePicture(const AnnotatedPicture& picture, const EvidenceOptions& options = {});

}  // namespace etude
