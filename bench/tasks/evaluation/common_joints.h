#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/metrics/evaluation.h"
#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// A joint that both motions have, by the joint's index in each motion.
struct CommonJoint {
  std::string name;
  int truth = -1, answer = -1;
};

/// Returns the joints of `set` that both motions have. Adds the set's other joints to `lacking`, with −1 for a motion
/// that lacks the joint.
std::vector<CommonJoint> FindCommon(const RawMotion& truth, const RawMotion& answer, std::string_view set,
                                    std::vector<CommonJoint>& lacking);

/// A truth or an answer, and its judged joints, in the order of the other side's.
struct JudgedSide {
  const RawMotion& motion;
  const std::vector<int>& joints;
};

/// Returns the positions of these joints in the first `frames` frames.
PointTracks JointColumns(const RawMotion& motion, const std::vector<int>& joints, std::size_t frames);

/// Returns the joints of equal names in both motions that are not among the `judged` joints.
std::vector<std::string> FindAlsoHeld(const RawMotion& truth, const RawMotion& answer,
                                      std::span<const CommonJoint> judged);

/// Fails if the motions have no common joint, or so few that the roles of their joints are probably unknown: fewer than
/// the number of kNeededJoints, and fewer than half of the joints of the motion with fewer joints. For the set "same",
/// one common joint is enough. `common` is the number of common joints.
Result<void> CheckCommon(const RawMotion& truth, const RawMotion& answer, std::size_t common, std::string_view set);

/// Returns the truth and the answer, with roles that can be compared. If a motion must be changed for this, the result
/// refers to a changed copy, which is stored in `changed_…`.
/// - If only one motion has a skeleton, and the other has joints with the names of all its needed joints, these joints
///   get the skeleton's roles, because such points were computed with this skeleton.
/// - The root is the motions' own joint if both have one, otherwise the midpoint of the hips.
std::pair<const RawMotion&, const RawMotion&> WithCommonRoles(const RawMotion& truth, const RawMotion& answer,
                                                              RawMotion& changed_truth, RawMotion& changed_answer);

/// Returns the names of the first eight joints as text.
std::string SomeOf(const std::vector<std::string>& names);

}  // namespace etude
