#include "engine/retargeting/up_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/motion/statistics.h"

namespace etude {
namespace {

using enum Role;

/// Measurements of a motion under the assumption that one axis points up. Lengths are multiples of the stature.
struct Stance {
  double upright = 0;   ///< share of the frames with the trunk upright, the hips above the feet, and the head on top
  double balanced = 0;  ///< share of the frames with the mass centre over the feet
  double straight = 0;  ///< share of the frames with trunk, head and legs straight along the axis, as in static trials
  double tall = 0;      ///< share of the frames with the hips above the ankles by nearly the length of the legs
  double propped = 0;   ///< share of the frames in which hands and legs on one plane carry the body (IsPropped)
  double lowest = 0;    ///< the lowest joint's height in the file's axes (5th percentile)
  double bottom = 0;    ///< like `lowest`, but the 1st percentile, which also people who jump reach
  double floor = 0;     ///< range of the lowest joint's height (5th to 95th percentile)
  double hover_s = 0;   ///< longest time, seconds, with the lowest joint more than half a stature above `lowest`
  double way = 0;       ///< largest extent of the hip centre's path, perpendicular to the axis
  double steps = 0;     ///< of the frames in which the hips travel, the share in which an ankle stands
  double on_hands = 0;  ///< share of the frames with a wrist beyond the head, as in a handstand
  double seated = 0;    ///< share of the frames with the trunk upright, the thighs level and the shanks upright
  /// Ranges (5th to 95th percentile): of the heights of hip centre and shoulder centre; of the path of the stiller
  /// ankle; of the shoulder centre's path perpendicular to the axis.
  double hip_rise = 0, shoulder_rise = 0, ankle_way = 0, sway = 0;
};

/// Shares of the frames that are smaller than this count as never.
constexpr double kHardlyEver = 0.05;

double MeanLegLength(const BodyPose& pose) {
  return 0.5 * (glm::distance(pose[kLeftHip], pose[kLeftKnee]) + glm::distance(pose[kLeftKnee], pose[kLeftAnkle]) +
                glm::distance(pose[kRightHip], pose[kRightKnee]) + glm::distance(pose[kRightKnee], pose[kRightAnkle]));
}

glm::dvec3 MeanAnkle(const BodyPose& pose) { return 0.5 * (pose[kLeftAnkle] + pose[kRightAnkle]); }

bool IsUpright(const BodyPose& pose, const glm::dvec3& up) {
  constexpr double kSteep = 0.7, kAboveFeet = 0.25;
  const glm::dvec3 trunk = pose[kShoulderCentre] - pose[kHipCentre];
  return glm::dot(trunk, up) > kSteep * glm::length(trunk) &&
         glm::dot(pose[kHipCentre] - MeanAnkle(pose), up) > kAboveFeet * MeanLegLength(pose) &&
         glm::dot(pose[kHead] - pose[kShoulderCentre], up) > 0;
}

/// Returns a point at the body's weight.
glm::dvec3 WeightOf(const BodyPose& pose) {
  return 0.5 * pose[kHipCentre] + 0.35 * pose[kShoulderCentre] + 0.15 * pose[kHead];
}

double Lowest(const BodyPose& pose, const glm::dvec3& up) {
  double lowest = glm::dot(pose[kHipCentre], up);
  for (const Role role : AllRoles()) lowest = std::min(lowest, glm::dot(pose[role], up));
  return lowest;
}

/// Returns true if the body's weight lies over the box around ankles, toes and (estimated) heels.
bool IsBalanced(const BodyPose& pose, const glm::dvec3& up, double stature) {
  constexpr double kHeel = 0.035, kFootless = 0.09, kAboveFeet = 0.4, kMinFoot = 0.02;
  if (glm::dot(pose[kHipCentre] - MeanAnkle(pose), up) < kAboveFeet * MeanLegLength(pose)) return false;
  const auto flat = [&](const glm::dvec3& v) { return v - glm::dot(v, up) * up; };
  const glm::dvec3 feet = flat(0.5 * (pose[kLeftFoot] + pose[kRightFoot]) - MeanAnkle(pose));
  const double length = glm::length(feet);
  const glm::dvec3 some(up.y, up.z, up.x);  // an axis that is not parallel to `up`
  const glm::dvec3 ahead = length > kMinFoot * stature ? feet / length : some, aside = glm::cross(up, ahead);
  const double margin = (length > kMinFoot * stature ? kHeel : kFootless) * stature;
  const glm::dvec3 weight = WeightOf(pose);
  return std::ranges::all_of(std::array{ahead, aside}, [&](const glm::dvec3& axis) {
    const auto [low, high] = std::minmax({glm::dot(pose[kLeftAnkle], axis), glm::dot(pose[kRightAnkle], axis),
                                          glm::dot(pose[kLeftFoot], axis), glm::dot(pose[kRightFoot], axis)});
    const double at = glm::dot(weight, axis);
    return at > low - margin && at < high + margin;
  });
}

/// Returns true if the body's weight lies between hands and legs that are near the plane of the lowest joint, as in
/// push-ups and in crawling. People who stand are never propped along another axis: their weight is above their hands,
/// or their hands are far from the plane of their feet.
bool IsPropped(const BodyPose& pose, const glm::dvec3& up, double stature) {
  constexpr double kNear = 0.1, kMinApart = 0.3, kBetween = 0.1;
  const double plane = Lowest(pose, up) + kNear * stature;
  const auto middle_of = [&](std::initializer_list<Role> roles) -> std::optional<glm::dvec3> {
    glm::dvec3 sum(0);
    double count = 0;
    for (const Role role : roles) {
      if (glm::dot(pose[role], up) > plane) continue;
      sum += pose[role];
      count += 1;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
  };
  const auto hands = middle_of({kLeftWrist, kLeftHand, kRightWrist, kRightHand});
  const auto legs = middle_of({kLeftKnee, kLeftAnkle, kLeftFoot, kRightKnee, kRightAnkle, kRightFoot});
  if (!hands || !legs || glm::distance(*hands, *legs) < kMinApart * stature) return false;
  const glm::dvec3 span = *hands - *legs;
  const double at = glm::dot(WeightOf(pose) - *legs, span) / glm::dot(span, span);
  return at > kBetween && at < 1 - kBetween;
}

bool IsStraight(const BodyPose& pose, const glm::dvec3& up) {
  constexpr double kAlong = 0.97, kHeadAlong = 0.9, kKneeAside = 0.05;
  const auto is_along = [&](const glm::dvec3& v, double least) { return glm::dot(v, up) > least * glm::length(v); };
  const auto is_leg_straight = [&](Role hip, Role knee, Role ankle) {
    const glm::dvec3 leg = pose[hip] - pose[ankle];
    const double length = glm::length(leg);
    return is_along(leg, kAlong) &&
           glm::length(glm::cross(pose[knee] - pose[ankle], leg)) < kKneeAside * length * length;
  };
  return is_along(pose[kShoulderCentre] - pose[kHipCentre], kAlong) &&
         is_along(pose[kHead] - pose[kShoulderCentre], kHeadAlong) &&
         is_leg_straight(kLeftHip, kLeftKnee, kLeftAnkle) && is_leg_straight(kRightHip, kRightKnee, kRightAnkle);
}

/// The frames to measure: every n-th pose, each paired with the pose about a twentieth of a second later.
struct Frames {
  std::span<const BodyPose> poses;
  std::size_t stride = 1, later = 1;
  double seconds = 1;  ///< time between a frame and its later pose
  double rate_hz = 1;
  double stature = 1;
};

Frames FramesOf(std::span<const BodyPose> poses, double rate_hz) {
  constexpr std::size_t kMaxFrames = 4000;
  constexpr double kLater_s = 0.05;
  std::vector<double> statures;
  Frames frames{.poses = poses, .stride = 1 + poses.size() / kMaxFrames, .rate_hz = rate_hz};
  for (std::size_t i = 0; i < poses.size(); i += frames.stride) statures.push_back(Stature(poses[i]));
  frames.stature = std::max(LowerPercentile(std::move(statures), 0.5), 1e-12);
  frames.later = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kLater_s * rate_hz)));
  frames.seconds = static_cast<double>(frames.later) / rate_hz;
  return frames;
}

