#include "engine/retargeting/stance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/motion/statistics.h"

namespace etude {
namespace {

using enum Role;

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

/// Returns true if the body sits upright: trunk and shanks along `up`, thighs perpendicular to it, and both ankles at
/// one height. A body that lies on its back or on one side with hips and knees at right angles has the same shape, and
/// so has a body that crawls (IsPropped).
bool IsSeated(const BodyPose& pose, const glm::dvec3& up, double stature) {
  constexpr double kAlong = 0.7, kAcross = 0.5, kLevel = 0.05;
  const glm::dvec3 knees = pose[kLeftKnee] + pose[kRightKnee];
  const glm::dvec3 shanks = knees - pose[kLeftAnkle] - pose[kRightAnkle];
  const glm::dvec3 thighs = knees - pose[kLeftHip] - pose[kRightHip];
  return IsUpright(pose, up) && glm::dot(shanks, up) > kAlong * glm::length(shanks) &&
         std::abs(glm::dot(thighs, up)) < kAcross * glm::length(thighs) &&
         std::abs(glm::dot(pose[kLeftAnkle] - pose[kRightAnkle], up)) < kLevel * stature;
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

}  // namespace

StanceFrames StanceFramesOf(std::span<const BodyPose> poses, double rate_hz) {
  constexpr std::size_t kMaxFrames = 4000;
  constexpr double kLater_s = 0.05;
  std::vector<double> statures;
  StanceFrames frames{.poses = poses, .stride = 1 + poses.size() / kMaxFrames, .rate_hz = rate_hz};
  for (std::size_t i = 0; i < poses.size(); i += frames.stride) statures.push_back(Stature(poses[i]));
  frames.stature = std::max(LowerPercentile(std::move(statures), 0.5), 1e-12);
  frames.later = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kLater_s * rate_hz)));
  frames.seconds = static_cast<double>(frames.later) / rate_hz;
  return frames;
}

AxisStance MeasureStance(const StanceFrames& frames, const glm::dvec3& up) {
  // The hips travel if their speed is at least kTravelling statures per second. Meanwhile an ankle stands if it moves
  // less than kStands times as far as the hips.
  constexpr double kTravelling = 0.15, kStands = 0.4, kTall = 0.8, kSideways = 0.7;
  AxisStance stance;
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
    stance.seated += IsSeated(pose, up, frames.stature) ? 1 : 0;
    const glm::dvec3 hips_line = pose[kLeftHip] - pose[kRightHip];
    stance.on_side += std::abs(glm::dot(hips_line, up)) > kSideways * glm::length(hips_line) ? 1 : 0;
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
  for (double* share : {&stance.upright, &stance.balanced, &stance.straight, &stance.tall, &stance.propped,
                        &stance.on_hands, &stance.seated, &stance.on_side}) {
    *share /= count;
  }
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

}  // namespace etude
