#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/raw_motion.h"

namespace etude {

/// A joint that both motions have, by the joint's index in each motion.
struct CommonJoint {
  std::string name;
  int truth = -1, answer = -1;
};

/// Returns the joints of `set` that both motions have. Adds the set's other joints to `lacking`.
std::vector<CommonJoint> FindCommon(const RawMotion& truth, const RawMotion& answer, std::string_view set,
                                    std::vector<std::string>& lacking);

/// Returns the error if the motions have so few common joints, by roles, that their names cannot have been understood.
Result<void> CheckCommon(const RawMotion& truth, const RawMotion& answer, std::size_t common, std::string_view set);

/// Returns truth and answer with comparable roles, each a given motion or stored in `changed_…`:
/// - If only one has a skeleton and its needed joints all have namesakes in the other, its roles hold for both, because
///   such markers were computed with this skeleton.
/// - The root is the motions' own joint if both have one, otherwise the midpoint of the hips.
std::pair<const RawMotion&, const RawMotion&> WithCommonRoles(const RawMotion& truth, const RawMotion& answer,
                                                              RawMotion& changed_truth, RawMotion& changed_answer);

/// Returns the names of the first eight joints as text.
std::string SomeOf(const std::vector<std::string>& names);

}  // namespace etude
