#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/base/image.h"
#include "engine/vision/limb_evidence.h"
#include "engine/vision/limb_regions.h"
#include "sim/body/shape.h"

namespace etude {

/// The part of the body along which a stroke runs, and the part to which this part is attached. The joint between the
/// two parts is the stroke's `from`. The table is in the order of `StrokeMarks`.
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

/// The regions that an annotator can distinguish in one picture.
struct Regions {
  int width = 0, height = 0;
  std::array<Region, kPartCount> parts;
  /// For each stroke, the border between the limb and the part to which it is attached: the midpoints of all pixel
  /// edges on this border.
  std::array<std::vector<glm::dvec2>, kStrokeCount> borders;

  const Region& operator[](Part part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Finds the visible parts of the performer on the mask `person`, or at most `margin_px` outside this mask in u and in
/// v. Parts that the segmenter lost are not visible to the annotator. All pictures must have the same size.
Regions FindRegions(const LabelImage& labels, const ColourImage& colours, const Mask& person, int margin_px);

/// A picture as the annotator sees it. All three images have the same size.
struct AnnotatedPicture {
  const LabelImage& labels;    ///< the part that each pixel shows, because annotators can distinguish limbs
  const ColourImage& colours;  ///< the picture's colours, used only for the contrast of limbs
  const Mask& person;          ///< the segmented person; the annotator does not see the rest of the picture
};

/// The options of the annotator's view of a picture.
struct EvidenceOptions {
  FigureLook look;
  int margin_px = kFrayedEdgePx;
};

/// Returns the annotator's conclusions from one picture and from anatomy (`FindLimbEvidence`); no other data are used.
/// docs/annotator.md lists the resulting errors of each joint centre.
PictureEvidence SeePicture(const AnnotatedPicture& picture, const EvidenceOptions& options = {});

}  // namespace etude
