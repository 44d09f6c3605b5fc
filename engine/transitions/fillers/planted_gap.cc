#include "engine/transitions/fillers/planted_gap.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/joins/limbs.h"
#include "engine/transitions/joins/minimum_jerk.h"

namespace etude {
namespace {

/// The joints of a leg in a file's tree. `tip`, the point that stands, is the toes or, without toes, the ankle.
struct TreeLeg {
  int hip = -1, knee = -1, ankle = -1, tip = -1;
};

/// The world positions and rotations of a tree's joints in one frame.
struct Globals {
  Globals(const JointTree& tree, const TreePose& pose) { AppendGlobals(tree, pose, positions, turns); }
  const glm::dvec3& operator[](int joint) const { return positions[static_cast<std::size_t>(joint)]; }
  double Lowest() const { return std::ranges::min(positions, {}, &glm::dvec3::y).y; }

  std::vector<glm::dvec3> positions;
  std::vector<glm::dquat> turns;
};

/// A set of frames, one bit per frame: the frame before the gap (bit 0), the gap, and the frame after it.
constexpr std::size_t kMaxFrames = 256;
using Frames = std::bitset<kMaxFrames>;

/// A period in which a foot stands at one place. If a foot is in the air at an end of the gap, it gets a stance of one
/// frame there that does not bear weight (`bears` is false).
struct Stance {
  int from = 0, to = 0;
  bool bears = true;
  glm::dvec3 tip{0};
};

/// The stances of one foot, in order. Between two stances the foot makes a step.
struct Footfalls {
  std::vector<Stance> stances;
  double cost = 0;  // m²: mean squared distance from the filled path, plus prices for steps, speed and stretch
  Frames stands;
};

/// The data from which the steps of one foot are planned.
struct FootView {
  const glm::dvec3& End(std::size_t end) const { return end == 0 ? path.front() : path.back(); }
  /// Returns the position of `leg.tip` at an end of the gap, lowered by `raised`.
  glm::dvec3 Lowered(std::size_t end) const { return End(end) - glm::dvec3(0, raised[end], 0); }

