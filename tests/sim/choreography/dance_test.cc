// Properties without which no body could perform a move, measured on every built-in move at 120 Hz.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/start_angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/move.h"
#include "tests/sim/choreography/balance.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;

constexpr double kRateHz = 120;

using Change = std::function<void(Controls&)>;
void Unchanged(Controls&) {}

/// Returns one loop and the next frame; `change` is applied to every pose before joints are computed.
BodyMotion Danced(const Move& move, const Change& change = Unchanged) {
  const double seconds_per_beat = 60 / move.tempo_bpm;
  const auto frames = static_cast<int>(std::lround(move.beats * seconds_per_beat * kRateHz));
  BodyMotion motion{.rate_hz = kRateHz, .poses = {}};
  for (int i = 0; i <= frames; ++i) {
    Controls controls = move.curves.At(i / kRateHz / seconds_per_beat);
    change(controls);
    motion.poses.push_back(PoseOf(controls));
  }
  return motion;
}

Move LoadMove(const std::string& name) {
  auto move = LoadBuiltinMove(name);
  EXPECT_TRUE(move) << ToString(move.error());
  return std::move(*move);
}

const std::map<std::string, BodyMotion>& AllDances() {
  static const std::map<std::string, BodyMotion> dances = [] {
    std::map<std::string, BodyMotion> danced;
    for (const std::string& name : BuiltinMoveNames()) danced[name] = Danced(LoadMove(name));
    return danced;
  }();
  return dances;
}

/// The largest value of a measure and the number of values, so that a check of nothing fails.
struct Worst {
  double value = 0;
  int count = 0;

  void Add(double measured) {
    value = std::max(value, measured);
    ++count;
  }
};

/// Returns the highest horizontal speed (m/s) of toes that touch the floor and of ankles of flat feet, and the number
/// of such speeds.
Worst FootSpeed(const BodyMotion& motion) {
  struct Point {
    Role role;
    double rest, slack;
  };
  // A rising heel moves the ankle forward by a quarter of the rise, so a foot counts as flat only within a tiny rise.
  const Point points[] = {{kLeftFoot, CanonicalBody::kToeHeight, 1e-4},
                          {kRightFoot, CanonicalBody::kToeHeight, 1e-4},
                          {kLeftAnkle, CanonicalBody::kAnkleHeight, 1e-5},
                          {kRightAnkle, CanonicalBody::kAnkleHeight, 1e-5}};
  Worst worst;
  for (std::size_t i = 0; i + 1 < motion.poses.size(); ++i) {
    for (const Point& point : points) {
      const glm::dvec3 &here = motion.poses[i][point.role], &there = motion.poses[i + 1][point.role];
      if (std::max(here.y, there.y) > point.rest + point.slack) continue;
      worst.Add(std::hypot(there.x - here.x, there.z - here.z) * motion.rate_hz);
    }
  }
  return worst;
}

constexpr double kSliding = 0.001;  // m/s

TEST(Dance, PlantedFeetDoNotSlide) {
  for (const auto& [name, motion] : AllDances()) {
    const Worst speed = FootSpeed(motion);
    EXPECT_LE(speed.value, kSliding) << name;
    EXPECT_GT(speed.count, static_cast<int>(motion.poses.size()) / 2) << name;
  }
  BodyMotion drifting = AllDances().at("clap");
  for (std::size_t i = 0; i < drifting.poses.size(); ++i) {
    drifting.poses[i] = FloorMove{.x = 5e-5 * static_cast<double>(i)}.Apply(drifting.poses[i]);
  }
  EXPECT_GT(FootSpeed(drifting).value, kSliding);
}

/// The distances (m) of the centre of mass outside the support, on one foot and on both.
struct Imbalance {
  Worst one_foot, two_feet;
};

Imbalance ImbalanceOf(const BodyMotion& motion) {
  Imbalance found;
  for (const BodyPose& pose : motion.poses) {
    std::vector<glm::dvec2> left = Sole(pose, Side::kLeft);
    const std::vector<glm::dvec2> right = Sole(pose, Side::kRight);
    if (left.empty() && right.empty()) continue;
    Worst& worst = left.empty() || right.empty() ? found.one_foot : found.two_feet;
    left.insert(left.end(), right.begin(), right.end());
    const glm::dvec3 centre = CentreOfMass(pose);
    worst.Add(DistanceOutside({centre.x, centre.z}, left));
  }
  return found;
}

