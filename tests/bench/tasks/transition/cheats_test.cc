// Transitions that no body can make. The joints follow quintics to the wanted pose, changed by a cheat. For each
// request up to 48 candidates (8 pairs of frames, 6 lengths) are judged; the metric may credit a candidate in at most
// 10 % of the requests. `ETUDE_CHEAT_CLIPS` replaces the built-in moves by another library, one pattern per line
// (`scripts/soak cheats`).

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/run.h"
#include "bench/tasks/transition/stage.h"
#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/choices/choice.h"
#include "tests/bench/tasks/transition/transition_fixture.h"

namespace etude {
namespace {

constexpr int kCheatRequests = 40;

/// Returns the quintic from position, velocity and acceleration at s = 0 to those at s = 1.
glm::dvec3 Quintic(const std::array<glm::dvec3, 3>& from, const std::array<glm::dvec3, 3>& to, double s) {
  const auto& [p0, v0, a0] = from;
  const auto& [p1, v1, a1] = to;
  const glm::dvec3 p = p1 - p0 - v0 - 0.5 * a0, v = v1 - v0 - a0, a = a1 - a0;
  const glm::dvec3 c3 = 10.0 * p - 4.0 * v + 0.5 * a, c4 = -15.0 * p + 7.0 * v - a, c5 = 6.0 * p - 3.0 * v + 0.5 * a;
  return p0 + s * (v0 + s * (0.5 * a0 + s * (c3 + s * (c4 + s * c5))));
}

/// Returns 0 at both ends of a join, and 1 from 1/n to 1 − 1/n of it.
double Plateau(double s, double n) { return Smootherstep(n * s) - Smootherstep(n * s - (n - 1)); }

/// Changes the pose of one frame as a cheat does. `s` is 0 where the join begins, 1 where it ends, and larger in the
/// frames after it; `seconds` is the length of the join.
using Cheat = std::function<void(BodyPose&, double s, double seconds)>;

void Lift(BodyPose& pose, double height) {
  for (glm::dvec3& joint : pose.joints) joint.y += height;
}

/// No foot steps; both feet are above the height at which sliding counts.
void Glide(BodyPose& pose, double s, double) { Lift(pose, 0.024 * Plateau(s, 5)); }
void Sink(BodyPose& pose, double s, double) { Lift(pose, -0.08 * Plateau(s, 3)); }

/// The body follows a ballistic flight without a take-off.
void Hop(BodyPose& pose, double s, double seconds) { Lift(pose, 0.5 * 9.81 * seconds * seconds * s * (1 - s)); }

void BendKnees(BodyPose& pose, double s, double) {
  using enum Role;
  for (const auto& [hip, knee, ankle] :
       {std::tuple{kLeftHip, kLeftKnee, kLeftAnkle}, {kRightHip, kRightKnee, kRightAnkle}}) {
    const glm::dvec3 leg = pose[ankle] - pose[hip];
    const glm::dvec3 on_line = pose[hip] + leg * (glm::dot(pose[knee] - pose[hip], leg) / glm::dot(leg, leg));
    // A straight leg gets bent, too.
    glm::dvec3 bend = pose[knee] - on_line;
    const glm::dvec3 front = glm::normalize(glm::cross(pose[kLeftHip] - pose[kRightHip], {0, 1, 0}));
    if (glm::length(bend) < 0.1) bend = 0.1 * front;
    pose[knee] = glm::mix(pose[knee], on_line - bend, Plateau(s, 2.5));
  }
}

/// True if both feet of the two clips are at least 5 cm apart at the join's ends, and no frame of the join is a leap:
/// the body must step or glide.
bool MustStep(const TransitionOutcome& outcome, std::span<const BodyPose> old, int frames) {
  constexpr double kApart = 0.05;
  const int leave = outcome.record.segments.front().last;
  const auto is_apart = [&](int k, Role role) {
    const BodyPose &left = old[std::min<std::size_t>(leave + k, old.size() - 1)],
                   &wanted = outcome.splice.wanted[std::min<std::size_t>(k, outcome.splice.wanted.size() - 1)];
    return std::hypot(left[role].x - wanted[role].x, left[role].z - wanted[role].z) > kApart;
  };
  constexpr double kLeap = 0.06;
  const int point = outcome.splice.points.front().frame;
  for (int k = 0; k <= frames; ++k) {
    const BodyPose& pose =
        outcome.splice.motion.poses[std::min<std::size_t>(point + k, outcome.splice.motion.poses.size() - 1)];
    if (std::ranges::min(pose.joints, {}, &glm::dvec3::y).y > kLeap) return false;
  }
  return std::ranges::all_of(std::array{Role::kLeftAnkle, Role::kLeftFoot, Role::kRightAnkle, Role::kRightFoot},
                             [&](Role role) { return is_apart(0, role) && is_apart(frames, role); });
}

class Cheats : public TransitionFixture {
 protected:
  static const Stage& TheStage() {
    static const Stage kStage = [] {
      const char* patterns = std::getenv("ETUDE_CHEAT_CLIPS");
      if (patterns == nullptr) return SetStage(EveryMove());
      std::vector<std::string> references;
      std::istringstream lines(patterns);
      for (std::string line; std::getline(lines, line);) references.push_back(line);
      auto clips = LoadClips(references, {});
      EXPECT_TRUE(clips) << ToString(clips.error());
      return SetStage(*clips);
    }();
    return kStage;
  }