  TreeLeg leg;
  std::vector<glm::dvec3> path;    ///< filled positions of `leg.tip`, from the frame before the gap to the one after it
  std::vector<glm::dvec3> hips;    ///< positions of the leg's hip joint in the frames of `path`
  glm::dvec3 velocity{0};          ///< velocity of `leg.tip` before the gap, metres per second
  std::array<bool, 2> stands{};    ///< [0]: true if the foot stands before the gap; [1]: after the gap
  double length = 0;               ///< length of the stretched leg from hip to tip, metres
  std::array<double, 2> raised{};  ///< height of the tip above the floor minus 2 cm, metres, ≥ 0; 0 on other surfaces
};

constexpr double kLowest_m = 0.1, kRest_mps = 0.4, kLanded_m = 0.06, kPassing_m = 0.02, kTravels_mps = 0.5;

/// Finds the legs and their paths. Returns nullopt if the tree lacks a role of the legs.
std::optional<std::array<FootView, 2>> ViewFeet(const Gap& gap, std::span<const Globals> frames) {
  using enum Role;
  std::array<FootView, 2> feet;
  const Globals before(gap.tree, gap.past[gap.past.size() - 2]);
  const bool knows_velocity = gap.future.size() > 1;
  // Collect the joints of each leg, the paths of its tip and hip, and the tip's velocity before the gap.
  for (std::size_t side = 0; side < feet.size(); ++side) {
    const auto joint = [&](Role left) { return gap.roles[Index(side == 0 ? left : Mirrored(left))]; };
    FootView& foot = feet[side];
    TreeLeg& leg = foot.leg;
    leg = {joint(kLeftHip), joint(kLeftKnee), joint(kLeftAnkle), joint(kLeftFoot)};
    if (std::min({leg.hip, leg.knee, leg.ankle}) < 0) return std::nullopt;
    if (leg.tip < 0) leg.tip = leg.ankle;
    for (const Globals& frame : frames) {
      foot.path.push_back(frame[leg.tip]);
      foot.hips.push_back(frame[leg.hip]);
    }
    const Globals& first = frames.front();
    foot.length = glm::distance(first[leg.hip], first[leg.knee]) + glm::distance(first[leg.knee], first[leg.ankle]) +
                  glm::distance(first[leg.ankle], first[leg.tip]);
    foot.velocity = gap.rate_hz * (first[leg.tip] - before[leg.tip]);
  }
  // Find the floor's height: that of the lowest tip of a foot before and after the gap. A standing tip that is 2 to 12
  // cm above the floor belongs to a raised foot; a higher tip stands on another surface.
  double floor = std::numeric_limits<double>::infinity();
  const auto look = [&](const TreePose& pose) {
    const Globals frame(gap.tree, pose);
    for (const FootView& foot : feet) floor = std::min(floor, frame[foot.leg.tip].y);
  };
  std::ranges::for_each(gap.past.last(std::min<std::size_t>(gap.past.size(), 10)), look);
  std::ranges::for_each(gap.future, look);
  constexpr double kRaised_m = 0.02, kSurface_m = 0.12;
  const double speed = glm::distance(gap.past.back().root, gap.future.front().root) / gap.Seconds();
  const double landed = std::min(feet[0].path.back().y, feet[1].path.back().y);
  for (FootView& foot : feet) {
    const int tip = foot.leg.tip;
    for (std::size_t end = 0; end < 2; ++end) {
      const double rise = foot.End(end).y - floor;
      foot.raised[end] = rise <= kSurface_m ? std::max(rise - kRaised_m, 0.0) : 0;
    }
    // A foot stands at an end of the gap if its tip is slow and near the height of the lowest joint there.
    const glm::dvec3 &first = frames.front()[tip], &last = frames.back()[tip];
    foot.stands[0] = first.y <= frames.front().Lowest() + kLowest_m && glm::length(foot.velocity) <= kRest_mps;
    // With one future frame, the velocity is unknown and only the height decides. The limit of the height is lower if
    // the body travels, because a walking person lifts the foot only a little.
    const glm::dvec3 after = knows_velocity ? Globals(gap.tree, gap.future[1])[tip] : last;
    const double highest = knows_velocity ? kLowest_m : speed > kTravels_mps ? kPassing_m : kLanded_m;
    foot.stands[1] = last.y <= frames.back().Lowest() + kLowest_m && last.y <= landed + highest &&
                     gap.rate_hz * glm::distance(after, last) <= kRest_mps;
  }
  return feet;
}

/// Returns the floor's height at each end of the gap: that of the foot's tip if the foot stands; else that of the other
/// foot's tip; else that at the other end. Returns nullopt if no foot stands at either end.
std::optional<std::array<double, 2>> Floors(const FootView& foot, const FootView& other) {
  std::array<std::optional<double>, 2> known;
  for (std::size_t end = 0; end < 2; ++end) {
    for (const FootView* one : {&other, &foot}) {
      if (one->stands[end]) known[end] = one->Lowered(end).y;
    }
  }
  if (!known[0] && !known[1]) return std::nullopt;
  return std::array{known[0] ? *known[0] : *known[1], known[1] ? *known[1] : *known[0]};
}

double SquareOnFloor(const glm::dvec3& a, const glm::dvec3& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.z - b.z) * (a.z - b.z);
}

/// Lists the possible footfalls of one foot.
class FootPlanner {
 public:
  FootPlanner(const FootView& foot, const std::array<double, 2>& floors, double rate_hz)
      : foot_(foot), floors_(floors), last_(static_cast<int>(foot.path.size()) - 1), rate_hz_(rate_hz) {
    sums_.push_back(glm::dvec3(0));
    for (const glm::dvec3& tip : foot.path) sums_.push_back(sums_.back() + tip);
  }

