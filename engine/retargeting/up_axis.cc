#include "engine/retargeting/up_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/retargeting/stance.h"

namespace etude {
namespace {

/// Shares of the frames that are smaller than this count as never.
constexpr double kHardlyEver = 0.05;

/// Returns true if the body travels perpendicular to the axis while one foot stands.
bool Walks(const AxisStance& stance) { return stance.way > 0.5 && stance.steps > 0.4; }

/// Returns true if the lowest joint is near height 0.
bool IsNearFloor(const AxisStance& stance) {
  constexpr double kBelow = -0.03, kAbove = 0.08;
  return stance.bottom > kBelow && stance.bottom < kAbove;
}

/// Returns true if the motion shows that the body stands or sits along the axis: it walks, its lowest joint is near
/// height 0, it sits, or it moves over a floor that stays at one height.
bool ShowsStanding(const AxisStance& stance) {
  constexpr double kStillFloor = 0.05, kMostly = 0.75;
  constexpr double kSteps = 0.12, kRise = 0.08, kSway = 0.02;
  if (Walks(stance) || IsNearFloor(stance) || stance.seated > kMostly) return true;
  return stance.floor < kStillFloor &&
         (stance.ankle_way > kSteps || stance.hip_rise > kRise || (stance.balanced > kMostly && stance.sway > kSway));
}

/// Returns true if a body that is never upright along the usual axis squats or bows along the axis of `other`, over
/// feet at one height. A squat lowers the hips. A bow has the shape of a sit-up along the usual axis, so it counts only
/// if the lowest joint is not near height 0 along that axis. If the usual axis is a guess, the lowest joint must also
/// be near height 0 along the axis of `other`.
bool Bends(const AxisStance& other, const AxisStance& usual, const UpRule& rule) {
  constexpr double kPart = 0.3, kStillFloor = 0.05, kLowers = 0.08;
  const bool stands = other.upright > kPart && other.balanced > kPart && other.floor < kStillFloor;
  if (rule.is_of_rest || !stands || usual.upright >= kHardlyEver) return false;
  if (other.hip_rise > kLowers) return true;
  return other.shoulder_rise > kLowers && !IsNearFloor(usual) &&
         (rule.evidence != UpEvidence::kPosture || IsNearFloor(other));
}

/// Returns true if the motion is sufficient evidence that the axis of `other` points up instead of the axis of `usual`.
bool Overrules(const AxisStance& other, const AxisStance& usual, bool is_opposite, const UpRule& rule) {
  constexpr double kMostly = 0.8, kStillFloor = 0.05;
  // Exclude a handstand, in which the hands are beyond the head and the lowest joint stays at one height.
  if (is_opposite && other.on_hands > 0.5 && usual.floor < kStillFloor) return false;
  // Accept `other` if the lowest joint stays at one height along `other`, but not along the usual axis.
  constexpr double kNow = 0.1, kFloorless = 0.15;
  if (other.upright >= kNow && other.floor < kStillFloor && usual.floor > std::max(kFloorless, 3 * other.floor)) {
    return true;
  }
  if (!is_opposite && Bends(other, usual, rule)) return true;
  if (other.upright < kMostly || usual.upright >= kHardlyEver) return false;
  // Accept the opposite axis: along the usual axis the body would stand on its head, but nobody does so without using
  // the hands. Do not accept it here if the usual axis is only a guess (kPosture), because the body may then lie along
  // `other`.
  if (is_opposite && other.on_hands <= 0.5 && rule.evidence != UpEvidence::kPosture) return true;
  // Accept `other` if the body walks perpendicular to it.
  if (Walks(other)) return true;
  // Keep a stated axis if the body lies along `other` on a floor at height 0.
  constexpr double kLow = 0.005, kHigh = 0.08;
  if (rule.evidence != UpEvidence::kPosture && usual.lowest > kLow && usual.lowest + usual.floor < kHigh) return false;
  if (rule.is_of_rest) return false;
  // Accept `other` if, with `other` as the up axis, the body stands on its feet, and either the lowest joint's height
  // varies less than with the usual axis or the body is still.
  if (other.balanced > 0.75 && other.floor < kStillFloor && usual.floor > std::max(0.06, 2 * other.floor)) return true;
  return other.straight > 0.9 && other.balanced > 0.9 && other.floor < 0.02;
}

/// Returns true if the body sits along the axis of `other`, with its feet at one height, and is never upright along the
/// usual axis, nor carried by its hands there (unless it would lie on one side, where hands and legs touch the floor).
bool Sits(const AxisStance& other, const AxisStance& usual, const UpRule& rule) {
  constexpr double kMostly = 0.8, kStillFloor = 0.05, kRarely = 0.25;
  return !rule.is_of_rest && other.seated > kMostly && other.floor < kStillFloor && usual.upright < kHardlyEver &&
         (usual.propped < kRarely || usual.on_side > kMostly);
}

/// Describes, for users, how a body that seems upright along the usual axis shows that it may be on the floor, with
/// `other` as the up axis; "" if it does not show that. Each limit is beyond what people do who stand, walk, sit, jump
/// or climb stairs.
std::string DescribeFloorWork(const AxisStance& usual, const AxisStance& other) {
  // The body climbs along the usual axis, and the lowest joint's height hardly varies along the other axis. A person
  // who climbs stairs also travels forwards, and a person who jumps comes down at once.
  constexpr double kClimb = 0.6, kHover_s = 2, kSteep = 0.5, kMaxFloor = 0.6;
  const bool is_steep = usual.way < kSteep * usual.floor || usual.upright < 0.5;
  if (usual.floor > kClimb && usual.hover_s > kHover_s && is_steep &&
      other.floor < std::min(kMaxFloor, usual.floor / 4)) {
    return fmt::format("the lowest joint would rise by {:.2g} times the body's height", usual.floor);
  }
  // Hands and legs carry the body along the other axis; along the usual axis it would fall. Legs that are not straight
  // may be those of a person who sits.
  constexpr double kStillFloor = 0.05, kMostly = 0.75, kRarely = 0.25;
  if (other.propped > kMostly && other.floor < kStillFloor && usual.tall > kMostly && usual.balanced < kRarely) {
    return "the body would lean without support";
  }
  // The lowest joint stays near height 0 along the other axis, but is away from 0 along the usual axis.
  constexpr double kBelow = 0.005, kAbove = 0.08, kAway = 0.12;
  const bool is_away = usual.lowest > kAway || usual.lowest + usual.floor < -kAway;
  if (is_away && !Walks(usual) && other.floor < kStillFloor && other.lowest > kBelow &&
      other.lowest + other.floor < kAbove) {
    return fmt::format("the lowest joint would be at {:.2g} times the body's height", usual.lowest);
  }
  // Nothing shows that the body stands or sits along the usual axis, and along the other axis it may lie on something
  // that is not at height 0, such as a bed: its hips or its shoulders stay at one height.
  const bool may_lie = other.upright < kHardlyEver && std::min(other.hip_rise, other.shoulder_rise) < kStillFloor;
  if (may_lie && !ShowsStanding(usual)) return "nothing shows that the body stands or sits on a floor";
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
  const StanceFrames frames = StanceFramesOf(poses, rate_hz);
  const AxisStance usual = MeasureStance(frames, rule.axis);
  const glm::dvec3* best = nullptr;
  double most = 0;
  bool is_seated = false;
  for (const glm::dvec3& axis : kAxes) {
    // Motions estimated from videos are often in a camera's frame, whose Y axis points down, also if the format is Z
    // up.
    const bool is_cameras = rule.evidence == UpEvidence::kFormat && rule.axis.z > 0 && axis.y < 0;
    if (axis == rule.axis || (rule.is_y_or_z && axis.y + axis.z < 1 && !is_cameras)) continue;
    const AxisStance stance = MeasureStance(frames, axis);
    const bool overrules = Overrules(stance, usual, axis == -rule.axis, rule);
    if (stance.upright <= most || !(overrules || Sits(stance, usual, rule))) continue;
    most = stance.upright;
    best = &axis;
    is_seated = !overrules;
  }
  // AMASS has a floor at height 0. A body that is never upright is on that floor, or on something as high as a bed.
  constexpr double kBelowFloor = -0.08, kAboveBeds = 0.45;
  const bool is_off_floor = usual.lowest + usual.floor < kBelowFloor || usual.lowest > kAboveBeds;
  const bool has_floor = rule.evidence == UpEvidence::kFormat && rule.axis.z > 0;
  // Take the axis `best` if the rule's axis is only a guess (kPosture), unless a body that seems to sit along `best`
  // may lie on one side. If the file or its format states the axis, keep that axis and report the contradiction.
  constexpr double kMostly = 0.5;
  const std::string usually = fmt::format("{} is {}", AxisName(rule.axis), rule.source);
  const bool is_guess = rule.evidence == UpEvidence::kPosture;
  if (best != nullptr && rule.yields_to_walking && Walks(MeasureStance(frames, *best))) {
    found = {.axis = *best, .evidence = UpEvidence::kPosture, .source = "the body walks"};
    found.doubt = fmt::format("the body walks upright along {}, so Etude takes this axis as up, although {}",
                              AxisName(*best), usually);
  } else if (best != nullptr && is_guess && !(is_seated && usual.on_side > kMostly)) {
    found.axis = *best;
    found.source = "its posture";
    found.doubt = fmt::format("Etude assumes from the posture that {} is up, although {}", AxisName(*best), usually);
  } else if (is_seated) {
    found.doubt =
        fmt::format("{}, but the body sits along {}, or lies with bent hips and knees", usually, AxisName(*best));
  } else if (best != nullptr) {
    found.doubt = fmt::format("the body stands along {}, but {}", AxisName(*best), usually);
  } else if (has_floor && is_off_floor && usual.upright < kHardlyEver) {
    found.doubt = fmt::format(
        "{}, but the body is never upright along it, and its lowest joint is {:.2g} times its height {} height 0; the "
        "file may be in a camera's frame, or Y may be up",
        usually, std::abs(usual.lowest), usual.lowest < 0 ? "below" : "above");
  } else if (is_guess && usual.upright < kHardlyEver) {
    found.doubt =
        fmt::format("the posture never shows clearly which axis is up; {}, so Etude assumes this axis", usually);
  } else if (is_guess && !rule.is_y_or_z) {  // a skeleton also has a rest pose
    const glm::dvec3 other = rule.axis.y != 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const std::string odd = DescribeFloorWork(usual, MeasureStance(frames, other));
    if (!odd.empty()) {
      found.doubt = fmt::format("{}, so Etude assumes this axis, but then {}; if the body is on the floor, {} is up",
                                usually, odd, AxisName(other));
    }
  }
  // The user can state Y or Z: the axis that the posture shows, or the usual one instead of the posture's.
  const bool is_selectable = best == nullptr || best->y + best->z > 0 || found.axis == *best;
  if (!found.doubt.empty()) {
    found.doubt += is_selectable ? "; --up sets another axis" : "; --up allows only Y or Z, so rotate the file first";
  }
  return found;
}

UpFinding FindUp(const BodyPose& rest, std::span<const BodyPose> poses, double rate_hz) {
  constexpr double kStanding = 0.9;
  const glm::dvec3 at_rest = BodyAxis(rest);
  UpRule rule{.is_y_or_z = true};
  if (std::max(at_rest.y, at_rest.z) > kStanding) rule.source = "the axis along which the body stands at rest";
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

UpRule TableUp() { return {.source = "the usual axis of tables of points"}; }

UpRule ArrayUp() { return {.source = "the usual axis of arrays of joints"}; }

UpRule CameraUp() { return {.evidence = UpEvidence::kFormat, .source = "the up axis of a level camera"}; }

UpRule RawArraysUp() { return {.evidence = UpEvidence::kFormat, .source = "the convention of Etude's arrays"}; }

UpRule JointCsvUp() { return {.evidence = UpEvidence::kFormat, .source = "the convention of joint CSV"}; }

UpRule OwnJointsUp() { return {.evidence = UpEvidence::kFile, .source = "the convention of Etude's own joints"}; }

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
