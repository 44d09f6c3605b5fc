#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// Sets of joint limits for the tree of `MakeBodyTree`: the tree's own set and the columns of paper B's table 3.1.
enum class LimitSet {
  kAdult,       ///< *ours*: round figures, some narrower than the table; the limits that `MakeBodyTree` sets
  kAaos,        ///< American Academy of Orthopaedic Surgeons
  kKendall,     ///< Kendall and McCreary; values missing here, in kHoppenfeld or in kAma are taken from kAaos
  kHoppenfeld,  ///< Hoppenfeld
  /// American Medical Association. For the trunk, this column gives flexion and rotation of the thoracic spine, but
  /// extension and lateral bending of the lumbar spine.
  kAma,
};

/// Returns the names that scenario files use: "adult", "aaos", "kendall", "hoppenfeld", "ama".
const std::vector<std::string>& LimitSetNames();
std::optional<LimitSet> FindLimitSet(std::string_view name);

/// Returns the range of every degree of freedom of the body's tree, radians, for `IkProblem::limits`. Table 3.1 names
/// movements of a body in the anatomical position: standing, palms forward. The mapping from movements to the axes of
/// the tree is *ours*; the left side mirrors the right side:
/// - X is flexion and extension (hips, knees, ankles, trunk, neck, shoulders, elbows, wrists); Y is abduction, the
///   wrist's radial abduction, and lateral bending of trunk and neck; Z is rotation about the limb. Inversion of the
///   foot turns its toes inward and is therefore a rotation about Y; the left ankle, next to the tree's root, has no Y
///   axis.
/// - The tree runs up the left leg, so the left hip's angles turn the pelvis about the thigh: X is abduction
///   (negative), Y outer (negative) and inner rotation, Z flexion (negative). Each angle alone has the same range of
///   movement as on the right side. If several angles differ from zero, the left hip applies them in another order than
///   the right hip.
/// - |Y| is limited to 80°, below the singularity of the three Euler angles at 90°. This shortens the shoulder's
///   abduction.
/// - The table has no shoulder adduction, so it is taken from `adult`. The tree has no axis for pronation and
///   supination.
std::vector<AngleRange> JointLimits(LimitSet set);

}  // namespace etude