  /// Returns the 300 cheapest sequences of footfalls, in ascending order of cost.
  std::vector<Footfalls> Cheapest() {
    std::vector<Stance> stances = {
        {.bears = foot_.stands[0], .tip = foot_.stands[0] ? foot_.Lowered(0) : foot_.End(0)}};
    Extend(stances);
    constexpr std::size_t kKept = 300;
    std::ranges::stable_sort(found_, {}, &Footfalls::cost);
    found_.resize(std::min(found_.size(), kKept));
    return std::move(found_);
  }

 private:
  int Of(double seconds) const { return std::max(static_cast<int>(std::lround(seconds * rate_hz_)), 1); }

  /// Adds all ways to continue after the last stance in `stances`, whose end is still open.
  void Extend(std::vector<Stance>& stances) {
    constexpr std::size_t kMaxSteps = 3;
    constexpr double kMinStance_s = 0.15;
    static constexpr std::array kStep_s = {0.27, 0.4, 0.53};
    Stance& stance = stances.back();
    // First possibility: the foot stays to the end of the gap.
    if (stance.bears && foot_.stands[1] && stances.size() == 1) End(stances, stance.from);
    if (stances.size() > kMaxSteps) return;
    // Other possibilities: the foot steps, at once if it is in the air, otherwise after a stance of any length.
    const int grid = std::max(last_ / 15, 1);
    const int earliest = stance.bears ? stance.from + (stances.size() > 1 ? Of(kMinStance_s) : 0) : stance.from;
    for (int begin = earliest; begin < last_; begin += grid) {
      const Stance kept = stances.back();
      stances.back().to = begin;
      if (kept.bears && stances.size() > 1) stances.back().tip = MeanTip(kept.from, begin);
      for (const double step_s : kStep_s) {
        const int end = begin + Of(step_s);
        if (end >= last_) break;
        stances.push_back({.from = end});
        Extend(stances);
        if (foot_.stands[1]) End(stances, end);
        stances.pop_back();
      }
      if (!foot_.stands[1]) {
        stances.push_back({.from = last_, .to = last_, .bears = false, .tip = foot_.path.back()});
        Keep(stances);
        stances.pop_back();
      } else if (last_ - begin <= Of(kStep_s.back())) {
        stances.push_back({.from = last_});
        End(stances, last_);
        stances.pop_back();
      }
      stances.back() = kept;
      if (!kept.bears) break;
    }
  }

  /// Completes a sequence of footfalls: the last stance begins at `from` and lasts to the end of the gap. Stores the
  /// sequence.
  void End(std::vector<Stance> stances, int from) {
    stances.back() = {.from = from, .to = last_, .bears = true, .tip = foot_.Lowered(1)};
    if (stances.size() == 1) stances.front().tip = foot_.Lowered(0);
    Keep(stances);
  }

  glm::dvec3 MeanTip(int from, int to) const {
    glm::dvec3 mean = (sums_[static_cast<std::size_t>(to) + 1] - sums_[static_cast<std::size_t>(from)]) /
                      static_cast<double>(to - from + 1);
    mean.y = glm::mix(floors_[0], floors_[1], 0.5 * (from + to) / last_);
    return mean;
  }

