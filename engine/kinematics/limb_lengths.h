#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/kinematics/body_tree.h"
#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

/// Positions of the five end effectors and directions of the limbs, as two images of a person show them (paper B,
/// sections 3.2 and 4.2).
struct LimbObservation {
  /// World positions, metres. Only the end effectors are read: left and right foot, left and right hand, head.
  BodyPose ends;
  /// World direction of each limb from its upper to its lower joint, stored at the role of the lower joint:
  /// [left_elbow] is the direction from shoulder to elbow, [head] that from the base of the neck to the head. Any
  /// non-zero length is allowed. Only arms, hands, legs, feet and the neck are read; trunk, hips and shoulders are
  /// inferred.
  std::array<glm::dvec3, kRoleCount> directions{};
  /// True for positions and directions that were not seen; their values above are meaningless (`CompleteObservation`).
  std::array<bool, kRoleCount> lacks_end{}, lacks_direction{};
};

/// Returns the roles at which `LimbObservation::directions` is read: the lower joints of thirteen limbs.
std::span<const Role, 13> ObservedLimbs();

/// The role `spine` is on the line from navel to neck, at this fraction of the way. *Ours: paper B's body has no such
/// joint; the value lies between 0.40, the fraction in the built-in body, and 0.5, the middle.*
constexpr double kSpineShare = 0.45;

/// Returns the positions of the twenty joints after every limb got its known length (paper B, section 3.2, figure 3.2):
/// (a) Start at every end effector and follow the limbs' directions inwards as far as hips and shoulders.
/// (b) Join the legs by the hip vector and the arms by the shoulder vector, each with its known width; the left side
///     stays and the right side moves.
/// (c) P₁ is the midpoint of the hips, P₂ the foot of the perpendicular from P₁ on the line through both shoulders.
///     Both arms move along that line until P₂ is the midpoint of the shoulders. *Ours*: P₂ and the arms then move
///     along P₁P₂ until the trunk has its known length. The head follows from P₂.
/// Afterwards all lengths are right, and the left foot is at its observed position. The other end effectors have moved,
/// and inverse kinematics must move them back. Returns nullopt if a number is not finite, if a direction has the length
/// 0, if a limb length is not positive, if the two hips or the two shoulders coincide, or if P₁ and P₂ coincide.
std::optional<BodyPose> FixLimbLengths(const LimbObservation& observation, const LimbLengths& lengths);

/// Returns the limb lengths of a moving person for paper B's body: means over left and right and over all poses. The
/// trunk ends midway between the shoulders, where the neck begins, as in paper B's model (a real neck begins a little
/// higher). `poses` must not be empty.
LimbLengths MeasureLimbLengths(std::span<const BodyPose> poses);

/// Completes an observation so that `FixLimbLengths` can use it. Observed values stay as they are, and `lacks_end` and
/// `lacks_direction` still mark the completed values. *(Ours; in paper B every limb is marked in every picture.)*
/// - A missing limb direction is the direction in `like`, rotated with the nearest observed limb on the way to the
///   trunk: by the smallest rotation from that limb's direction in `like` to its observed direction. If there is no
///   such limb, the direction in `like` is used unchanged.
/// - A missing end effector follows from the rest of the body: hips and shoulders have their orientation in `like`, and
///   the limbs extend from there with their lengths and directions. If no foot was seen, the hips are placed below the
///   shoulders, along the trunk of `like`; if no hand was seen, the shoulders are placed above the hips in the same
///   way. If neither a foot nor a hand was seen, the hips follow from the head; if no end effector was seen, the hips
///   are where `like` has them.
/// A complete observation is returned unchanged.
/// @param like a pose near the observed pose: the pose recovered last, or a standing body
/// @param is_placed true if `like` stands at the right position in the world
/// @return nullopt if no end effector was seen and `is_placed` is false
std::optional<LimbObservation> CompleteObservation(const LimbObservation& seen, const LimbLengths& lengths,
                                                   const BodyPose& like, bool is_placed);

}  // namespace etude