/// Returns true if the body sits with its shanks upright.
bool IsSeated(const BodyPose& pose, const glm::dvec3& up) {
  constexpr double kLevel = 0.5, kSteep = 0.9;
  const auto rise = [&](Role from, Role to) {
    const glm::dvec3 v = pose[to] - pose[from];
    return glm::dot(v, up) / std::max(glm::length(v), 1e-12);
  };
  return IsUpright(pose, up) && std::abs(rise(kLeftHip, kLeftKnee)) < kLevel &&
         std::abs(rise(kRightHip, kRightKnee)) < kLevel && rise(kLeftAnkle, kLeftKnee) > kSteep &&
         rise(kRightAnkle, kRightKnee) > kSteep;
}

/// Returns the largest range (5th to 95th percentile) of the three coordinates.
double RangeOf(const std::vector<glm::dvec3>& places) {
  double range = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const glm::dvec3& place : places) values.push_back(place[axis]);
    range = std::max(range, LowerPercentile(values, 0.95) - LowerPercentile(values, 0.05));
  }
  return range;
}

Stance MeasureStance(const Frames& frames, const glm::dvec3& up) {
  // The hips travel if their speed is at least kTravelling statures per second. Meanwhile an ankle stands if it moves
  // less than kStands times as far as the hips.
  constexpr double kTravelling = 0.15, kStands = 0.4, kTall = 0.8;
  Stance stance;
  std::vector<double> lowest;
  std::vector<glm::dvec3> hips_up, shoulders_up, left_ankle, right_ankle, shoulders;
  double count = 0, travelling = 0;
  glm::dvec3 low = frames.poses.front()[kHipCentre], high = low;
  const auto flat = [&](const glm::dvec3& v) { return v - glm::dot(v, up) * up; };
  for (std::size_t i = 0; i < frames.poses.size(); i += frames.stride) {
    // Classify the posture, and measure the height of the lowest joint.
    const BodyPose& pose = frames.poses[i];
    count += 1;
    stance.upright += IsUpright(pose, up) ? 1 : 0;
    stance.balanced += IsBalanced(pose, up, frames.stature) ? 1 : 0;
    stance.straight += IsStraight(pose, up) ? 1 : 0;
    const double hips_above = glm::dot(pose[kHipCentre] - MeanAnkle(pose), up);
    stance.tall += hips_above > kTall * MeanLegLength(pose) ? 1 : 0;
    stance.propped += IsPropped(pose, up, frames.stature) ? 1 : 0;
    const double wrist = std::max(glm::dot(pose[kLeftWrist], up), glm::dot(pose[kRightWrist], up));
    stance.on_hands += wrist > glm::dot(pose[kHead], up) ? 1 : 0;
    stance.seated += IsSeated(pose, up) ? 1 : 0;
    lowest.push_back(Lowest(pose, up));
    hips_up.push_back(glm::dot(pose[kHipCentre], up) * up);
    shoulders_up.push_back(glm::dot(pose[kShoulderCentre], up) * up);
    left_ankle.push_back(pose[kLeftAnkle]);
    right_ankle.push_back(pose[kRightAnkle]);
    shoulders.push_back(flat(pose[kShoulderCentre]));
    low = glm::min(low, pose[kHipCentre]);
    high = glm::max(high, pose[kHipCentre]);
    // Measure steps: one ankle stands while the hips travel.
    if (i + frames.later >= frames.poses.size()) continue;
    const BodyPose& later = frames.poses[i + frames.later];
    const auto moved = [&](Role role) { return glm::length(flat(later[role] - pose[role])); };
    const double hips = moved(kHipCentre);
    if (hips < kTravelling * frames.stature * frames.seconds) continue;
    travelling += 1;
    stance.steps += std::min(moved(kLeftAnkle), moved(kRightAnkle)) < kStands * hips ? 1 : 0;
  }
  stance.upright /= count;
  stance.balanced /= count;
  stance.straight /= count;
  stance.tall /= count;
  stance.propped /= count;
  stance.on_hands /= count;
  stance.seated /= count;
  stance.hip_rise = RangeOf(hips_up) / frames.stature;
  stance.shoulder_rise = RangeOf(shoulders_up) / frames.stature;
  stance.ankle_way = std::min(RangeOf(left_ankle), RangeOf(right_ankle)) / frames.stature;
  stance.sway = RangeOf(shoulders) / frames.stature;
  stance.steps = travelling > 0 ? stance.steps / travelling : 0;
  stance.lowest = LowerPercentile(lowest, 0.05) / frames.stature;
  stance.bottom = LowerPercentile(lowest, 0.01) / frames.stature;
  stance.floor = LowerPercentile(lowest, 0.95) / frames.stature - stance.lowest;
  constexpr double kHovers = 0.5;
  double run = 0;
  for (const double height : lowest) {
    run = height / frames.stature > stance.lowest + kHovers ? run + 1 : 0;
    stance.hover_s = std::max(stance.hover_s, run * static_cast<double>(frames.stride) / frames.rate_hz);
  }
  const glm::dvec3 box = flat(high - low);
  stance.way = std::max({std::abs(box.x), std::abs(box.y), std::abs(box.z)}) / frames.stature;
  return stance;
}