TEST(Dance, TheWeightIsOverTheStandingFoot) {
  // Dancers fall slightly into their steps, but hold poses above the foot.
  constexpr double kOffTheFoot = 0.06, kOffTheFeet = 0.015;
  for (const auto& [name, motion] : AllDances()) {
    const Imbalance imbalance = ImbalanceOf(motion);
    EXPECT_LT(imbalance.one_foot.value, kOffTheFoot) << name;
    EXPECT_LT(imbalance.two_feet.value, kOffTheFeet) << name;
    EXPECT_GT(imbalance.one_foot.count + imbalance.two_feet.count, static_cast<int>(motion.poses.size()) / 2) << name;
  }
  EXPECT_GT(ImbalanceOf(AllDances().at("side_kick")).one_foot.count, 100);

  const Change hips_stay = [](Controls& controls) { controls[MiddleControl::kHipsSide] = 0; };
  EXPECT_GT(ImbalanceOf(Danced(LoadMove("side_kick"), hips_stay)).one_foot.value, kOffTheFoot);
  const Change leans = [](Controls& controls) { controls[MiddleControl::kHipsAhead] -= 0.15; };
  EXPECT_GT(ImbalanceOf(Danced(LoadMove("bird"), leans)).two_feet.value, kOffTheFeet);
}

/// The best-fitting free fall of the centre of mass while both feet are in the air.
struct Flight {
  int frames = 0;
  double gravity = 0;  // m/s²
  double misfit = 0;   // largest deviation, metres
};

constexpr double kGravity = 9.80665, kFlightTolerance = 0.04 * kGravity;

Flight FlightOf(const BodyMotion& motion, double rate_hz = kRateHz) {
  std::vector<double> heights;
  for (const BodyPose& pose : motion.poses) {
    if (Sole(pose, Side::kLeft).empty() && Sole(pose, Side::kRight).empty()) heights.push_back(CentreOfMass(pose).y);
  }
  Flight flight{.frames = static_cast<int>(heights.size())};
  if (flight.frames < 5) return flight;
  // Least squares with times symmetric about 0: a + b·t + c·t².
  const double half = 0.5 * (flight.frames - 1) / rate_hz;
  double n = 0, t2 = 0, t4 = 0, y0 = 0, y1 = 0, y2 = 0;
  const auto time = [&](int i) { return i / rate_hz - half; };
  for (int i = 0; i < flight.frames; ++i) {
    const double t = time(i), y = heights[static_cast<std::size_t>(i)];
    n += 1, t2 += t * t, t4 += t * t * t * t, y0 += y, y1 += t * y, y2 += t * t * y;
  }
  const double c = (n * y2 - t2 * y0) / (n * t4 - t2 * t2), b = y1 / t2, a = (y0 - c * t2) / n;
  flight.gravity = -2 * c;
  for (int i = 0; i < flight.frames; ++i) {
    const double t = time(i);
    flight.misfit = std::max(flight.misfit, std::abs(heights[static_cast<std::size_t>(i)] - (a + b * t + c * t * t)));
  }
  return flight;
}

TEST(Dance, AJumpFliesAsGravityWillHaveIt) {
  for (const auto& [name, motion] : AllDances()) {
    const Flight flight = FlightOf(motion);
    if (name != "jump") {
      EXPECT_EQ(flight.frames, 0) << name;
      continue;
    }
    EXPECT_NEAR(flight.frames / kRateHz, 2 * std::sqrt(2 * 0.22 / kGravity), 0.02);
    EXPECT_NEAR(flight.gravity, kGravity, kFlightTolerance);
    EXPECT_LT(flight.misfit, 0.005);
  }
  EXPECT_GT(std::abs(FlightOf(AllDances().at("jump"), 0.9 * kRateHz).gravity - kGravity), kFlightTolerance)
      << "danced a tenth slower, the jump would float";
}

LimbLengths CanonicalLengths() {
  const BodyPose rest = StandingPose();
  const auto length = [&](Role from, Role to) { return glm::distance(rest[from], rest[to]); };
  return {.foot = length(kLeftAnkle, kLeftFoot),
          .shank = CanonicalBody::kShank,
          .thigh = CanonicalBody::kThigh,
          .hip_width = 2 * CanonicalBody::kHipHalfWidth,
          .trunk = length(kHipCentre, kShoulderCentre),
          .neck = length(kShoulderCentre, kHead),
          .shoulder_width = 2 * CanonicalBody::kShoulderHalfWidth,
          .upper_arm = CanonicalBody::kUpperArm,
          .forearm = CanonicalBody::kForearm,
          .hand = CanonicalBody::kHand};
}

/// Returns the excess (rad) of joint angles over an adult's limits.
Worst BeyondLimits(const BodyMotion& motion) {
  const KinematicTree body = MakeBodyTree(CanonicalLengths());
  const std::vector<AngleRange> any(body.limits.size(), {-kPi, kPi});
  Worst worst;
  for (const BodyPose& pose : motion.poses) {
    const auto state = FindStartState(body, pose, any);
    if (!state) continue;
    for (std::size_t i = 0; i < any.size(); ++i) {
      worst.Add(std::max(body.limits[i].lower - state->angles[i], state->angles[i] - body.limits[i].upper));
    }
  }
  return worst;
}

