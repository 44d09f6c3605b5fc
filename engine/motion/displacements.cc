#include "engine/motion/displacements.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/order_statistics.h"
#include "engine/motion/fault_limits.h"

namespace etude {
namespace {

using PoseSteps = std::array<glm::dvec3, kRoleCount>;

/// Returns the displacement of each joint from frame `f` to the next, metres.
PoseSteps StepsFrom(const BodyMotion& motion, int f) {
  PoseSteps steps;
  for (std::size_t j = 0; j < kRoleCount; ++j) steps[j] = motion.poses[f + 1].joints[j] - motion.poses[f].joints[j];
  return steps;
}

/// Returns the median of each coordinate over the joints.
glm::dvec3 MedianOfJoints(const PoseSteps& vectors) {
  glm::dvec3 median{0};
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, kRoleCount> values;
    for (std::size_t j = 0; j < kRoleCount; ++j) values[j] = vectors[j][axis];
    std::ranges::sort(values);
    median[axis] = 0.5 * (values[kRoleCount / 2 - 1] + values[kRoleCount / 2]);
  }
  return median;
}

/// Returns how far the first step of each joint (`end` = 0), or the last one, differs from the step that its three
/// neighbours suggest: the shortest of its differences from each of these neighbours and from the linear continuation
/// of the two nearest ones. If only the step at the end contains a displacement, all four differences contain it. If
/// one of the neighbours contains a displacement, at least one of the differences is without it. The shortest
/// difference is chosen for the whole body (the median of the joints), and for each joint's motion relative to the
/// body.
PoseSteps DifferencesAtEnd(const BodyMotion& motion, int end) {
  std::array<PoseSteps, 4> steps, differences;
  for (int i = 0; i < 4; ++i) steps[static_cast<std::size_t>(i)] = StepsFrom(motion, end == 0 ? i : end - i);
  std::array<glm::dvec3, 4> medians;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      differences[i][j] = steps[0][j] - (i == 0 ? 2.0 * steps[1][j] - steps[2][j] : steps[i][j]);
    }
    medians[i] = MedianOfJoints(differences[i]);
  }
  const auto length = [](const glm::dvec3& vector) { return glm::length(vector); };
  const glm::dvec3 common = *std::ranges::min_element(medians, {}, length);
  PoseSteps shortest;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    std::array<glm::dvec3, 4> relative;
    for (std::size_t i = 0; i < 4; ++i) relative[i] = differences[i][j] - medians[i];
    shortest[j] = common + *std::ranges::min_element(relative, {}, length);
  }
  return shortest;
}

/// Returns, for each frame but the last, how far every joint's step to the next frame differs from the mean of the
/// steps before and after: minus half of the third difference. For the first and the last step: DifferencesAtEnd.
std::vector<PoseSteps> ThirdDifferences(const BodyMotion& motion) {
  const int last_step = static_cast<int>(motion.poses.size()) - 2;
  std::vector<PoseSteps> differences(motion.poses.size() - 1);
  PoseSteps before = StepsFrom(motion, 0), here = StepsFrom(motion, 1);
  for (int f = 1; f < last_step; ++f) {
    const PoseSteps after = StepsFrom(motion, f + 1);
    for (std::size_t j = 0; j < kRoleCount; ++j) differences[f][j] = here[j] - 0.5 * (before[j] + after[j]);
    before = here;
    here = after;
  }
  for (const int end : {0, last_step}) differences[static_cast<std::size_t>(end)] = DifferencesAtEnd(motion, end);
  return differences;
}

/// Returns the length of `median` if the vectors of enough joints, among them an ankle, are near it; otherwise 0. The
/// vectors of fast arms and legs may deviate.
double AgreedLength(const PoseSteps& vectors, const glm::dvec3& median, double relative, double absolute) {
  const double length = glm::length(median), tolerance = relative * length + absolute;
  const auto agrees = [&](const glm::dvec3& v) { return glm::distance(v, median) < tolerance; };
  if (!agrees(vectors[Index(Role::kLeftAnkle)]) && !agrees(vectors[Index(Role::kRightAnkle)])) return 0;
  const auto count = static_cast<double>(std::ranges::count_if(vectors, agrees));
  return count >= fault_limits::kAgreeingShare * kRoleCount ? length : 0;
}