/// Returns true if the body travels perpendicular to the axis while one foot stands.
bool Walks(const Stance& stance) { return stance.way > 0.5 && stance.steps > 0.4; }

/// Returns true if the motion shows that the body stands or sits along the axis: it walks, its lowest joint is near
/// height 0, it sits, or it moves over a floor that stays at one height.
bool ShowsStanding(const Stance& stance) {
  constexpr double kBelow = -0.03, kAbove = 0.08, kStillFloor = 0.05, kMostly = 0.75;
  constexpr double kSteps = 0.12, kRise = 0.08, kSway = 0.02;
  if (Walks(stance) || (stance.bottom > kBelow && stance.bottom < kAbove) || stance.seated > kMostly) return true;
  return stance.floor < kStillFloor &&
         (stance.ankle_way > kSteps || stance.hip_rise > kRise || (stance.balanced > kMostly && stance.sway > kSway));
}

/// Returns true if the motion is sufficient evidence that the axis of `other` points up instead of the axis of `usual`.
bool Overrules(const Stance& other, const Stance& usual, bool is_opposite, const UpRule& rule) {
  constexpr double kMostly = 0.8, kStillFloor = 0.05;
  // Exclude a handstand, in which the hands are beyond the head and the lowest joint stays at one height.
  if (is_opposite && other.on_hands > 0.5 && usual.floor < kStillFloor) return false;
  // Accept `other` if the lowest joint stays at one height along `other`, but not along the usual axis.
  constexpr double kNow = 0.1, kFloorless = 0.15;
  if (other.upright >= kNow && other.floor < kStillFloor && usual.floor > std::max(kFloorless, 3 * other.floor)) {
    return true;
  }
  if (other.upright < kMostly || usual.upright >= kHardlyEver) return false;
  // Accept the opposite axis: along the usual axis the body would stand on its head, but nobody does so without using
  // the hands. Do not accept it here if the usual axis is only a guess (kPosture), because the body may then lie along
  // `other`.
  if (is_opposite && other.on_hands <= 0.5 && rule.evidence != UpEvidence::kPosture) return true;
  // Accept `other` if the body walks perpendicular to it.
  if (Walks(other)) return true;
  if (rule.is_of_rest) return false;
  // Accept `other` if, with `other` as the up axis, the body stands on its feet, and either the lowest joint's height
  // varies less than with the usual axis or the body is still.
  if (other.balanced > 0.75 && other.floor < kStillFloor && usual.floor > std::max(0.06, 2 * other.floor)) return true;
  return other.straight > 0.9 && other.balanced > 0.9 && other.floor < 0.02;
}

