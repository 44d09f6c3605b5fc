#include "engine/transitions/joins/planted_feet.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {
namespace {

double FloorDistance(const glm::dvec3& a, const glm::dvec3& b) { return std::hypot(a.x - b.x, a.z - b.z); }

/// A set of frames of a window, one bit per frame.
using Frames = std::uint64_t;
constexpr int kMaxFrames = 63;  // longer joins plan steps only in their first frames

constexpr Frames Bit(int frame) { return Frames{1} << frame; }
/// Returns the frames from `first` to `last`, both included; empty if last < first.
constexpr Frames Range(int first, int last) {
  return last < first ? 0 : (Bit(last) | (Bit(last) - 1)) & ~(Bit(std::max(first, 0)) - 1);
}

/// The contacts of one foot in both motions of a window, the distances that the foot slides, and the movement of the
/// hips over the foot. The hips are interpolated between both motions, as an estimate of the join's hips.
struct FootTracks {
  FootTracks(const JoinWindow& w, const LegRoles& l, const std::vector<bool>& old, const std::vector<bool>& next)
      : window(w), leg(l), frames(std::min(w.Frames(), kMaxFrames)) {
    for (int f = 0; f <= frames; ++f) {
      old_stands |= old[f] ? Bit(f) : 0;
      next_stands |= next[f] ? Bit(f) : 0;
      const auto way = [&](const std::vector<BodyPose>& poses, bool stands) {
        return stands && f < frames ? FloorDistance(poses[f][leg.foot], poses[f + 1][leg.foot]) : 0;
      };
      old_slid[f + 1] = old_slid[f] + way(w.old, old[f]);
      next_slid[f + 1] = next_slid[f] + way(w.next, next[f]);
    }
    // Interpolate the hips' heading and the hip joint from the old motion to the new one.
    const auto across = [&](const BodyPose& pose) { return pose[leg.hip] - pose[Mirrored(leg.hip)]; };
    const auto toes = [&](const BodyPose& pose) { return pose[leg.foot] - pose[leg.ankle]; };
    double before = 0;
    for (int f = 0; f <= frames; ++f) {
      const double share = Smootherstep(static_cast<double>(f) / w.Frames());
      const double was = TurnOnFloor(across(w.old[0]), across(w.old[f]));
      const double heading = was + share * TurnOnFloor(across(w.old[f]), across(w.next[f]));
      hip[f] = glm::mix(w.old[f][leg.hip], w.next[f][leg.hip], share);
      turns[f] = std::remainder(heading - std::exchange(before, heading), 2 * kPi);
      if (f == 0) continue;
      old_turns[f] = turns[f] - TurnOnFloor(toes(w.old[f - 1]), toes(w.old[f]));
      next_turns[f] = turns[f] - TurnOnFloor(toes(w.next[f - 1]), toes(w.next[f]));
    }
    const BodyPose& pose = w.old[0];
    length = glm::distance(pose[leg.hip], pose[leg.knee]) + glm::distance(pose[leg.knee], pose[leg.ankle]);
  }
  bool StandsAtAll() const { return (old_stands | next_stands) != 0; }

