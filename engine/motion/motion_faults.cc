#include "engine/motion/motion_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/motion/displacements.h"
#include "engine/motion/fault_limits.h"
#include "engine/motion/ground_faults.h"
#include "engine/motion/ground_view.h"
#include "engine/motion/limb_faults.h"
#include "engine/motion/statistics.h"

namespace etude {
namespace {

using enum FaultKind;

void AppendDisplacements(const BodyMotion& motion, const Displacements& displacements,
                         std::vector<MotionFault>& faults) {
  for (const Pop& pop : displacements.pops) {
    faults.push_back({kPops, pop.frames.first / motion.rate_hz, pop.frames.last / motion.rate_hz, pop.joint, pop.size});
  }
  for (const FrameRange& frozen : displacements.frozen) {
    const double from = frozen.first / motion.rate_hz, to = frozen.last / motion.rate_hz;
    faults.push_back({kFreezes, from, to, std::nullopt, to - from});
  }
}

/// Appends the stretches in which joints are not shown, if other frames show these joints.
void AppendGaps(const BodyMotion& motion, const FaultOptions& options, std::vector<MotionFault>& faults) {
  using fault_limits::kGap_s;
  if (motion.poses.empty()) return;
  JointSet always;
  always.set();
  for (const JointSet& unseen : options.unseen) always &= unseen;
  if (options.never) always = *options.never;
  std::vector<bool> is_lost;
  for (const JointSet& unseen : options.unseen) is_lost.push_back((unseen & ~always).any());
  for (const FrameRange& range : RangesOf(is_lost)) {
    const double seconds = (range.last - range.first + 1) / motion.rate_hz;
    if (seconds < kGap_s) continue;
    JointSet lost;
    for (int f = range.first; f <= range.last; ++f) lost |= options.unseen[f] & ~always;
    const Role first = *std::ranges::find_if(AllRoles(), [&](Role role) { return lost[Index(role)]; });
    faults.push_back({kGaps, range.first / motion.rate_hz, range.last / motion.rate_hz,
                      lost.count() == 1 ? std::optional(first) : std::nullopt, seconds});
  }
  const double end = static_cast<double>(motion.poses.size() - 1) / motion.rate_hz;
  if (options.lost_before_s >= kGap_s) {
    faults.push_back({kGaps, -options.lost_before_s, 0, std::nullopt, options.lost_before_s});
  }
  if (options.lost_after_s >= kGap_s) {
    faults.push_back({kGaps, end, end + options.lost_after_s, std::nullopt, options.lost_after_s});
  }
}

/// Appends a fault if the median speed of the fastest joint exceeds that of a sprinter's feet.
void AppendSpeed(const BodyMotion& motion, std::vector<MotionFault>& faults) {
  const double speed = ComputeStatistics(motion).speed_median_m_s;
  if (speed <= fault_limits::kFast_m_s) return;
  const double end = static_cast<double>(motion.poses.size() - 1) / motion.rate_hz;
  faults.push_back({kSpeed, 0, end, std::nullopt, speed});
}

/// Appends all faults but gaps.
void FindInFrames(const BodyMotion& motion, const FaultOptions& options, MotionFaults& found) {
  const Displacements displacements = FindDisplacements(motion, options.unseen);
  const GroundView ground(motion, displacements, options);
  found.floor_m = ground.floor();
  found.is_floor_found = ground.is_floor_found();
  FindLevelFaults(ground, found.faults);
  FindSkates(ground, options.unseen, found.faults);
  AppendDisplacements(motion, displacements, found.faults);
  FindLimbFaults(motion, options, displacements.pops, found.faults);
  const std::size_t count = found.faults.size();
  FindFalls(ground, found.faults);
  if (found.faults.size() == count) AppendSpeed(motion, found.faults);
}

std::string GravitySentence(const MotionFault& fault) {
  using fault_limits::kGravity;
  const bool is_fast = fault.size > kGravity;
  const double factor = is_fast ? fault.size / kGravity : kGravity / fault.size;
  return fmt::format(
      "in flight at {:.2f} s, the centre of mass falls with {:.1f} m/s² instead of {:.2f} m/s²: is the frame rate "
      "{:.2g} times too {}, or the unit of length {:.2g} times too {}?",
      fault.from_s, fault.size, kGravity, std::sqrt(factor), is_fast ? "high" : "low", factor,
      is_fast ? "large" : "small");
}

std::string SentenceOf(const MotionFault& fault, bool is_always) {
  // Prepare the time, the joint and the size, which most sentences contain.
  const std::string when = fault.lasts_s > 0 ? fmt::format("for {:.2f} s between {:.2f} and {:.2f} s", fault.lasts_s,
                                                           fault.from_s, fault.to_s)
                           : is_always       ? "in all frames"
                                             : fmt::format("from {:.2f} to {:.2f} s", fault.from_s, fault.to_s);
  const std::string joint(fault.joint ? RoleName(*fault.joint) : "");
  const double cm = 100 * fault.size;
  // Write the sentence of the fault's kind.
  switch (fault.kind) {
    case kFloats:
      if (is_always)
        return fmt::format("floats: the feet never touch the floor, and their resting height is {:.0f} cm", cm);
      return fmt::format("floats {:.0f} cm above the floor {}; are there steps, or is the floor at another height?", cm,
                         when);
    case kSinks:
      return fmt::format("sinks {:.0f} cm into the floor {}", cm, when);
    case kSkates:
      if (fault.joint) return fmt::format("{} alone skates at {:.0f} cm/s {}", joint, cm, when);
      return fmt::format("skates at {:.0f} cm/s {}: the standing feet move along the floor", cm, when);
    case kJumps:
      return fmt::format("the whole body jumps by {:.0f} cm at {:.2f} s", cm, fault.to_s);
    case kPops:
      return fmt::format("{} pops by {:.0f} cm at {:.2f} s", joint, cm, fault.from_s);
    case kFreezes:
      return fmt::format("freezes for {:.2f} s {}", fault.size, when);
    case kStretches:
      return fmt::format("the limb that ends at {} changes its length by {:.0f} % {}", joint, cm, when);
    case kBends:
      return fmt::format("{} bends backwards by {:.0f}° {}", joint, fault.size, when);
    case kTorn:
      if (!fault.joint) return fmt::format("left and right joints are exchanged, or lie on the same side, {}", when);
      return fmt::format("{} is torn off {}: it is {:.0f} cm from the position that the neighbouring joints imply",
                         joint, when, cm);
    case kGaps:
      return fmt::format("{} not shown for {:.2f} s {}", fault.joint ? joint + " is" : "joints are", fault.size, when);
    case kPasses:
      return fmt::format("{} passes through the trunk or the head {}, {:.0f} cm from the centre line", joint, when, cm);
    case kRate:
      return GravitySentence(fault);
    case kSpeed:
      return fmt::format("the fastest joint moves at {:.1f} m/s in the median frame; is the frame time right?",
                         fault.size);
  }
  return "";
}

std::vector<FaultRule> MakeFaultRules() {
  using namespace fault_limits;
  // Phrases that several rules use.
  const auto cm = [](double metres) { return fmt::format("{:g} cm", 100 * metres); };
  const auto percent = [](double share) { return fmt::format("{:g} %", 100 * share); };
  const std::string whole_body =
      fmt::format("{} of the joints, including at least one ankle,", percent(kAgreeingShare));
  std::string hovers;
  for (const Hovering& rule : kHoverings) {
    hovers += fmt::format("{}{} for {:g} s{}", hovers.empty() ? "" : ", ", cm(rule.height_m), rule.longest_s,
                          rule.is_upright ? " while upright" : "");
  }
  // One rule for each kind, in the order of FaultKind.
  return {
      {"floats", "m",
       fmt::format("The feet rest more than {} above the floor in the whole clip. Or all joints stay higher than a "
                   "limit ({}; limits above {} apply only if no foot rests). Or {} are displaced upwards by more than "
                   "{} from one frame to the next, until they come back.",
                   cm(kFloatInAll_m), hovers, cm(kStand_m), whole_body, cm(kLevel_m))},
      {"sinks", "m",
       fmt::format("The feet are more than {} below the floor for {:g} s, or in the whole clip. Or {} are displaced "
                   "downwards by more than {}, until they come back.",
                   cm(kSink_m), kSink_s, whole_body, cm(kLevel_m))},
      {"skates", "m/s",
       fmt::format(
           "Feet that should stand move together along the floor at {}/s or more for {:g} s, and few of these feet "
           "rest. Or {} change velocity by {}/s from one frame to the next (the limit is higher below {:g} Hz), and "
           "back after {:g} to {:g} s, and low feet move with these joints. Or the ankle and the toes of one low foot "
           "move together along the floor, faster than {}/s, for {:g} s ({:g} s if the velocity is constant).",
           cm(kGlide_m_s), kGlide_s, whole_body, cm(kStep_m_s), kSlow_hz, kMinCarried_s, kMaxCarried_s,
           cm(kFootSkate_m_s), kFootSkate_s, kEvenFootSkate_s)},
      {"jumps", "m",
       fmt::format("From one frame to the next, {} are displaced together, by more than {} along the floor or by more "
                   "than {} in any direction (measured by third differences of positions). Below {:g} Hz, both limits "
                   "grow with 1 / rate².",
                   whole_body, cm(kJumpAlongFloor_m), cm(kJump_m), kSlowJump_hz)},
      {"pops", "m",
       fmt::format(
           "One joint alone is displaced from one frame to the next: the third difference of its position is above {}, "
           "and above {:g} times the {}th percentile of this joint's third differences in the clip. A third difference "
           "above {} always counts. In clips of {:g} to {:.0f} frames, a third difference also counts if it is above "
           "{}, and above {:g} times the joint's largest third difference after the {:g} largest are removed. Below "
           "{:g} Hz, the limits of {} and {} grow with 1 / rate², as the third differences of fast motion do.",
           cm(kPop_m), kPopTimesUsual, 100 * kUsualPop, cm(kSurePop_m), kShortClipFrames, kPopFrames / (1 - kUsualPop),
           cm(kShortPop_m), kPopTimesUsual, kPopFrames, kSlow_hz, cm(kSurePop_m), cm(kShortPop_m))},
      {"freezes", "s",
       fmt::format(
           "No joint is faster than {:g} mm/s for {:g} s, and the body stops or starts abruptly (the mean speed of the "
           "joints is above {}/s just before or after). Or the frames repeat one pose exactly for {:g} s.",
           1000 * kStill_m_s, kFreeze_s, cm(kAbrupt_m_s), kRepeat_s)},
      {"stretches", "share",
       fmt::format(
           "The length of an upper arm, forearm, thigh or shank differs from its median by more than {}, for "
           "{:g} s. If both ends are markers on the skin, the difference must also exceed {:g} times the median "
           "deviation.",
           percent(kStretch), kStretch_s, kStretchTimesUsual)},
      {"bends", "deg",
       fmt::format("A knee bends backwards by more than {:g}° for {:g} s. The line between the hips determines the "
                   "front. The toes must agree with this front, except if the foot is missing or pointed.",
                   kBend_deg, kBend_s)},
      {"torn", "m",
       fmt::format("For {:g} s, a joint of trunk, head, shoulders, hips, toes or hands deviates from its usual "
                   "distance to its neighbours by 8 to 14 % of the length of leg and trunk. Or, in the median frame, "
                   "this distance is 1.6 to 3.5 times a person's usual distance, or differs from the distance on the "
                   "other side of the body. Or the head lies on the neck or points down the trunk. Or toes point "
                   "backwards. Or shoulders or hips are exchanged or coincide.",
                   kTorn_s)},
      {"gaps", "s",
       fmt::format("For {:g} s, every frame lacks a joint that other frames show. Or, for the same time at the "
                   "beginning or the end of the file, frames lack joints that Etude needs.",
                   kGap_s)},
      {"passes", "m",
       fmt::format("For {:g} s, a forearm or a hand is within {} of the line of the spine, or a forearm is equally "
                   "close to the line from neck to head.",
                   kPass_s, cm(kPass_m))},
      {"rate", "m/s2",
       fmt::format("In flight (all feet off the floor), the centre of mass falls with less than {:.1f} or more than "
                   "{:.1f} m/s². Then the frame rate or the unit of length is wrong.",
                   kGravity / kGravityFactor, kGravity * kGravityFactor)},
      {"speed", "m/s",
       fmt::format("In the median frame, the fastest joint is faster than {:g} m/s, and the clip has no flight from "
                   "which gravity could be measured.",
                   kFast_m_s)}};
}

}  // namespace

const std::vector<FaultRule>& FaultRules() {
  static const std::vector<FaultRule> rules = MakeFaultRules();
  return rules;
}

std::string_view FaultName(FaultKind kind) { return FaultRules()[static_cast<std::size_t>(kind)].name; }

std::string_view FaultUnit(FaultKind kind) { return FaultRules()[static_cast<std::size_t>(kind)].unit; }

MotionFaults FindMotionFaults(const BodyMotion& motion, const FaultOptions& options) {
  MotionFaults found{.floor_m = options.floor_m.value_or(0)};
  AppendGaps(motion, options, found.faults);
  if (motion.poses.size() >= kMinFramesForFaults) FindInFrames(motion, options, found);
  // Convert the faults' times to the file's clock, write the sentences, and sort the faults.
  const double duration = (static_cast<double>(motion.poses.size()) - 1) / motion.rate_hz;
  const bool is_whole = options.lost_before_s < fault_limits::kGap_s && options.lost_after_s < fault_limits::kGap_s;
  for (MotionFault& fault : found.faults) {
    const bool is_always = is_whole && fault.from_s <= 0 && fault.to_s >= duration;
    fault.from_s += options.begin_s;
    fault.to_s += options.begin_s;
    fault.text = SentenceOf(fault, is_always);
  }
  SortFaults(found.faults);
  return found;
}

void SortFaults(std::vector<MotionFault>& faults) {
  std::ranges::stable_sort(faults, [](const MotionFault& a, const MotionFault& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.from_s < b.from_s;
  });
}

std::vector<std::string> FaultSentences(const std::vector<MotionFault>& faults) {
  constexpr int kMaxAlike = 3;
  std::vector<std::string> sentences;
  int left_out = 0;
  for (const MotionFault& fault : faults) {
    // For kPasses, a smaller size (distance from the spine) is worse; for all other kinds, a larger size is worse.
    const auto is_worse = [&](const MotionFault& other) {
      if (other.kind != fault.kind || &other == &fault) return false;
      if (other.size == fault.size) return &other < &fault;
      return (other.size > fault.size) != (fault.kind == kPasses);
    };
    if (std::ranges::count_if(faults, is_worse) < kMaxAlike) {
      sentences.push_back(fault.text);
    } else {
      ++left_out;
    }
  }
  if (left_out > 0) sentences.push_back(fmt::format("and {} more like these", left_out));
  return sentences;
}

}  // namespace etude
