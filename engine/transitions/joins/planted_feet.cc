#include "engine/transitions/joins/planted_feet.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/smoothstep.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {
namespace {

/// Sums up pairs of points of the floor for the turn and shift that lay the second onto the first with the least sum of
/// squares.
class FloorFit {
 public:
  void Add(const glm::dvec3& onto, const glm::dvec3& point, double weight) {
    pairs_.push_back({{onto.x, onto.z}, {point.x, point.z}, weight});
    weight_ += weight;
    onto_ += weight * pairs_.back().onto;
    point_ += weight * pairs_.back().point;
  }

  FloorMove Solve() const {
    const glm::dvec2 onto = onto_ / weight_, point = point_ / weight_;
    double along = 0, across = 0;
    for (const Pair& pair : pairs_) {
      const glm::dvec2 o = pair.onto - onto, p = pair.point - point;
      along += pair.weight * glm::dot(o, p);
      across += pair.weight * (o.x * p.y - o.y * p.x);
    }
    const FloorMove turn{.yaw = std::atan2(across, along)};
    const glm::dvec3 moved = turn.Apply(glm::dvec3(point.x, 0, point.y));
    return {.yaw = turn.yaw, .x = onto.x - moved.x, .z = onto.y - moved.z};
  }

 private:
  struct Pair {
    glm::dvec2 onto, point;
    double weight;
  };
  std::vector<Pair> pairs_;
  double weight_ = 0;
  glm::dvec2 onto_{0}, point_{0};
};

double FloorDistance(const glm::dvec3& a, const glm::dvec3& b) { return std::hypot(a.x - b.x, a.z - b.z); }

/// The way of a foot from one path to the other, at its farthest in the window's middle half.
struct Travel {
  double floor = 0, whole = 0;  // metres
};

Travel TravelOf(const JoinWindow& window, Role foot, double begin, double end) {
  const int middle = static_cast<int>(std::lround(0.5 * (begin + end)));
  const glm::dvec3 &from = window.old[middle][foot], &to = window.next[middle][foot];
  return {FloorDistance(from, to), glm::distance(from, to)};
}

constexpr double kStill = 0.005;        // metres: a foot that travels no farther need not be lifted
constexpr double kMostLift = 0.09;      // metres
constexpr double kLiftPerMetre = 0.35;  // of travel

double LiftFor(double travel) {
  return travel <= kStill ? 0 : std::min(kMostLift, kLiftPerMetre * (travel - kStill) + 0.02);
}

/// The share of the frames of a step in which the foot stands in either motion: a step from there breaks a stand.
double StandingShare(const FootContacts& old, const FootContacts& next, std::size_t side, int begin, int end) {
  int standing = 0;
  for (int f = begin; f <= end; ++f) standing += old[side][f] || next[side][f] ? 1 : 0;
  return static_cast<double>(standing) / (end - begin + 1);
}

struct StepOption {
  FootStep step;
  double cost = 0;  // centimetres per frame²
  bool travels = false;
};

std::vector<StepOption> OptionsOf(const JoinWindow& window, const FootContacts& old, const FootContacts& next,
                                  std::size_t side) {
  const int frames = window.Frames();
  const int shortest = std::min(frames, 5);
  std::vector<int> ends;
  for (int part = 0; part <= 4; ++part) ends.push_back(part * frames / 4);
  std::vector<StepOption> options;
  for (int begin : ends) {
    for (int end : ends) {
      if (end - begin < shortest) continue;
      const Travel travel = TravelOf(window, kLegs[side].foot, begin, end);
      const double standing = StandingShare(old, next, side, begin, end);
      StepOption option;
      option.step = {.begin = static_cast<double>(begin), .end = static_cast<double>(end)};
      option.step.lift = standing > 0 ? LiftFor(travel.floor) : 0;
      option.travels = travel.floor > 0.02;
      const double length = end - begin;
      constexpr double kPeak = 577;  // of least jerk: 5.77 distance / duration², here in centimetres
      constexpr double kBrokenStand = 0.4;
      option.cost = kPeak * (travel.whole + 2 * option.step.lift) / (length * length) +
                    (option.travels ? kBrokenStand * standing : 0);
      options.push_back(option);
    }
  }
  return options;
}

bool Overlap(const FootStep& a, const FootStep& b) { return a.begin < b.end && b.begin < a.end; }

/// A leg's frame on the way from one motion's leg to the other's.
struct LegPath {
  glm::dvec3 ankle{0}, foot_limb{0};
};

LegPath PathAt(const JoinWindow& window, const LegRoles& leg, const FootStep& step, int frame) {
  const double s = std::clamp((frame - step.begin) / (step.end - step.begin), 0.0, 1.0);
  const double share = Smootherstep(s), rest = s * (1 - s);
  const BodyPose &old = window.old[frame], &next = window.next[frame];
  const glm::dvec3 from = old[leg.foot] - old[leg.ankle], to = next[leg.foot] - next[leg.ankle];
  glm::dvec3 toe = glm::mix(old[leg.foot], next[leg.foot], share);
  toe.y += step.lift * 64 * rest * rest * rest;
  // Turned backwards from the new limb, whose length it keeps.
  const glm::dvec3 limb = Turned(to, (1 - share) * TurnBetween(to, from));
  return {toe - limb, limb};
}

/// Returns how far a leg may reach: as far as both motions' own legs do, and a little less in the join's middle, where
/// a leg that is all but straight would throw its knee about.
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

/// Returns how much lower a hip must be for its leg to reach, metres; at most a hand's breadth.
double DropFor(const glm::dvec3& hip, const glm::dvec3& ankle, double reach) {
  constexpr double kMostDrop = 0.10;
  const double floor = FloorDistance(hip, ankle);
  if (floor >= reach) return kMostDrop;
  return std::clamp(hip.y - ankle.y - std::sqrt(reach * reach - floor * floor), 0.0, kMostDrop);
}

/// The smallest smooth curve over `needed`, as far as the ends, where it must be 0, allow.
std::vector<double> Smoothed(const std::vector<double>& needed) {
  const int count = static_cast<int>(needed.size());
  constexpr int kBlur = 2, kPasses = 2;
  const auto at = [&](const std::vector<double>& v, int i) { return v[std::clamp(i, 0, count - 1)]; };
  std::vector<double> curve(needed.size());
  for (int i = 0; i < count; ++i) {
    for (int k = -kBlur * kPasses; k <= kBlur * kPasses; ++k) curve[i] = std::max(curve[i], at(needed, i + k));
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<double> sharp = curve;
    for (int i = 0; i < count; ++i) {
      curve[i] = 0;
      for (int k = -kBlur; k <= kBlur; ++k) curve[i] += at(sharp, i + k) / (2 * kBlur + 1);
    }
  }
  const double ramp = std::max(std::min(8.0, (count - 1) / 2.0), 1.0);
  for (int i = 0; i < count; ++i) {
    curve[i] *= Smootherstep(i / ramp) * Smootherstep((count - 1 - i) / ramp);
  }
  return curve;
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
  // Straight legs do not say where their knees point: forwards, if nothing else does.
  constexpr double kForwards = 1e-3;
  const glm::dvec3 pole = glm::mix(carried(old), carried(next), share) + kForwards * Facing(pose);
  const Leg solved = SolveLeg(pose[leg.hip], path.ankle, thigh, shin, pole);
  pose[leg.knee] = solved.knee;
  pose[leg.ankle] = solved.ankle;
  pose[leg.foot] = solved.ankle + path.foot_limb;
}

}  // namespace

FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz) {
  FloorFit fit;
  constexpr double kTrunk = 0.25, kFeet = 0.1;
  for (Role role : {Role::kLeftHip, Role::kRightHip, Role::kLeftShoulder, Role::kRightShoulder}) {
    fit.Add(old[0][role], next[0][role], kTrunk);
  }
  const FootContacts stands_old = FindFootContacts(old, rate_hz), stands_next = FindFootContacts(next, rate_hz);
  for (std::size_t side = 0; side < kLegs.size(); ++side) {
    for (std::size_t f = 0; f < std::min(old.size(), next.size()); ++f) {
      if (!stands_old[side][f] || !stands_next[side][f]) continue;
      for (Role role : {kLegs[side].foot, kLegs[side].ankle}) fit.Add(old[f][role], next[f][role], kFeet);
    }
  }
  return fit.Solve();
}

FootPlan PlanSteps(const JoinWindow& window) {
  const FootContacts old = FindFootContacts(window.old, window.rate_hz);
  const FootContacts next = FindFootContacts(window.next, window.rate_hz);
  FootPlan plan;
  std::array<std::vector<StepOption>, 2> options;
  for (std::size_t side = 0; side < kLegs.size(); ++side) {
    plan[side].keeps = StandingShare(old, next, side, 0, window.Frames()) == 0;
    options[side] = OptionsOf(window, old, next, side);
  }
  constexpr double kHop = 2;  // centimetres per frame²: what it is worth not to leave the ground with both feet
  std::optional<double> least;
  for (const StepOption& left : options[0]) {
    for (const StepOption& right : options[1]) {
      const bool hops = left.travels && right.travels && Overlap(left.step, right.step);
      const double cost = left.cost + right.cost + (hops ? kHop : 0);
      if (least && cost >= *least) continue;
      least = cost;
      for (std::size_t side = 0; side < kLegs.size(); ++side) {
        const bool keeps = plan[side].keeps;
        plan[side] = side == 0 ? left.step : right.step;
        plan[side].keeps = keeps;
      }
    }
  }
  return plan;
}

void PlantFeet(const JoinWindow& window, std::vector<BodyPose>& played) {
  if (window.Frames() < 2) return;
  const FootPlan plan = PlanSteps(window);
  std::vector<double> drop(played.size());
  double farthest = 0;  // that any foot is off its path
  for (int frame = 1; frame < static_cast<int>(played.size()); ++frame) {
    for (std::size_t side = 0; side < kLegs.size(); ++side) {
      if (plan[side].keeps) continue;
      const LegPath path = PathAt(window, kLegs[side], plan[side], frame);
      const glm::dvec3& hip = played[frame][kLegs[side].hip];
      drop[frame] = std::max(drop[frame], DropFor(hip, path.ankle, ReachAt(window, kLegs[side], frame)));
      farthest = std::max(farthest, glm::distance(path.ankle, played[frame][kLegs[side].ankle]));
    }
  }
  constexpr double kRounding = 1e-9;
  if (farthest < kRounding) return;  // a motion that goes on as it was
  drop = Smoothed(drop);
  for (int frame = 1; frame < static_cast<int>(played.size()); ++frame) {
    BodyPose& pose = played[frame];
    for (glm::dvec3& joint : pose.joints) joint.y -= drop[frame];
    for (std::size_t side = 0; side < kLegs.size(); ++side) {
      if (plan[side].keeps) continue;
      PutLeg(window, kLegs[side], PathAt(window, kLegs[side], plan[side], frame), frame, pose);
    }
  }
}

Blend PlantedFeet(const JoinInput& input, const MinimumJerkOptions& options) {
  const PreferredJoin preferred = PreferredJoinOf(input, options);
  const JoinWindow window = WindowOfJoin(input, preferred);
  std::vector<BodyPose> played = PlayMinimumJerk(window, preferred.fades);
  PlantFeet(window, played);
  return ShowPlayed(std::move(played));
}

}  // namespace etude