  const JoinWindow& window;
  const LegRoles& leg;
  int frames = 0;  ///< number of frames in which steps are planned
  Frames old_stands = 0, next_stands = 0;
  /// For each frame, the distance that the foot slid in all earlier frames in which it stood, metres.
  std::array<double, kMaxFrames + 2> old_slid{}, next_slid{};
  std::array<glm::dvec3, kMaxFrames + 1> hip{};
  /// Turn of the hips since the previous frame, radians: against a foot that stays in its place, against the old
  /// motion's foot, and against the new motion's foot.
  std::array<double, kMaxFrames + 1> turns{}, old_turns{}, next_turns{};
  double length = 0;  ///< length of the stretched leg, metres
};

struct StepOption {
  FootStep step;
  double cost = 0;    // centimetres per frame²
  Frames stands = 0;  // the frames in which the foot bears weight
};

/// Returns the minimum-jerk movement of a step. It starts with the vector from the new motion's toe to the old
/// motion's toe, and ends with the zero vector.
Movement MovementOf(const JoinWindow& window, const LegRoles& leg, const FootStep& step) {
  const int from = std::min(step.begin, step.stays_from), to = std::max(step.begin, step.waits_until);
  const auto change = [&](const BodyPose& before, const BodyPose& after) {
    return (after[leg.foot] - before[leg.foot]) * window.rate_hz;
  };
  Movement movement{.start = window.old[from][leg.foot] - window.next[to][leg.foot]};
  if (from == step.begin) {
    // If the old motion has ended, use its last velocity.
    movement.start_velocity = from < window.old_frames ? change(window.old[from], window.old[from + 1])
                              : from > 0               ? change(window.old[from - 1], window.old[from])
                                                       : change(window.shown.before, window.shown.now);
  }
  if (to == step.begin) movement.start_velocity -= change(window.next[to], window.next[to + 1]);
  return movement;
}

/// Returns the cost of a foot's behaviour before and after its step, in metres per frame². If a foot stays in one
/// place, it stops or starts abruptly. If it follows its clip, it slides as far as the standing foot of the clip
/// slides.
double StandingPrice(const FootTracks& foot, const FootStep& step) {
  constexpr double kSliding = 0.3;  // cost of each metre that the foot slides
  const auto &old = foot.window.old, &next = foot.window.next;
  const Role toe = foot.leg.foot;
  double price = 0;
  if (step.stays_from < step.begin) {
    price += glm::distance(old[step.stays_from][toe], old[step.stays_from + 1][toe]);
  } else {
    price += kSliding * foot.old_slid[step.begin];
  }
  if (step.waits_until > step.end) {
    price += glm::distance(next[step.waits_until][toe], next[step.waits_until - 1][toe]);
  } else {
    price += kSliding * (foot.next_slid[foot.frames] - foot.next_slid[step.end]);
  }
  return price;
}

/// Returns the largest turn of the hips against the foot in any period in which the foot stands, radians. The frames
/// of `stands` are those in which the foot stands; the frames of the step are left out.
double LargestTurn(const FootTracks& foot, const FootStep& step, Frames stands) {
  TurnMeter meter;
  for (int f = 1; f <= foot.frames; ++f) {
    const bool steps = f > step.begin && f <= step.end;
    if (steps || (~stands & (Bit(f - 1) | Bit(f))) != 0) {
      meter.End();
    } else {
      meter.Add(f <= std::min(step.begin, step.stays_from) ? foot.old_turns[f]
                : f > std::max(step.end, step.waits_until) ? foot.next_turns[f]
                                                           : foot.turns[f]);
    }
  }
  return meter.largest();
}

/// Returns the cost of what a step demands of the body, in centimetres per frame². The cost grows with the turn of the
/// hips against the standing foot, and with the distance by which the foot is out of the leg's reach where the step
/// begins and ends.
double BodyPrice(const FootTracks& foot, const FootStep& step, Frames stands) {
  // The cost of each radian beyond kEasyTurn, and of each metre out of reach.
  constexpr double kTurning = 3, kEasyTurn = Radians(30), kStretching = 30;
  const auto stretch = [&](int frame, const BodyPose& pose) {
    return std::max(glm::distance(foot.hip[frame], pose[foot.leg.ankle]) - foot.length, 0.0);
  };
  return kTurning * std::max(LargestTurn(foot, step, stands) - kEasyTurn, 0.0) +
         kStretching * (stretch(step.begin, foot.window.old[std::min(step.begin, step.stays_from)]) +
                        stretch(step.end, foot.window.next[std::max(step.end, step.waits_until)]));
}

/// Returns the step with its lift, cost and supporting frames. The cost is the sum of StandingPrice, BodyPrice and
/// the peak accelerations of three minimum-jerk movements: one removes the offset between the motions, one removes
/// the difference of their velocities, and one lifts the foot.
StepOption Priced(const FootTracks& foot, const FootStep& step) {
  constexpr double kCm = 100;
  StepOption option{.step = step};
  const Movement movement = MovementOf(foot.window, foot.leg, step);
  const double travel = std::hypot(movement.start.x, movement.start.z), length = step.end - step.begin;
  // If the foot is in the air during the whole step, the motions themselves already lift it.
  const bool stands = ((foot.old_stands | foot.next_stands) & Range(step.begin, step.end)) != 0;
  option.step.lift = stands ? LiftFor(travel) : 0;
  const double peak = (5.8 * glm::length(movement.start) + 12 * option.step.lift) / (length * length) +
                      3.9 * glm::length(movement.start_velocity) / foot.window.rate_hz / length;
  option.cost = kCm * (peak + StandingPrice(foot, step));
  option.stands = (foot.old_stands & Range(0, step.begin)) | (foot.next_stands & Range(step.end, foot.frames)) |
                  Range(step.stays_from, step.begin) | Range(step.end, step.waits_until);
  if (travel <= kStill) option.stands |= foot.old_stands & foot.next_stands & Range(step.begin, step.end);
  option.cost += BodyPrice(foot, step, option.stands);
  return option;
}

/// Returns the last of `frames` that is at most `frame`; −1 without such a frame.
int LastUpTo(Frames frames, int frame) { return std::bit_width(frames & Range(0, frame)) - 1; }
/// Returns the first of `frames` that is at least `frame`; kNoFrame without such a frame.
int FirstFrom(Frames frames, int frame) {
  const Frames later = frames & ~Range(0, frame - 1);
  return later == 0 ? FootStep::kNoFrame : std::countr_zero(later);
}

/// Returns the frame whose position the foot can keep until `frame`. If the foot stands at `frame`, this is the first
/// frame of that stance. If the foot is in the air, it is the last frame of the previous stance; −1 if there is none.
int StaysFrom(Frames stands, int frame) {
  const int stood = LastUpTo(stands, frame);
  return stood == frame ? LastUpTo(~stands, frame) + 1 : stood;
}
/// Returns the frame whose position the foot can take from `frame` on. If the foot stands at `frame`, this is the last
/// frame of that stance, at most `last`. If the foot is in the air, it is the first frame of the next stance; kNoFrame
/// if there is none.
int WaitsUntil(Frames stands, int frame, int last) {
  const int lands = FirstFrom(stands, frame);
  return lands == frame ? std::min(FirstFrom(~stands, frame) - 1, last) : lands;
}

/// Returns the possible steps of a foot, which begin and end at tenths of the window. In variants of a step, the foot
/// keeps the position of its last stance before the step, takes the position of its next stance after the step, or does
/// both.
std::vector<StepOption> OptionsOf(const FootTracks& foot) {
  constexpr int kParts = 10, kMinStepFrames = 8;
  const int frames = foot.frames, shortest = std::min(frames, kMinStepFrames);
  std::vector<StepOption> options;
  for (int b = 0; b < kParts; ++b) {
    for (int e = b + 1; e <= kParts; ++e) {
      FootStep step{.begin = b * frames / kParts, .end = e * frames / kParts};
      if (step.end - step.begin < shortest) continue;
      options.push_back(Priced(foot, step));
      const int stood = StaysFrom(foot.old_stands, step.begin);
      const int lands = WaitsUntil(foot.next_stands, step.end, frames);
      const bool may_stay = stood >= 0 && stood<step.begin, may_wait = lands> step.end && lands <= frames;
      FootStep waits = step;
      if (may_wait) {
        waits.waits_until = lands;
        options.push_back(Priced(foot, waits));
      }
      if (may_stay) {
        step.stays_from = waits.stays_from = stood;
        options.push_back(Priced(foot, step));
      }
      if (may_stay && may_wait) options.push_back(Priced(foot, waits));
    }
  }
  return options;
}

/// The position of a leg's ankle and the vector from ankle to toe, in one frame of a step.
struct LegPath {
  glm::dvec3 ankle{0}, foot_limb{0};
};

LegPath PathAt(const JoinWindow& window, const LegRoles& leg, const FootStep& step, int frame) {
  const BodyPose& old = window.old[std::min({frame, step.begin, step.stays_from})];
  // Before the step, show the old motion's leg; from the frame `stays_from` on, keep its position in that frame. After
  // the step, show the new motion's leg; until the frame `waits_until`, show its position in that frame.
  const BodyPose& next = window.next[std::max(frame, step.waits_until)];
  const glm::dvec3 from = old[leg.foot] - old[leg.ankle], to = next[leg.foot] - next[leg.ankle];
  if (frame <= step.begin) return {old[leg.ankle], from};
  if (frame >= step.end) return {next[leg.ankle], to};
  // Move the toe with minimum jerk and lift it.
  const double s = static_cast<double>(frame - step.begin) / (step.end - step.begin), rest = s * (1 - s);
  glm::dvec3 toe = next[leg.foot] + MinimumJerkAt(MovementOf(window, leg, step), (frame - step.begin) / window.rate_hz,
                                                  (step.end - step.begin) / window.rate_hz);
  toe.y += step.lift * 64 * rest * rest * rest;
  // Rotate the foot from the new motion's direction back towards the old motion's direction; this keeps the foot's new
  // length.
  const glm::dvec3 limb = Turned(to, (1 - Smootherstep(s)) * TurnBetween(to, from));
  return {toe - limb, limb};
}

/// Returns how far a leg may reach from hip to ankle, metres: as far as in the two motions (interpolated), but at least
/// to 97 % of the leg's length. In the middle of the join the reach is 1 cm less, because the knee of an almost
/// straight leg moves abruptly.
double ReachAt(const JoinWindow& window, const LegRoles& leg, int frame) {
  const double s = static_cast<double>(frame) / window.Frames();
  const auto reach = [&](const BodyPose& pose) { return glm::distance(pose[leg.hip], pose[leg.ankle]); };
  const BodyPose& next = window.next[frame];
  const double whole = glm::distance(next[leg.hip], next[leg.knee]) + glm::distance(next[leg.knee], next[leg.ankle]);
  constexpr double kEasy = 0.97, kGiven = 0.01;
  const double own = glm::mix(reach(window.old[frame]), reach(next), Smootherstep(s));
  const double rest = s * (1 - s);
  return std::min(std::max(own, kEasy * whole), whole) - kGiven * 64 * rest * rest * rest;
}

/// Rotates a leg's pole (see SolveLeg) about the leg until it is at most 60° from the forward direction; `share` (0 to
/// 1) is how much of this rotation is applied. A pole that points backwards turns outwards, which keeps the legs apart.
/// (Depth sensors show straight legs as overextended; the join must not bend a knee further in that direction.)
glm::dvec3 BentForwards(const glm::dvec3& pole, const glm::dvec3& line, const glm::dvec3& forwards, bool is_left,
                        double share) {
  constexpr double kSide = Radians(60), kInwards = Radians(-120);
  const glm::dvec3 axis = is_left ? -UnitOr(line, {0, -1, 0}) : UnitOr(line, {0, -1, 0});
  const glm::dvec3 front = forwards - glm::dot(forwards, axis) * axis, outwards = glm::cross(axis, front);
  double angle = std::atan2(glm::dot(pole, outwards), glm::dot(pole, front) + 0.0);
  if (std::abs(angle) <= kSide) return pole;
  if (angle < kInwards) angle += 2 * kPi;
  return Turned(pole, -axis * ((angle - std::copysign(kSide, angle)) * share));
}

void PutLeg(const JoinWindow& window, const LegRoles& leg, const LegPath& path, int frame, BodyPose& pose) {
  const BodyPose &old = window.old[frame], &next = window.next[frame];
  const double share = Smootherstep(static_cast<double>(frame) / window.Frames());
  const double thigh = glm::distance(next[leg.hip], next[leg.knee]);
  const double shin = glm::distance(next[leg.knee], next[leg.ankle]);
  const glm::dvec3 line = path.ankle - pose[leg.hip];
  const auto carried = [&](const BodyPose& own) {
    return CarriedOffset(KneeOffset(own[leg.hip], own[leg.knee], own[leg.ankle]), own[leg.ankle] - own[leg.hip], line);
  };
  // A straight leg does not show where its knee points; assume forwards.
  constexpr double kForwards = 1e-3;
  const glm::dvec3 own = glm::mix(carried(old), carried(next), share) + kForwards * Facing(pose);
  const double s = static_cast<double>(frame) / window.Frames();
  const glm::dvec3 pole =
      BentForwards(own, line, Facing(pose), leg.hip == Role::kLeftHip, Smootherstep(3 * s) * Smootherstep(3 * (1 - s)));
  const Leg solved = SolveLeg(pose[leg.hip], path.ankle, thigh, shin, pole);
  pose[leg.knee] = solved.knee;
  pose[leg.ankle] = solved.ankle;
  pose[leg.foot] = solved.ankle + path.foot_limb;
}

}  // namespace