/// Describes, for users, how a body that seems upright along the usual axis shows that it may be on the floor, with
/// `other` as the up axis; "" if it does not show that. Each limit is beyond what people do who stand, walk, sit, jump
/// or climb stairs.
std::string DescribeFloorWork(const Stance& usual, const Stance& other) {
  // The body climbs along the usual axis, and the lowest joint's height hardly varies along the other axis. Who climbs
  // stairs travels forwards too, and who jumps comes down at once.
  constexpr double kClimb = 0.6, kHover_s = 2, kSteep = 0.5, kMaxFloor = 0.6;
  const bool is_steep = usual.way < kSteep * usual.floor || usual.upright < 0.5;
  if (usual.floor > kClimb && usual.hover_s > kHover_s && is_steep &&
      other.floor < std::min(kMaxFloor, usual.floor / 4)) {
    return fmt::format("its lowest joint would rise by {:.2g} times its stature", usual.floor);
  }
  // Hands and legs carry the body along the other axis; along the usual axis it would fall. Legs that are not straight
  // may be those of a person who sits.
  constexpr double kStillFloor = 0.05, kMostly = 0.75, kRarely = 0.25;
  if (other.propped > kMostly && other.floor < kStillFloor && usual.tall > kMostly && usual.balanced < kRarely) {
    return "it would lean without a support";
  }
  // The lowest joint stays near height 0 along the other axis, but is away from 0 along the usual axis.
  constexpr double kBelow = 0.005, kAbove = 0.08, kAway = 0.12;
  const bool is_away = usual.lowest > kAway || usual.lowest + usual.floor < -kAway;
  if (is_away && !Walks(usual) && other.floor < kStillFloor && other.lowest > kBelow &&
      other.lowest + other.floor < kAbove) {
    return fmt::format("its lowest joint would be at {:.2g} times its stature", usual.lowest);
  }
  // Nothing shows that the body stands or sits along the usual axis, and along the other axis it may lie on something
  // that is not at height 0, such as a bed: its hips or its shoulders stay at one height.
  const bool may_lie = other.upright < kHardlyEver && std::min(other.hip_rise, other.shoulder_rise) < kStillFloor;
  if (may_lie && !ShowsStanding(usual)) return "nothing shows that it stands or sits on a floor";
  return "";
}

