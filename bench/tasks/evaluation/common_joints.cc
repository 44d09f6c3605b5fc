#include "bench/tasks/evaluation/common_joints.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "bench/tasks/evaluation/options.h"
#include "engine/base/names.h"
#include "engine/retargeting/data_set_names.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {

std::vector<CommonJoint> FindCommon(const RawMotion& truth, const RawMotion& answer, std::string_view set,
                                    std::vector<CommonJoint>& lacking) {
  std::vector<std::string> names;
  if (set == "same") {
    for (std::size_t j = 0; j < truth.joints.size(); ++j) {
      if (std::ranges::find(truth.added, static_cast<int>(j)) == truth.added.end()) names.push_back(truth.joints[j]);
    }
  } else if (set == "roles") {
    for (const Role role : AllRoles()) names.emplace_back(RoleName(role));
  } else {
    names = JointsOfSet(set);
  }
  std::vector<CommonJoint> common;
  for (const std::string& name : names) {
    const auto index_in = [&](const RawMotion& motion) {
      if (set != "same") return FindJoint(motion, name);
      const auto found = std::ranges::find(motion.joints, name);
      return found == motion.joints.end() ? -1 : static_cast<int>(found - motion.joints.begin());
    };
    const CommonJoint joint{name, index_in(truth), index_in(answer)};
    (joint.truth >= 0 && joint.answer >= 0 ? common : lacking).push_back(joint);
  }
  return common;
}

PointTracks JointColumns(const RawMotion& motion, const std::vector<int>& joints, std::size_t frames) {
  const auto is_whole = [&] {
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j] != static_cast<int>(j)) return false;
    }
    return joints.size() == motion.joints.size();
  };
  const auto begin = motion.positions.begin();
  if (is_whole()) return {joints.size(), {begin, begin + static_cast<std::ptrdiff_t>(joints.size() * frames)}};
  PointTracks tracks{joints.size(), std::vector<glm::dvec3>(joints.size() * frames)};
  glm::dvec3* out = tracks.positions.data();
  for (std::size_t f = 0; f < frames; ++f) {
    for (const int joint : joints) *out++ = motion.At(f, static_cast<std::size_t>(joint));
  }
  return tracks;
}

std::string SomeOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 8;
  const std::size_t count = std::min(names.size(), kMost);
  return Join(std::span(names).first(count)) + (count < names.size() ? ", …" : "");
}

std::vector<std::string> FindAlsoHeld(const RawMotion& truth, const RawMotion& answer,
                                      std::span<const CommonJoint> judged) {
  std::vector<std::string> held;
  std::vector<CommonJoint> lacking;
  for (const CommonJoint& same : FindCommon(truth, answer, "same", lacking)) {
    if (std::ranges::find(judged, same.truth, &CommonJoint::truth) == judged.end()) held.push_back(same.name);
  }
  return held;
}

Result<void> CheckCommon(const RawMotion& truth, const RawMotion& answer, std::size_t common, std::string_view set) {
  const auto own = [](const RawMotion& motion) { return motion.joints.size() - motion.added.size(); };
  const bool is_few = set != "same" && common < kNeededJoints.size() && 2 * common < std::min(own(truth), own(answer));
  if (common > 0 && !is_few) return {};
  for (const RawMotion* motion : {&truth, &answer}) {
    if (std::ranges::none_of(motion->positions, IsSeen)) {
      return Fail({motion->name}, "shows no joint in any frame; allowed: a motion that shows joints");
    }
  }
  if (set == "same") {
    return Fail({answer.name},
                "has no joint in common with the truth (joints: same); its joints are {}, those of the truth {}",
                SomeOf(answer.joints), SomeOf(truth.joints));
  }
  const auto with_role = [](const RawMotion& motion) {
    return std::ranges::count_if(motion.roles, [](int joint) { return joint >= 0; });
  };
  const bool is_of_answer = with_role(answer) <= with_role(truth);
  const RawMotion& unknown = is_of_answer ? answer : truth;
  return Fail({unknown.name},
              "has {} common with the {} (joints: {}); its joints are {}. Give their roles in a joint map "
              "(--joint-map), or compare joints of equal names (--joints same){}{}",
              common == 0   ? "no joint in"
              : common == 1 ? "1 joint in"
                            : fmt::format("only {} joints in", common),
              is_of_answer ? "truth" : "answer", set, SomeOf(unknown.joints), unknown.notes.empty() ? "" : "; ",
              Join(unknown.notes, "; "));
}

namespace {

/// If only `other` has a skeleton, gives the joints of `motion` the roles of the joints of `other` with the same names.
/// Returns `motion` itself if a needed role would then be missing. `changed` holds the result if it differs from
/// `motion`.
const RawMotion& WithRolesOfNamesakes(const RawMotion& motion, const RawMotion& other, RawMotion& changed) {
  if (!motion.parents.empty() || other.parents.empty()) return motion;
  auto roles = RawMotion::NoRoles();
  for (const Role role : AllRoles()) {
    const int theirs = other.roles[Index(role)];
    if (theirs < 0) continue;
    const auto mine = std::ranges::find(motion.joints, other.joints[static_cast<std::size_t>(theirs)]);
    if (mine != motion.joints.end()) roles[Index(role)] = static_cast<int>(mine - motion.joints.begin());
  }
  if (std::ranges::any_of(kNeededJoints, [&](Role role) { return roles[Index(role)] < 0; })) return motion;
  if (roles == motion.roles) return motion;
  changed = motion;
  changed.roles = roles;
  if (roles[Index(Role::kHipCentre)] < 0) AddMidwayHips(changed);
  changed.notes.push_back("its joints got their roles from the other file's joints of the same names");
  return changed;
}

/// Returns the motion with the midpoint of the hips as its root. `changed` holds the result if it differs from
/// `motion`.
const RawMotion& WithMidwayRoot(const RawMotion& motion, RawMotion& changed) {
  if (!HasOwnRoot(motion)) return motion;
  if (&motion != &changed) changed = motion;
  AddMidwayHips(changed);
  return changed;
}

}  // namespace

std::pair<const RawMotion&, const RawMotion&> WithCommonRoles(const RawMotion& truth, const RawMotion& answer,
                                                              RawMotion& changed_truth, RawMotion& changed_answer) {
  const RawMotion& true_roles = WithRolesOfNamesakes(truth, answer, changed_truth);
  const RawMotion& found_roles = WithRolesOfNamesakes(answer, truth, changed_answer);
  const bool has_truth = HasOwnRoot(true_roles), has_answer = HasOwnRoot(found_roles);
  return {has_answer ? true_roles : WithMidwayRoot(true_roles, changed_truth),
          has_truth ? found_roles : WithMidwayRoot(found_roles, changed_answer)};
}

}  // namespace etude