FootPlan PlanSteps(const JoinWindow& window) {
  if (window.Frames() < 2) return {};
  // List the possible steps of both feet, cheapest first.
  const FootContacts old = FindFootContacts(window.old, window.rate_hz);
  const FootContacts next = FindFootContacts(window.next, window.rate_hz);
  std::array<std::vector<StepOption>, 2> options;
  std::array<bool, 2> stands{};
  Frames borne = 0;
  for (std::size_t side = 0; side < kLegs.size(); ++side) {
    const FootTracks foot(window, kLegs[side], old[side], next[side]);
    options[side] = OptionsOf(foot);
    stands[side] = foot.StandsAtAll();
    borne |= foot.old_stands | foot.next_stands;
    std::ranges::stable_sort(options[side], {}, &StepOption::cost);
  }
  constexpr double kUnsupportedPrice = 2;  // centimetres per frame²; cost of a frame without a supporting foot
  // Find the cheapest pair of steps; both lists are sorted, so the search can stop early.
  FootPlan plan;
  double least = std::numeric_limits<double>::infinity();
  for (const StepOption& left : options[0]) {
    for (const StepOption& right : options[1]) {
      if (left.cost + right.cost >= least) break;
      const int unplanted_frames = std::popcount(borne & ~(left.stands | right.stands));
      const double cost = left.cost + right.cost + kUnsupportedPrice * unplanted_frames;
      if (cost >= least) continue;
      least = cost;
      plan = {.steps = {left.step, right.step}, .unplanted_frames = unplanted_frames};
    }
  }
  // A foot that stands in neither motion keeps its path.
  for (std::size_t side = 0; side < kLegs.size(); ++side) plan.steps[side].keeps = !stands[side];
  return plan;
}