  /// A candidate pair of frames, ranked by the difference of poses and velocities.
  struct Pair {
    int leave = 0, enter = 0;
    double cost = 0;
  };

  static std::vector<Pair> Pairs(const TransitionRequest& request) {
    constexpr int kMaxWait = 15, kMaxEnter = 45, kEvery = 3;
    constexpr std::size_t kMost = 8;
    const std::vector<BodyPose>&old = TheStage().library.motions[request.from].poses,
          &next = TheStage().library.motions[request.to].poses;
    const auto tenth = [](const std::vector<BodyPose>& poses, int f) {
      return poses[std::min<std::size_t>(f + 3, poses.size() - 1)];
    };
    std::vector<Pair> pairs;
    const int last = std::min(static_cast<int>(old.size()) - 3, request.request_frame + kMaxWait);
    const int first = std::max(request.request_frame, 2);
    for (int leave = first; leave <= last; leave += kEvery) {
      for (int enter = 1; enter <= std::min(kMaxEnter, static_cast<int>(next.size()) / 3); enter += kEvery) {
        pairs.push_back(
            {leave, enter, PoseGap(old[leave], next[enter]) + PoseGap(tenth(old, leave), tenth(next, enter))});
      }
    }
    std::ranges::stable_sort(pairs, {}, &Pair::cost);
    if (pairs.size() > kMost) pairs.resize(kMost);
    return pairs;
  }

  static TransitionOutcome Joined(const TransitionRequest& request, const Pair& pair, int frames, double turn,
                                  const Cheat& cheat) {
    TransitionOutcome outcome{.request = request,
                              .matched = false,
                              .rules = {},
                              .record = FindChoice("now")->plan(TheStage().library, request, {}, {}),
                              .splice = {}};
    outcome.record.segments.front().last = pair.leave;
    outcome.record.segments.back().first = pair.enter;
    outcome.splice = SpliceSegments(TheStage().library.motions, outcome.record.segments, *FindJoin("cut"));
    const std::vector<BodyPose>& old = TheStage().library.motions[request.from].poses;
    std::vector<BodyPose>&poses = outcome.splice.motion.poses, &wanted = outcome.splice.wanted;
    const int point = outcome.splice.points.front().frame;
    const auto state = [&](const std::vector<BodyPose>& all, int f, std::size_t j) {
      const int middle = std::clamp(f, 1, static_cast<int>(all.size()) - 2);
      const auto at = [&](int k) { return all[k].joints[j]; };
      const double n = frames;
      return std::array{all[f].joints[j], 0.5 * n * (at(middle + 1) - at(middle - 1)),
                        n * n * (at(middle + 1) - 2.0 * at(middle) + at(middle - 1))};
    };
    const int end = std::min<int>(frames, static_cast<int>(wanted.size()) - 1);
    for (int k = 1; k <= end; ++k) {
      for (std::size_t j = 0; j < kRoleCount; ++j) {
        poses[point + k].joints[j] =
            Quintic(state(old, pair.leave, j), state(wanted, end, j), k / static_cast<double>(end));
      }
      if (cheat) cheat(poses[point + k], k / static_cast<double>(end), end / kJudgedRateHz);
    }
    if (turn == 0) return outcome;
    // Turns a pose gradually about the vertical line through the hips of the frame left.
    const auto turned = [&, hips = poses[point][Role::kHipCentre]](BodyPose pose, double share) {
      const FloorMove about{.yaw = turn * Smootherstep(share)};
      for (glm::dvec3& joint : pose.joints) {
        const glm::dvec3 arm = about.Apply(glm::dvec3(joint.x - hips.x, joint.y, joint.z - hips.z));
        joint = {arm.x + hips.x, arm.y, arm.z + hips.z};
      }
      return pose;
    };
    for (int f = point + 1; f < static_cast<int>(poses.size()); ++f) {
      poses[f] = turned(poses[f], std::min((f - point) / static_cast<double>(end), 1.0));
    }
    for (BodyPose& pose : wanted) pose = turned(pose, 1);
    return outcome;
  }