  /// Computes the cost of a sequence of footfalls and stores it.
  void Keep(const std::vector<Stance>& stances) {
    constexpr double kPerStep = 0.02, kPerDrift = 30, kPerHaste = 0.01, kHaste_mps = 4, kPerStretch = 4, kPerLate = 0.2,
                     kLong_s = 0.55;
    Footfalls made;
    made.stances = stances;
    const double share = 1.0 / (last_ + 1);
    // The cost of a frame is the squared distance from the filled path on the floor, plus the square of the leg's
    // stretch beyond its length.
    const auto far = [&](int frame, const glm::dvec3& tip) {
      const double stretch =
          std::max(glm::distance(foot_.hips[static_cast<std::size_t>(frame)], tip) - foot_.length, 0.0);
      return share *
             (SquareOnFloor(tip, foot_.path[static_cast<std::size_t>(frame)]) + kPerStretch * stretch * stretch);
    };
    // Add up the costs of the stances and of the steps between them; fast and late steps cost more.
    for (std::size_t i = 0; i < stances.size(); ++i) {
      const Stance& stance = stances[i];
      for (int f = stance.from; f <= stance.to; ++f) {
        made.cost += far(f, stance.tip);
        if (stance.bears) made.stands.set(static_cast<std::size_t>(f));
      }
      if (i == 0) continue;
      const Stance& before = stances[i - 1];
      const int frames = stance.from - before.to;
      for (int f = before.to + 1; f < stance.from; ++f) {
        const double s = Smootherstep(static_cast<double>(f - before.to) / frames);
        made.cost += far(f, glm::mix(before.tip, stance.tip, s));
      }
      const double speed = std::sqrt(SquareOnFloor(before.tip, stance.tip)) * rate_hz_ / frames;
      const double haste = std::max(speed - kHaste_mps, 0.0), late = std::max(frames / rate_hz_ - kLong_s, 0.0);
      made.cost += kPerStep + kPerHaste * haste * haste + kPerLate * late;
    }
    // Add a cost for drift if a foot never steps.
    if (stances.size() == 1) made.cost += kPerDrift * SquareOnFloor(stances[0].tip, foot_.path.back());
    found_.push_back(std::move(made));
  }

