#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/cameras/limb_direction.h"
#include "engine/motion/body.h"
#include "engine/vision/limb_regions.h"
#include "engine/vision/strokes.h"

namespace etude {

/// One limb as a picture shows it.
struct LimbEvidence {
  PixelSegment line;      ///< from the inner to the outer end, pixels; where an end is hidden, as far as is seen
  double seen_share = 1;  ///< of the pixels that a limb as wide would have, seen whole and from aside: in (0, 1]
  double contrast = 0;    ///< `Region::contrast`
  double half_width = 0;  ///< pixels
};

struct PictureEvidence {
  /// The limbs by stroke; nothing where too little of the limb is seen to tell where it runs.
  std::array<std::optional<LimbEvidence>, kStrokeCount> limbs;
  /// Estimated joint centres: where a visible limb touches the part it hangs from, and at the tips.
  std::array<std::optional<glm::dvec2>, kRoleCount> joints;
};

/// The kind of figure, which decides where joints lie in what is seen of a limb. An observer sees it at once, so that
/// methods may know it.
enum class FigureKind {
  /// Paper B's studio: round limbs, of which the thicker one ends about the joint; trunk joints are outside.
  kCapsules,
  kDressed,  ///< limbs are cut across at their joints (sim/character)
};

/// The person's looks, as far as they are known beforehand.
struct FigureLook {
  FigureKind figure = FigureKind::kCapsules;
  /// The distance of the head's point below the crown, in half widths of the head. Files end the head at its middle or
  /// at its top; like limb lengths, this is agreed on before the take.
  double head_below_crown = 1.3;
};

/// Finds the limbs' lines and the joints in a picture that was segmented into limbs. The middle line of each limb is
/// that of its visible pixels (`FindMiddleLine`). Joint centres, from what anyone knows of bodies:
/// - capsules end round: a joint lies half a width inside the end of the limb that covers the other one there. Which
///   one covers shows in their common border, whose ends bend back towards it. Hips, shoulders and the neck lie inside
///   the trunk: beyond the border, along the limb, by a share of the border's breadth that is the joint's own;
/// - the limbs of people in clothes are cut across at their joints: a joint lies at that border or, of arms, near the
///   limb's inner end; a shoulder half an arm's width inside the arm, a hip above the crotch;
/// - a tip lies about half a width inside the limb's outer end; the head's point some way below the crown. All these
///   shares are *ours*: what each kind of figure shows at rest, from aside. A limb that is cut off, by another one or
///   the picture's edge, ends where it is cut off; one of which neither both ends nor a quarter in a clearly long piece
///   is seen is left out, and so is one that touches nothing known, because nothing tells which end is which. What
///   these rules cost in exact joint centres: docs/annotator.md, by joint.
PictureEvidence FindLimbEvidence(const LimbRegions& regions, const FigureLook& look = {});

}  // namespace etude