/// Groups ascending frame numbers: numbers at most two apart are in one group.
std::vector<FrameRange> GroupsOf(const std::vector<int>& frames) {
  constexpr int kMaxGap = 2;
  std::vector<FrameRange> groups;
  for (const int f : frames) {
    if (!groups.empty() && f - groups.back().last <= kMaxGap) {
      groups.back().last = f;
    } else {
      groups.push_back({f, f});
    }
  }
  return groups;
}

std::vector<FrameRange> FindFrozen(const BodyMotion& motion) {
  // Limit of the joints' mean speed, metres per second. It replaces kAbrupt_m_s if the body is never nearly still
  // elsewhere.
  constexpr double kNeverAsStill = 0.003;
  // The motion stops and starts gently if the speed next to a freeze is at most this fraction of the speed one frame
  // farther from the freeze.
  constexpr double kGentle = 0.6;
  // Compute the mean speed of the joints at each step, and mark the steps without motion.
  const int steps = static_cast<int>(motion.poses.size()) - 1;
  std::vector<double> mean(steps);
  std::vector<bool> is_still(steps);
  for (int f = 0; f < steps; ++f) {
    double fastest = 0;
    for (const glm::dvec3& step : StepsFrom(motion, f)) {
      const double speed = glm::length(step) * motion.rate_hz;
      fastest = std::max(fastest, speed);
      mean[f] += speed / kRoleCount;
    }
    is_still[f] = fastest < fault_limits::kStill_m_s;
  }
  // A held pose is not a fault if the body comes to rest gently before it and moves gently after it. A pose that is
  // repeated exactly for `kRepeat_s` is always a fault, because no recorded person does this.
  std::vector<FrameRange> frozen;
  for (const FrameRange& range : RangesOf(is_still)) {
    if ((range.last - range.first + 1) / motion.rate_hz < fault_limits::kFreeze_s) continue;
    std::vector<double> elsewhere(mean.begin(), mean.begin() + range.first);
    elsewhere.insert(elsewhere.end(), mean.begin() + range.last + 1, mean.end());
    const auto repeats =
        static_cast<double>(std::count(mean.begin() + range.first, mean.begin() + range.last + 1, 0.0));
    if (repeats >= fault_limits::kRepeat_s * motion.rate_hz) {
      frozen.push_back({range.first, range.last + 1});
      continue;
    }
    if (elsewhere.empty()) continue;
    // If the body is never nearly still outside of these frames, a slower step already counts as abrupt.
    constexpr std::size_t kMinElsewhere = 20;
    const bool is_never_as_still = elsewhere.size() > kMinElsewhere && Quantile(elsewhere, 0.02) > kNeverAsStill;
    const double limit = is_never_as_still ? kNeverAsStill : fault_limits::kAbrupt_m_s;
    const auto is_abrupt = [&](int near, int farther) {
      if (near < 0 || near >= steps || mean[near] <= limit) return false;
      return farther < 0 || farther >= steps || mean[near] > kGentle * mean[farther];
    };
    if (is_abrupt(range.first - 1, range.first - 2) || is_abrupt(range.last + 1, range.last + 2)) {
      frozen.push_back({range.first, range.last + 1});
    }
  }
  return frozen;
}

/// Returns true if a frozen stretch begins or ends within three frames of `span`.
bool IsAtFrozenEnd(const FrameRange& span, const std::vector<FrameRange>& frozen) {
  constexpr int kNear = 3;
  const auto is_near = [&](int frame) { return span.first - kNear <= frame && frame <= span.last + kNear; };
  return std::ranges::any_of(frozen, [&](const FrameRange& f) { return is_near(f.first) || is_near(f.last); });
}