  static constexpr std::array kRules = {"clean_share_v3", "clean_share"};

  /// Returns the shares of requests for which some candidate scores 1, by version 3 and by the current version.
  static std::array<double, 2> Credited(const char* name, double turn, const Cheat& cheat, bool must_step = false) {
    std::array<int, 2> credited{};
    int count = 0;
    for (int trial = 0; trial < kCheatRequests; ++trial) {
      const auto request = DrawRequest(TheStage(), Trial(trial));
      if (!request) continue;
      ++count;
      std::array<bool, 2> is_credited{};
      const std::vector<Pair> pairs = Pairs(*request);
      for (const int frames : {7, 12, 18, 24, 32, 38}) {
        for (const Pair& pair : pairs) {
          if (is_credited[1]) break;
          const TransitionOutcome outcome = Joined(*request, pair, frames, turn, cheat);
          if (must_step && !MustStep(outcome, TheStage().library.motions[request->from].poses, frames)) continue;
          CellResult result = CellResult::Ended(Status::kOk, "");
          ScoreTransition(outcome, TheStage(), result);
          for (std::size_t i = 0; i < 2; ++i) is_credited[i] = is_credited[i] || ValueOf(result, kRules[i]) > 0;
        }
      }
      for (std::size_t i = 0; i < 2; ++i) credited[i] += is_credited[i] ? 1 : 0;
    }
    EXPECT_GT(count, kCheatRequests / 3);
    const std::array shares = {credited[0] / static_cast<double>(count), credited[1] / static_cast<double>(count)};
    if (std::getenv("ETUDE_CHEAT_CLIPS"))
      fmt::print("{:<24} of {:>3}: version 3 {:.2f}, now {:.2f}\n", name, count, shares[0], shares[1]);
    return shares;
  }
};

TEST_F(Cheats, HEAVY_AGlideBelowTheHeightAtWhichSlidingCountsIsNotClean) {
  const auto [before, now] = Credited("glide", 0, Glide, true);
  EXPECT_GE(before, 0.4) << "what it fools";
  EXPECT_LE(now, 0.1);
}

TEST_F(Cheats, ABodyThatTurnsOnItsFeetIsNotClean) {
  const auto [before, now] = Credited("glide, turned 120°", Radians(120), Glide);
  EXPECT_GE(before, 0.4) << "what it fools";
  EXPECT_LE(now, 0.1);
}

TEST_F(Cheats, HEAVY_KneesTurnedBackwardsAreNotClean) {
  const auto [before, now] = Credited("knees backwards", 0, BendKnees);
  EXPECT_GE(before, 0.2) << "what it fools";
  EXPECT_LE(now, 0.1);
}

TEST_F(Cheats, HEAVY_ABodyInTheFloorIsNotClean) {
  const auto [before, now] = Credited("8 cm in the floor", 0, Sink);
  EXPECT_GE(before, 0.2) << "what it fools";
  EXPECT_LE(now, 0.1);
}

TEST_F(Cheats, HEAVY_AHopThatNothingThrowsIsNotClean) {
  const auto [before, now] = Credited("hop, turned 120°", Radians(120), Hop);
  EXPECT_LE(now, 0.1) << "version 3: " << before;
}

}  // namespace
}  // namespace etude