void PlantFeet(const JoinWindow& window, const FootPlan& plan, std::vector<BodyPose>& played) {
  if (window.Frames() < 2) return;
  const std::array<FootStep, 2>& steps = plan.steps;
  // Find how far the hips must be lowered in each frame.
  std::vector<std::array<LegPath, 2>> paths(played.size());
  std::vector<double> drop(played.size());
  double farthest = 0;  // largest distance of an ankle from its path
  for (int frame = 1; frame < static_cast<int>(played.size()); ++frame) {
    for (std::size_t side = 0; side < kLegs.size(); ++side) {
      if (steps[side].keeps) continue;
      const LegPath& path = paths[frame][side] = PathAt(window, kLegs[side], steps[side], frame);
      const glm::dvec3& hip = played[frame][kLegs[side].hip];
      drop[frame] = std::max(drop[frame], HipDrop(hip, path.ankle, ReachAt(window, kLegs[side], frame)));
      farthest = std::max(farthest, glm::distance(path.ankle, played[frame][kLegs[side].ankle]));
    }
  }
  constexpr double kRounding = 1e-9;
  if (farthest < kRounding) return;  // the feet are already on their paths
  // Lower the body and solve each leg for its path.
  drop = SmoothlyAbove(drop);
  for (int frame = 1; frame < static_cast<int>(played.size()); ++frame) {
    BodyPose& pose = played[frame];
    for (glm::dvec3& joint : pose.joints) joint.y -= drop[frame];
    for (std::size_t side = 0; side < kLegs.size(); ++side) {
      if (steps[side].keeps) continue;
      PutLeg(window, kLegs[side], paths[frame][side], frame, pose);
    }
  }
}

Blend PlantedFeet(const JoinInput& input, const MinimumJerkOptions& options) {
  const PreferredJoin preferred = PreferredJoinOf(input, options);
  const JoinWindow window = WindowOfJoin(input, preferred);
  std::vector<BodyPose> played = PlayMinimumJerk(window, preferred.way);
  PlantFeet(window, PlanSteps(window), played);
  return ShowPlayed(std::move(played));
}

}  // namespace etude