/// Returns the mean of the steps just before and after these steps. At an end of the motion, there is only one of them.
PoseSteps UsualSteps(const BodyMotion& motion, const FrameRange& steps) {
  PoseSteps mean{};
  const bool has_before = steps.first > 0, has_after = steps.last + 2 < static_cast<int>(motion.poses.size());
  const double share = has_before && has_after ? 0.5 : 1;
  const auto add = [&](const PoseSteps& one) {
    for (std::size_t j = 0; j < kRoleCount; ++j) mean[j] += share * one[j];
  };
  if (has_before) add(StepsFrom(motion, steps.first - 1));
  if (has_after) add(StepsFrom(motion, steps.last + 1));
  return mean;
}

/// Measures the displacement of `joint` over `steps`; if `joint` is absent, measures the displacement of the whole
/// body. Subtracts the usual steps.
Displacement Measure(const BodyMotion& motion, const FrameRange& steps, std::optional<Role> joint = std::nullopt) {
  const PoseSteps usual = UsualSteps(motion, steps);
  Displacement found{.before = steps.first, .after = steps.last + 1};
  PoseSteps moved{};
  std::vector<glm::dvec3> places = {glm::dvec3(0)};  // displacements from the frame `before`
  for (int f = steps.first; f <= steps.last; ++f) {
    const PoseSteps step = StepsFrom(motion, f);
    for (std::size_t j = 0; j < kRoleCount; ++j) moved[j] += step[j] - usual[j];
    found.lasting = joint ? moved[Index(*joint)] : MedianOfJoints(moved);
    if (glm::length(found.lasting) > glm::length(found.largest)) found.largest = found.lasting;
    places.push_back(found.lasting);
  }
  // Measure from both ends, and take the larger displacement. If both nearly agree, take the smaller: the difference is
  // then the body's own motion.
  glm::dvec3 from_after{0};
  for (const glm::dvec3& place : places) {
    if (glm::distance(place, found.lasting) > glm::length(from_after)) from_after = found.lasting - place;
  }
  constexpr double kAlike = 0.9;
  const auto [smaller, larger] = std::minmax({glm::length(found.largest), glm::length(from_after)});
  const double wanted = smaller > kAlike * larger ? smaller : larger;
  found.size = glm::length(found.largest) == wanted ? found.largest : from_after;
  return found;
}

/// Narrows `steps` to the main steps of a displacement: a displacement also changes the third differences of the
/// neighbouring steps, by half of the displacement's size. `size_of` returns the size of a step's third difference.
template <typename SizeOf>
FrameRange MainSteps(FrameRange steps, double largest, SizeOf size_of) {
  constexpr double kMainShare = 0.6;
  while (size_of(steps.first) <= kMainShare * largest) ++steps.first;
  while (size_of(steps.last) <= kMainShare * largest) --steps.last;
  return steps;
}

std::vector<Displacement> FindCommon(const BodyMotion& motion, const std::vector<double>& agreed,
                                     const std::vector<FrameRange>& frozen) {
  const double min = fault_limits::kMinCommon_m * fault_limits::TimesAt(motion.rate_hz, fault_limits::kSlow_hz);
  std::vector<int> hot;
  for (int f = 0; f < static_cast<int>(agreed.size()); ++f) {
    if (agreed[f] > min) hot.push_back(f);
  }
  std::vector<Displacement> found;
  for (const FrameRange& group : GroupsOf(hot)) {
    if (IsAtFrozenEnd(group, frozen)) continue;
    const double largest = *std::max_element(agreed.begin() + group.first, agreed.begin() + group.last + 1);
    found.push_back(Measure(motion, MainSteps(group, largest, [&](int f) { return agreed[f]; })));
  }
  return found;
}

/// A step at which the third difference of one joint's position is large.
struct Hot {
  int step = 0;
  Role joint = Role::kHipCentre;
  double size = 0;
};