constexpr std::array<glm::dvec3, 6> kAxes = {{{0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}}};

}  // namespace

std::string_view UpEvidenceName(UpEvidence evidence) {
  constexpr std::array<std::string_view, 4> kNames = {"told", "file", "format", "posture"};
  return kNames[static_cast<std::size_t>(evidence)];
}

UpFinding FindUp(std::span<const BodyPose> all, double rate_hz, const UpRule& rule) {
  UpFinding found{.axis = rule.axis, .evidence = rule.evidence, .source = rule.source};
  if (rule.evidence == UpEvidence::kTold) return found;
  std::vector<BodyPose> poses;
  std::ranges::copy_if(all, std::back_inserter(poses), [](const BodyPose& pose) {
    return std::ranges::all_of(pose.joints, [](const glm::dvec3& p) { return std::isfinite(glm::dot(p, p)); });
  });
  if (poses.empty()) return found;
  // Find the axes for which the motion is evidence; take the one along which the body is upright most often.
  const Frames frames = FramesOf(poses, rate_hz);
  const Stance usual = MeasureStance(frames, rule.axis);
  const glm::dvec3* best = nullptr;
  double most = 0;
  for (const glm::dvec3& axis : kAxes) {
    // Motions estimated from videos are often in a camera's frame, whose Y axis points down, also if the format is Z
    // up.
    const bool is_cameras = rule.evidence == UpEvidence::kFormat && rule.axis.z > 0 && axis.y < 0;
    if (axis == rule.axis || (rule.is_y_or_z && axis.y + axis.z < 1 && !is_cameras)) continue;
    const Stance stance = MeasureStance(frames, axis);
    if (stance.upright <= most || !Overrules(stance, usual, axis == -rule.axis, rule)) continue;
    most = stance.upright;
    best = &axis;
  }
  // Take the axis `best` if the rule's axis is only a guess (kPosture). If the file or its format states the axis, keep
  // that axis and report the contradiction.
  const std::string usually = fmt::format("{} is {}", AxisName(rule.axis), rule.source);
  if (best != nullptr && rule.yields_to_walking && Walks(MeasureStance(frames, *best))) {
    found = {.axis = *best, .evidence = UpEvidence::kPosture, .source = "the body walks"};
    found.doubt =
        fmt::format("the body walks upright along {}, which is taken to be up, although {}", AxisName(*best), usually);
  } else if (best != nullptr && rule.evidence == UpEvidence::kPosture) {
    found.axis = *best;
    found.source = "its posture";
    found.doubt = fmt::format("{} is assumed to be up only because of the posture: {}", AxisName(*best), usually);
  } else if (best != nullptr) {
    found.doubt = fmt::format("the body stands along {}, but {}", AxisName(*best), usually);
  } else if (rule.evidence == UpEvidence::kPosture && usual.upright < kHardlyEver) {
    found.doubt = fmt::format("the posture never shows clearly which axis is up: {}, so it is assumed", usually);
  } else if (rule.evidence == UpEvidence::kPosture && !rule.is_y_or_z) {  // a skeleton also has a rest pose
    const glm::dvec3 other = rule.axis.y != 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const std::string odd = DescribeFloorWork(usual, MeasureStance(frames, other));
    if (!odd.empty()) {
      found.doubt = fmt::format("{}, so it is assumed, but then {}: if the body is on the floor, {} is up", usually,
                                odd, AxisName(other));
    }
  }
  const bool is_selectable = best == nullptr || !rule.is_y_or_z || best->y + best->z > 0;
  if (!found.doubt.empty()) {
    found.doubt += is_selectable ? "; --up overrules that" : "; allowed: Y or Z, so the file must be rotated first";
  }
  return found;
}