TEST(Dance, NoJointGoesBeyondAnAdultsLimits) {
  constexpr double kBeyond = Radians(1);
  for (const auto& [name, motion] : AllDances()) {
    const Worst beyond = BeyondLimits(motion);
    EXPECT_LT(beyond.value, kBeyond) << name;
    EXPECT_EQ(beyond.count, static_cast<int>(motion.poses.size()) * MakeBodyTree({}).dof_count()) << name;
  }
  const Change wrung = [](Controls& controls) { controls.Of(Side::kLeft, SideControl::kArmTwist) -= Radians(40); };
  EXPECT_GT(BeyondLimits(Danced(LoadMove("robot"), wrung)).value, kBeyond);
}

double TopSpeed(const BodyMotion& motion, Role role) {
  double top = 0;
  for (std::size_t i = 0; i + 1 < motion.poses.size(); ++i) {
    top = std::max(top, glm::distance(motion.poses[i][role], motion.poses[i + 1][role]) * motion.rate_hz);
  }
  return top;
}

TEST(Dance, SpeedsAreADancers) {
  for (const auto& [name, motion] : AllDances()) {
    for (Role hand : {kLeftHand, kRightHand}) EXPECT_LT(TopSpeed(motion, hand), name == "jump" ? 8 : 7) << name;
    for (Role foot : {kLeftFoot, kRightFoot}) EXPECT_LT(TopSpeed(motion, foot), 4.5) << name;
    EXPECT_LT(TopSpeed(motion, kHead), 2.5) << name;
  }
  const BodyMotion& boxing = AllDances().at("boxing");
  EXPECT_LT(TopSpeed(boxing, kLeftHand), 6);
  EXPECT_GT(TopSpeed(boxing, kLeftHand), 3) << "a punch is no push";
}

TEST(Dance, StaysADancersAtEveryTempoOfTheMovesRange) {
  for (const std::string& name : BuiltinMoveNames()) {
    const Move move = LoadMove(name);
    for (double tempo_bpm : {move.slowest_bpm, move.fastest_bpm}) {
      ASSERT_OK(other, AtTempo(move, tempo_bpm, {}));
      const BodyMotion motion = Danced(*other);
      for (Role hand : {kLeftHand, kRightHand}) EXPECT_LT(TopSpeed(motion, hand), 8) << name << " at " << tempo_bpm;
      EXPECT_LE(FootSpeed(motion).value, kSliding) << name << " at " << tempo_bpm;
      const Flight flight = FlightOf(motion);
      EXPECT_EQ(flight.frames > 0, name == "jump") << name;
      if (flight.frames > 0) {
        EXPECT_NEAR(flight.gravity, kGravity, kFlightTolerance) << tempo_bpm;
      }
    }
  }
}

/// Returns the largest second difference of a joint, m/s².
double TopAcceleration(const std::vector<BodyPose>& poses, double rate_hz) {
  double top = 0;
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    for (Role role : AllRoles()) {
      const glm::dvec3 bend = poses[i + 1][role] - 2.0 * poses[i][role] + poses[i - 1][role];
      top = std::max(top, glm::length(bend) * rate_hz * rate_hz);
    }
  }
  return top;
}

TEST(Dance, NothingJerks) {
  constexpr double kJerky = 110;  // m/s²: a clapping hand stops from 6 m/s within 0.06 s
  for (const std::string& name : BuiltinMoveNames()) {
    std::vector<BodyPose> poses = LoadMove(name).motion.poses;
    EXPECT_LT(TopAcceleration(poses, kJudgedRateHz), kJerky) << name;
    if (name != "clap") continue;
    poses.erase(poses.begin() + 14);
    EXPECT_GT(TopAcceleration(poses, kJudgedRateHz), kJerky) << "a frame is missing in mid-swing";
  }
}

double LowestJoint(const BodyMotion& motion) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) lowest = std::min(lowest, joint.y);
  }
  return lowest;
}

TEST(Dance, NoJointIsBelowTheFloor) {
  for (const auto& [name, motion] : AllDances()) {
    EXPECT_NEAR(LowestJoint(motion), CanonicalBody::kToeHeight, 1e-6)
        << name << ": toes are the lowest, and on the floor";
  }
  const Change deeper = [](Controls& controls) { controls[MiddleControl::kHipsDrop] += 0.3; };
  EXPECT_LT(LowestJoint(Danced(LoadMove("stretch"), deeper)), CanonicalBody::kToeHeight)
      << "hands go through the floor";
}

}  // namespace
}  // namespace etude