std::vector<Hot> FindHot(const std::vector<PoseSteps>& differences, const std::vector<glm::dvec3>& common,
                         std::span<const JointSet> unseen, double rate_hz) {
  using namespace fault_limits;
  const double times = TimesAt(rate_hz, kSlow_hz), sure = times * kSurePop_m, at_least = times * kShortPop_m;
  std::vector<Hot> hot;
  std::vector<double> sizes(common.size());
  for (const Role joint : AllRoles()) {
    const std::size_t j = Index(joint);
    // A third difference is computed from four frames, and at an end from five, all of which must show the joint.
    const auto is_seen = [&](std::size_t f) {
      const std::size_t from = f == 0 ? 0 : f + 1 == common.size() ? f - 3 : f - 1;
      const std::size_t to = f == 0 ? 5 : std::min(f + 3, unseen.size());
      return std::none_of(unseen.begin() + static_cast<std::ptrdiff_t>(from),
                          unseen.begin() + static_cast<std::ptrdiff_t>(to),
                          [j](const JointSet& joints) { return joints[j]; });
    };
    for (std::size_t f = 0; f < common.size(); ++f) {
      const bool counts = unseen.empty() || is_seen(f);
      sizes[f] = counts ? glm::distance(differences[f][j], common[f]) : 0;
    }
    // In a short clip, two large pops of three or four steps each must not raise the quantile that stands for usual
    // motion.
    const auto count = static_cast<double>(sizes.size());
    const double share = count < kShortClipFrames ? kUsualPop : std::min(1 - kPopFrames / count, kUsualPop);
    const double large = std::max(kPopTimesUsual * Quantile(sizes, share), at_least);
    const double limit = std::min(std::clamp(kPopTimesUsual * Quantile(sizes, kUsualPop), kPop_m, sure), large);
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      if (sizes[f] > limit) hot.push_back({static_cast<int>(f), joint, sizes[f]});
    }
  }
  std::ranges::stable_sort(hot, {}, &Hot::step);
  return hot;
}

std::vector<Pop> FindPops(const BodyMotion& motion, const std::vector<PoseSteps>& differences,
                          const std::vector<glm::dvec3>& common, const std::vector<FrameRange>& frozen,
                          std::span<const JointSet> unseen) {
  constexpr double kAsLarge = 0.8;
  const std::vector<Hot> hot = FindHot(differences, common, unseen, motion.rate_hz);
  std::vector<int> steps;
  for (const Hot& h : hot) steps.push_back(h.step);
  std::vector<Pop> pops;
  for (const FrameRange& group : GroupsOf(steps)) {
    if (IsAtFrozenEnd(group, frozen)) continue;
    std::array<double, kRoleCount> largest{};
    for (const Hot& h : hot) {
      if (h.step < group.first || h.step > group.last) continue;
      largest[Index(h.joint)] = std::max(largest[Index(h.joint)], h.size);
    }
    const auto at = static_cast<std::size_t>(std::ranges::max_element(largest) - largest.begin());
    // A joint that pops also displaces the joints farther out on its limb, so the fault names the innermost joint.
    Role joint = AllRoles()[at];
    for (auto parent = ParentOf(joint); parent && largest[Index(*parent)] > kAsLarge * largest[at];
         parent = ParentOf(joint)) {
      joint = *parent;
    }
    const FrameRange main = MainSteps(group, largest[Index(joint)],
                                      [&](int f) { return glm::distance(differences[f][Index(joint)], common[f]); });
    pops.push_back({{main.first, main.last + 1}, joint, glm::length(Measure(motion, main, joint).size)});
  }
  return pops;
}