UpFinding FindUp(const BodyPose& rest, std::span<const BodyPose> poses, double rate_hz) {
  constexpr double kStanding = 0.9;
  const glm::dvec3 at_rest = BodyAxis(rest);
  UpRule rule{.is_y_or_z = true};
  if (std::max(at_rest.y, at_rest.z) > kStanding) rule.source = "the axis along which it stands at rest";
  rule.is_of_rest = at_rest.y > kStanding;
  // Some exporters write a rest pose along Z and motions along Y, so a still stance overrules a rest pose along Z.
  if (at_rest.z > kStanding) rule.axis = {0, 0, 1};
  return FindUp(poses, rate_hz, rule);
}

UpRule TrcUp() { return {.source = "the usual axis of TRC files"}; }

UpRule C3dUp(char axis, bool is_negative) {
  if (axis == 0) return {.axis = {0, 0, 1}, .source = "the usual axis of C3D files"};
  UpRule rule{.axis = glm::dvec3(0), .evidence = UpEvidence::kFile, .source = "its Y_SCREEN entry"};
  rule.yields_to_walking = true;  // the entry only states how a program first shows the file (c3d.org)
  rule.axis[axis - 'X'] = is_negative ? -1 : 1;
  return rule;
}

UpRule ArrayUp() { return {.source = "the usual axis of arrays of joints"}; }

UpRule RawArraysUp() { return {.evidence = UpEvidence::kFormat, .source = "the convention of Etude's arrays"}; }

UpRule JointCsvUp() { return {.evidence = UpEvidence::kFormat, .source = "the convention of joint CSV"}; }

UpRule MotiveUp() {
  return {.evidence = UpEvidence::kFormat,
          .source = "the convention of Motive's exports",
          .yields_to_walking = true};  // Motive can also export Z up, and does not state it
}

UpRule AmassUp() {
  return {.axis = {0, 0, 1}, .evidence = UpEvidence::kFormat, .source = "the convention of AMASS", .is_y_or_z = true};
}

UpRule GltfUp() { return {.evidence = UpEvidence::kFormat, .source = "the convention of glTF", .is_y_or_z = true}; }

UpRule DeepMimicUp() {
  return {.evidence = UpEvidence::kFormat, .source = "the convention of DeepMimic", .is_y_or_z = true};
}

std::string AxisName(const glm::dvec3& axis) {
  for (int i = 0; i < 3; ++i) {
    if (axis[i] != 0) return std::string(axis[i] < 0 ? "−" : "") + "XYZ"[i];
  }
  return "no axis";
}

glm::dvec3 AxisOf(UpAxis up) { return up == UpAxis::kZ ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0); }

std::string DescribeTurn(const UpFinding& up) {
  if (up.axis == glm::dvec3(0, 1, 0)) return "";
  return fmt::format("turned upright from {} up ({})", AxisName(up.axis),
                     up.evidence == UpEvidence::kTold ? "given" : up.source);
}

glm::dvec3 TurnedUp(const glm::dvec3& p, const glm::dvec3& up) {
  if (up.z != 0) return {p.x, up.z * p.z, -up.z * p.y};
  if (up.x != 0) return {-up.x * p.y, up.x * p.x, p.z};
  return up.y < 0 ? glm::dvec3(p.x, -p.y, -p.z) : p;
}

}  // namespace etude