  const FootView& foot_;
  const std::array<double, 2> floors_;
  const int last_;
  const double rate_hz_;
  std::vector<glm::dvec3> sums_;  // sums_[n]: the sum of the path's first n positions
  std::vector<Footfalls> found_;
};

/// Returns the cheapest combination of the left foot's and the right foot's footfalls.
std::array<Footfalls, 2> PlanFeet(const std::array<std::vector<Footfalls>, 2>& feet, std::size_t frames) {
  const double per_frame = 0.3 / static_cast<double>(frames);  // price of a frame in which no foot stands
  double least = std::numeric_limits<double>::infinity();
  std::array<const Footfalls*, 2> best{};
  for (const Footfalls& left : feet[0]) {
    for (const Footfalls& right : feet[1]) {
      if (left.cost + right.cost >= least) break;
      const auto borne = static_cast<double>((left.stands | right.stands).count());
      const double cost = left.cost + right.cost + per_frame * (static_cast<double>(frames) - borne);
      if (cost >= least) continue;
      least = cost;
      best = {&left, &right};
    }
  }
  return {*best[0], *best[1]};
}

/// The target of a foot's tip and the rotation of its ankle joint, in the world.
struct FootPose {
  glm::dvec3 tip{0};
  glm::dquat turn{1, 0, 0, 0};
};

/// Returns the pose of a foot in each frame. `turns` are the filled rotations of the ankle.
std::vector<FootPose> Walk(const FootView& foot, const Footfalls& falls, std::span<const glm::dquat> turns,
                           double rate_hz) {
  const std::size_t count = foot.path.size();
  const int last = static_cast<int>(count) - 1;
  std::vector<FootPose> poses(count);
  const auto turn_of = [&](const Stance& stance) {
    const int middle = stance.from == 0 ? 0 : stance.to == last ? last : (stance.from + stance.to) / 2;
    return turns[static_cast<std::size_t>(middle)];
  };
  for (std::size_t i = 0; i < falls.stances.size(); ++i) {
    const Stance& stance = falls.stances[i];
    for (int f = stance.from; f <= stance.to; ++f) poses[static_cast<std::size_t>(f)] = {stance.tip, turn_of(stance)};
    if (i == 0) continue;
    // Compute the step from the previous stance: minimum jerk, with a free end velocity if the step ends in the air.
    const Stance& before = falls.stances[i - 1];
    const int frames = stance.from - before.to;
    const glm::dvec3 way = stance.tip - before.tip;
    Ends ends{.start = before.tip, .end = stance.tip, .seconds = frames / rate_hz};
    if (!before.bears) ends.start_velocity = foot.velocity * glm::dvec3(1, 0.5, 1);  // swinging feet soon stop rising
    if (stance.bears) ends.end_velocity = glm::dvec3(0);
    const double share = before.bears ? 1 : stance.bears ? 0.5 : 0;  // a foot in the air is already partly lifted
    const double lift = share * LiftFor(std::hypot(way.x, way.z));
    for (int f = before.to + 1; f < stance.from; ++f) {
      const double s = static_cast<double>(f - before.to) / frames, rest = s * (1 - s);
      FootPose& pose = poses[static_cast<std::size_t>(f)];
      pose.tip = LeastJerkAt(ends, s * ends.seconds);
      pose.tip.y = std::max(pose.tip.y, std::min(before.tip.y, stance.tip.y)) + lift * 64 * rest * rest * rest;
      pose.turn = glm::slerp(turn_of(before), turn_of(stance), Smootherstep(s));
    }
  }
  // A foot that never steps moves linearly from its position before the gap to its position after it. A raised foot is
  // lowered within kLower_s.
  constexpr double kLower_s = 0.2;
  for (std::size_t f = 0; f < count; ++f) {
    const double s = static_cast<double>(f) / last;
    if (falls.stances.size() == 1) {
      poses[f] = {glm::mix(foot.Lowered(0), foot.Lowered(1), s), glm::slerp(turns.front(), turns.back(), s)};
    }
    for (std::size_t end = 0; end < 2; ++end) {
      const double since = (end == 0 ? s : 1 - s) * last / rate_hz;
      if (foot.stands[end]) poses[f].tip.y += foot.raised[end] * (1 - Smootherstep(since / kLower_s));
    }
  }
  return poses;
}

/// Returns the ankle's rotation with the heel raised about the tip: just enough for the leg to reach the foot.
glm::dquat RaisedHeel(const FootPose& foot, const glm::dvec3& hip, const glm::dvec3& limb, double reach) {
  const glm::dvec3 heel = -(foot.turn * limb), to_hip = hip - foot.tip;
  const double length = glm::length(heel), far = glm::length(to_hip);
  if (length == 0 || far == 0 || glm::distance(to_hip, heel) <= reach) return foot.turn;
  const double cosine = (length * length + far * far - reach * reach) / (2 * length * far);
  const glm::dvec3 whole = TurnBetween(heel, to_hip);
  const double angle = glm::length(whole), wanted = std::acos(std::clamp(cosine, -1.0, 1.0));
  constexpr double kMost = 1.0;  // largest rotation, radians
  const double turn = std::clamp(angle - wanted, 0.0, kMost);
  return angle > 0 ? TurnOf(whole * (turn / angle)) * foot.turn : foot.turn;
}

/// Solves one leg of a pose by inverse kinematics, so that the leg reaches the pose `foot`.
void SetLeg(const JointTree& tree, const TreeLeg& leg, const FootPose& foot, double reach, TreePose& pose) {
  const auto at = [](int joint) { return static_cast<std::size_t>(joint); };
  const Globals world(tree, pose);
  const glm::dvec3 &hip = world[leg.hip], &knee = world[leg.knee], &ankle = world[leg.ankle];
  const glm::dvec3 limb = glm::conjugate(world.turns[at(leg.ankle)]) * (world[leg.tip] - ankle);
  const glm::dquat turn = RaisedHeel(foot, hip, limb, reach);
  const glm::dvec3 target = foot.tip - turn * limb;
  constexpr double kForwards = 1e-3;  // metres along the foot, so that the knee of a straight leg bends forwards
  const glm::dvec3 pole = CarriedOffset(KneeOffset(hip, knee, ankle), ankle - hip, target - hip) +
                          kForwards * UnitOr(turn * limb, glm::dvec3(0));
  const Leg solved = SolveLeg(hip, target, glm::distance(hip, knee), glm::distance(knee, ankle), pole);
  // Rotate thigh and shin by the smallest rotations, then the foot.
  const glm::dquat thigh = TurnOf(TurnBetween(knee - hip, solved.knee - hip));
  const glm::dquat shin = TurnOf(TurnBetween(thigh * (ankle - knee), solved.ankle - solved.knee)) * thigh;
  const auto parent = [&](int joint) {
    const int above = tree.parents[at(joint)];
    return above < 0 ? glm::dquat(1, 0, 0, 0) : world.turns[at(above)];
  };
  pose.turns[at(leg.hip)] = glm::normalize(glm::conjugate(parent(leg.hip)) * thigh * world.turns[at(leg.hip)]);
  pose.turns[at(leg.knee)] =
      glm::normalize(glm::conjugate(thigh * parent(leg.knee)) * shin * world.turns[at(leg.knee)]);
  pose.turns[at(leg.ankle)] = glm::normalize(glm::conjugate(shin * parent(leg.ankle)) * turn);
}

}  // namespace