/// Returns the weighted mean of the joints' excesses (see FindVelocitySteps) at step `f`. A joint's weight is the
/// inverse of the sum of its squared excesses in nearby frames, so a standing foot weighs most.
glm::dvec2 WeightedMean(const std::vector<PoseSteps>& excesses, int f) {
  constexpr int kNear = 2, kFar = 6;   // nearer frames are left out: a velocity step changes their excesses, too
  constexpr double kSmallest = 1e-10;  // avoids a division by zero; square metres
  glm::dvec3 sum{0};
  double weights = 0;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    double around = kSmallest;
    for (int g = std::max(f - kFar, 0); g <= std::min(f + kFar, static_cast<int>(excesses.size()) - 1); ++g) {
      if (std::abs(g - f) >= kNear) around += glm::dot(excesses[g][j], excesses[g][j]);
    }
    sum += excesses[f][j] / around;
    weights += 1 / around;
  }
  return {sum.x / weights, sum.z / weights};
}

/// Finds sudden changes of the velocity along the floor: second differences much larger than in the neighbouring
/// frames.
std::vector<VelocityStep> FindVelocitySteps(const BodyMotion& motion, const Displacements& found) {
  constexpr double kTolerance = 0.4;
  constexpr int kNear = 3;
  const double min_m_s = fault_limits::kStep_m_s * std::max(1.0, fault_limits::kSlow_hz / motion.rate_hz);
  // Compute each second difference along the floor, and its excess over the mean of its two neighbours.
  const int frames = static_cast<int>(motion.poses.size());
  std::vector<PoseSteps> bends(motion.poses.size()), excesses(motion.poses.size());
  for (int f = 1; f + 1 < frames; ++f) {
    const PoseSteps before = StepsFrom(motion, f - 1), after = StepsFrom(motion, f);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3 bend = after[j] - before[j];
      bends[f][j] = {bend.x, 0, bend.z};
    }
  }
  for (int f = 2; f + 2 < frames; ++f) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      excesses[f][j] = bends[f][j] - 0.5 * (bends[f - 1][j] + bends[f + 1][j]);
    }
  }
  // Find the steps at which most joints share an excess, except near displacements and ends of frozen stretches.
  std::vector<VelocityStep> steps;
  for (int f = 2; f + 2 < frames; ++f) {
    const double length = AgreedLength(excesses[f], MedianOfJoints(excesses[f]), kTolerance, 0);
    if (length * motion.rate_hz < min_m_s || IsAtFrozenEnd({f, f}, found.frozen)) continue;
    const bool is_displaced = std::ranges::any_of(
        found.common, [f](const Displacement& d) { return d.before - kNear <= f && f <= d.after + kNear; });
    if (!is_displaced) steps.push_back({f, motion.rate_hz * WeightedMean(excesses, f)});
  }
  return steps;
}

}  // namespace

std::vector<FrameRange> RangesOf(const std::vector<bool>& is_marked) {
  std::vector<FrameRange> spans;
  for (int f = 0; f < static_cast<int>(is_marked.size()); ++f) {
    if (!is_marked[f]) continue;
    if (f > 0 && is_marked[f - 1]) {
      spans.back().last = f;
    } else {
      spans.push_back({f, f});
    }
  }
  return spans;
}

Displacements FindDisplacements(const BodyMotion& motion, std::span<const JointSet> unseen) {
  constexpr double kTolerance = 0.3, kTolerance_m = 0.005;
  Displacements found{.frozen = FindFrozen(motion), .common = {}, .pops = {}, .steps = {}};
  std::vector<glm::dvec3> common;
  std::vector<double> agreed;
  const std::vector<PoseSteps> differences = ThirdDifferences(motion);
  for (const PoseSteps& of_frame : differences) {
    common.push_back(MedianOfJoints(of_frame));
    agreed.push_back(AgreedLength(of_frame, common.back(), kTolerance, kTolerance_m));
  }
  found.common = FindCommon(motion, agreed, found.frozen);
  found.pops = FindPops(motion, differences, common, found.frozen, unseen);
  found.steps = FindVelocitySteps(motion, found);
  return found;
}

}  // namespace etude
