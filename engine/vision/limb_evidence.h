#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "engine/cameras/limb_direction.h"
#include "engine/motion/body.h"
#include "engine/vision/limb_regions.h"
#include "engine/vision/strokes.h"

namespace etude {

/// The measurements of one limb in a picture.
struct LimbEvidence {
  PixelSegment line;      ///< from the inner to the outer end, pixels; for a hidden end, the visible part's end
  double seen_share = 1;  ///< visible pixels divided by the pixels of the whole limb seen from the side, in (0, 1]
  double contrast = 0;    ///< contrast to the surroundings, as `Region::contrast`, levels
  double half_width = 0;  ///< pixels
};

struct PictureEvidence {
  /// The evidence of each limb, by stroke; nullopt if too little of the limb is visible to determine its line.
  std::array<std::optional<LimbEvidence>, kStrokeCount> limbs;
  /// Estimated pixels of joint centres where a visible limb touches its parent part, and of tips.
  std::array<std::optional<glm::dvec2>, kRoleCount> joints;
};

/// The kind of figure determines where joints lie in the visible part of a limb. A method may be told the kind,
/// because anybody who sees a picture recognises it at once.
enum class FigureKind {
  /// The figure made of capsules in paper B's studio. Where two limbs meet, the thicker limb ends near the joint. Hips,
  /// shoulders and the neck lie inside the trunk, beyond the visible part of the limb that begins there.
  kCapsules,
  kDressed,  ///< a dressed person, whose limbs are cut across at the joints (sim/character)
};

/// Facts about the person's appearance that are known before the take.
struct FigureLook {
  FigureKind figure = FigureKind::kCapsules;
  /// The distance of the joint kHead below the crown, in half widths of the head. Files place this joint at the middle
  /// of the head or at its top; like limb lengths, the distance must be known before the take.
  double head_below_crown = 1.3;
};

/// Finds the lines of limbs and the joints in a picture that was segmented into limbs. The line of a limb is the middle
/// line of its visible pixels (`FindMiddleLine`). Joint centres follow from general proportions of bodies:
/// - Limbs made of capsules have round ends. Where one limb partly covers the other, the joint lies half a width inside
///   the end of the covering limb; the ends of the border between both limbs bend towards the covering limb. Hips,
///   shoulders and the neck lie inside the trunk: beyond the border, along the limb. Each of these joints has its own
///   distance from the border, as a share of the limb's width (for the neck, of the border's breadth).
/// - Limbs of dressed people are cut across at their joints. A joint lies at the border or, for arms, near the limb's
///   inner end. A shoulder lies half an arm's width inside the arm, a hip above the crotch.
/// - A tip lies about half a width inside the limb's outer end; the head's point lies at a given distance below the
///   crown.
/// All these shares are *ours*; they were measured on each kind of figure at rest, seen from the side. If another limb
/// or the picture's edge cuts off a limb, the limb's line ends there. A limb with a hidden end is left out unless its
/// visible piece is clearly longer than wide and at least a quarter of the limb. A limb that touches no known part is
/// also left out, because its ends cannot be distinguished. docs/annotator.md states the error of these rules for each
/// joint.
PictureEvidence FindLimbEvidence(const LimbRegions& regions, const FigureLook& look = {});

}  // namespace etude