void PlantGap(const Gap& gap, std::vector<TreePose>& filled) {
  if (gap.frames + 2 > kMaxFrames) return;
  // Compute the world transforms of both ends and of the filled frames.
  std::vector<Globals> frames = {Globals(gap.tree, gap.past.back())};
  for (const TreePose& pose : filled) frames.emplace_back(gap.tree, pose);
  frames.emplace_back(gap.tree, gap.future.front());
  const auto feet = ViewFeet(gap, frames);
  if (!feet) return;
  // Plan the footfalls.
  std::array<std::vector<Footfalls>, 2> plans;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto floors = Floors((*feet)[side], (*feet)[1 - side]);
    if (!floors) return;
    plans[side] = FootPlanner((*feet)[side], *floors, gap.rate_hz).Cheapest();
    if (plans[side].empty()) return;
  }
  const std::array<Footfalls, 2> falls = PlanFeet(plans, frames.size());
  // Compute the feet's poses, and how far the hips must be lowered.
  std::array<std::vector<FootPose>, 2> walks;
  std::array<double, 2> reach{};
  std::vector<double> drop(frames.size());
  for (std::size_t side = 0; side < 2; ++side) {
    const TreeLeg& leg = (*feet)[side].leg;
    std::vector<glm::dquat> turns;
    for (const Globals& frame : frames) turns.push_back(frame.turns[static_cast<std::size_t>(leg.ankle)]);
    walks[side] = Walk((*feet)[side], falls[side], turns, gap.rate_hz);
    const Globals &first = frames.front(), &last = frames.back();
    const auto length = [&](int a, int b) { return glm::distance(first[a], first[b]); };
    constexpr double kEasy = 0.98, kMost = 0.9995, kHeel = 0.95;
    const double whole = length(leg.hip, leg.knee) + length(leg.knee, leg.ankle);
    reach[side] = std::clamp(std::max(length(leg.hip, leg.ankle), glm::distance(last[leg.hip], last[leg.ankle])),
                             kEasy * whole, kMost * whole);
    const glm::dvec3 limb =
        glm::conjugate(first.turns[static_cast<std::size_t>(leg.ankle)]) * (first[leg.tip] - first[leg.ankle]);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const FootPose& foot = walks[side][f];
      drop[f] = std::max(drop[f], HipDrop(frames[f][leg.hip], foot.tip, reach[side] + kHeel * glm::length(limb)));
    }
  }
  // Lower the body and solve the legs.
  drop = SmoothlyAbove(drop);
  for (std::size_t f = 0; f < filled.size(); ++f) {
    filled[f].root.y -= drop[f + 1];
    for (std::size_t side = 0; side < 2; ++side) {
      SetLeg(gap.tree, (*feet)[side].leg, walks[side][f + 1], reach[side], filled[f]);
    }
  }
}

}  // namespace etude
