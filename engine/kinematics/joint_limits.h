#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// The limits of the joints of `MakeBodyTree`: the tree's own, or a column of paper B's table 3.1.
enum class LimitSet {
  kAdult,    ///< *ours*, round figures, partly narrower than the table: the limits that `MakeBodyTree` gives its tree
  kAaos,     ///< American Academy of Orthopaedic Surgeons
  kKendall,  ///< Kendall and McCreary; what they do not give is taken from the first column, as in the next two
  kHoppenfeld,  ///< Hoppenfeld
  /// American Medical Association. Its trunk is two parts in the table: flexion and rotation are the chest's, extension
  /// and the side the loins'.
  kAma,
};

/// Returns the names of scenario files: "adult", "aaos", "kendall", "hoppenfeld", "ama".
const std::vector<std::string>& LimitSetNames();
std::optional<LimitSet> FindLimitSet(std::string_view name);

/// Returns the range of every degree of freedom of the body's tree, radians, for `IkProblem::limits`. Table 3.1 names
/// movements of a body in the anatomical position: standing, palms forward. *Ours*: which axis of the tree each of them
/// is, the left side being the right one's mirror image:
/// - X bends and stretches (hips, knees, ankles, trunk, neck, shoulders, elbows, wrists), Y leads sideways (abduction,
///   the wrist's radial abduction, trunk and neck to a side), Z turns about the limb. The foot's inversion turns its
///   toes inward, which is Y; the ankle at the root has no such axis.
/// - The left hip is climbed, and its angles turn the pelvis about the thigh: X is abduction (negative), Y outer
///   (negative) and inner rotation, Z flexion (negative). Alone, each moves as far as on the right; together they are
///   not taken in the right hip's order.
/// - |Y| ends at 80°, where the three angles of a joint are still regular: it shortens the shoulder's abduction.
/// - The shoulder's adduction, of which the table says nothing, is `adult`'s; pro- and supination have no axis in the
///   tree.
std::vector<AngleRange> JointLimits(LimitSet set);

}  // namespace etude
