#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/kinematics/body_tree.h"
#include "engine/motion/body.h"

namespace etude {

/// The places of the five ends and the directions of the limbs, as two images of a person show them (paper B, sections
/// 3.2 and 4.2).
struct LimbObservation {
  /// Places in the world, metres. Only the five ends count: left and right foot, left and right hand, head.
  BodyPose ends;
  /// The direction of each limb, from its upper to its lower joint, at the index of the lower one: [left_elbow] is the
  /// direction from shoulder to elbow, [head] from the neck's base to the head. Any length but zero. Only arms, hands,
  /// legs, feet and the neck count; trunk, hips and shoulders are inferred.
  std::array<glm::dvec3, kRoleCount> directions{};
  /// Ends and directions that were not seen, whose values above have no meaning (`CompleteObservation`).
  std::array<bool, kRoleCount> lacks_end{}, lacks_direction{};
};

/// Returns the roles whose `LimbObservation::directions` count: the lower ends of thirteen limbs.
std::span<const Role, 13> ObservedLimbs();

/// The share of the way from navel to neck at which the role `spine` lies *(ours: paper B's body has no such joint;
/// between the built-in body's 0.40 and the middle)*.
constexpr double kSpineShare = 0.45;

/// Returns where the twenty joints are when every limb gets its known length (paper B, section 3.2, figure 3.2):
/// (a) from every end inwards along the limbs' directions, as far as hips and shoulders;
/// (b) the legs are joined by the hip vector and the arms by the shoulder vector, each with its known width; the left
///     side stays, the right side moves;
/// (c) P₁ = the middle of the hips, P₂ = the foot of its perpendicular on the line through both shoulders; both arms
///     move along that line until P₂ lies midway. *Ours*: P₂ and the arms then move along P₁P₂ to the trunk's known
///     length. The head follows from P₂.
/// All lengths are right afterwards, the left foot is where it was seen; the other ends have moved, which inverse
/// kinematics repairs. Nothing for input that is not finite, a direction of no length, lengths that are not valid, or
/// when both hips, both shoulders, or P₁ and P₂ coincide.
std::optional<BodyPose> FixLimbLengths(const LimbObservation& observation, const LimbLengths& lengths);

/// Returns the lengths that paper B's body needs to follow a motion: means over both sides and all frames. The trunk
/// ends midway between the shoulders and the neck begins there, as in the model (a real neck's base is a little
/// higher). Needs at least one frame.
LimbLengths MeasureLimbLengths(std::span<const BodyPose> poses);

/// Fills in what an observation lacks, so that `FixLimbLengths` can work with it; what was seen stays as it is, and the
/// observation still says what it lacks. *(Ours; paper B marks every limb in every picture.)*
/// - A limb's direction is that in `like`, turned with the nearest limb towards the trunk that was seen: by the
///   smallest rotation that takes that one from `like` to the observation. Where there is none, it keeps the direction
///   it has there.
/// - An end is where the rest of the body puts it: hips and shoulders stand across as in `like`, and the limbs reach
///   down from there with their lengths and directions. With no foot seen the hips hang from the shoulders by the trunk
///   of `like`, with no hand the shoulders stand on it; with nothing seen at all the hips are where `like` has them.
/// A complete observation comes back as it is.
/// @param like a pose near the one observed: the last one recovered, or a standing body
/// @return nothing when no end was seen at all and `is_placed` is false: `like` stands anywhere then
std::optional<LimbObservation> CompleteObservation(const LimbObservation& seen, const LimbLengths& lengths,
                                                   const BodyPose& like, bool is_placed);

}  // namespace etude
