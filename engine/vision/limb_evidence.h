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
  PixelSegment line;      ///< from the inner to the outer end, pixels; a hidden end is where the visible part ends
  double seen_share = 1;  ///< visible pixels over those of the whole limb from the side, in (0, 1]
  double contrast = 0;    ///< `Region::contrast`
  double half_width = 0;  ///< pixels
};

struct PictureEvidence {
  /// The limbs by stroke; nullopt if too little of the limb is visible to determine its line.
  std::array<std::optional<LimbEvidence>, kStrokeCount> limbs;
  /// Estimated joint centres: where a visible limb touches its parent part, and at the tips.
  std::array<std::optional<glm::dvec2>, kRoleCount> joints;
};

/// The kind of figure, which determines where joints lie in the visible part of a limb. An observer recognises it at
/// first sight, so methods may know it.
enum class FigureKind {
  /// Paper B's studio: capsules. Where two limbs meet, the thicker one ends near the joint; hips, shoulders and the
  /// neck lie inside the trunk, beyond the visible part of their limb.
  kCapsules,
  kDressed,  ///< limbs are cut across at their joints (sim/character)
};

/// What is known of the person's looks before the take.
struct FigureLook {
  FigureKind figure = FigureKind::kCapsules;
  /// The distance of the head's point below the crown, in half widths of the head. Files place the end of the head at
  /// its middle or at its top; like limb lengths, this is agreed on before the take.
  double head_below_crown = 1.3;
};

/// Finds the limbs' lines and the joints in a picture that was segmented into limbs. The line of a limb is the middle
/// line of its visible pixels (`FindMiddleLine`). Joint centres follow from general proportions of bodies:
/// - Capsules end round: a joint lies half a width inside the end of the limb that covers the other one there. The ends
///   of their common border bend towards the covering limb. Hips, shoulders and the neck lie inside the trunk: beyond
///   the border, along the limb, by a share of the border's breadth that is specific to the joint.
/// - Limbs of dressed people are cut across at their joints: a joint lies at that border or, for arms, near the limb's
///   inner end; a shoulder half an arm's width inside the arm, a hip above the crotch.
/// - A tip lies about half a width inside the limb's outer end; the head's point at a given distance below the crown.
/// All these shares are *ours*, measured on each kind of figure at rest, from the side. A limb that another limb or the
/// picture's edge cuts off ends there. A limb with a hidden end is left out unless a clearly long piece shows a quarter
/// of it. A limb that touches nothing known is also left out, because its ends cannot be distinguished.
/// docs/annotator.md states, by joint, the error that these rules cause in exact joint centres.
PictureEvidence FindLimbEvidence(const LimbRegions& regions, const FigureLook& look = {});

}  // namespace etude
