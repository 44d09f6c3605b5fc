#include "engine/motion/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "tests/engine/motion/standing_body.h"

namespace etude {
namespace {

using enum Role;
using Poses = std::vector<BodyPose>;

constexpr double kFrameRate_hz = 30;
constexpr int kFrames = 90, kPoint = 40, kEnd = 80;  // frames of every clip; a transition's first and last frame

JointSet Set(std::initializer_list<Role> roles) {
  JointSet joints;
  for (Role role : roles) joints.set(Index(role));
  return joints;
}

const JointSet kFeet = Set({kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot});

void Carry(BodyPose& pose, const glm::dvec3& by) {
  for (glm::dvec3& joint : pose.joints) joint += by;
}

/// Returns `pose` for kFrames frames, altered by `change(pose, frame)`.
template <typename Change>
Poses ClipOf(const BodyPose& pose, Change change, int frames = kFrames) {
  Poses poses(static_cast<std::size_t>(frames), pose);
  for (int f = 0; f < frames; ++f) change(poses[f], f);
  return poses;
}
Poses Still(const BodyPose& pose) {
  return ClipOf(pose, [](BodyPose&, int) {});
}

/// Draws both feet up by `up`; the hips stay.
void Tuck(BodyPose& pose, double up) {
  for (Role role : {kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot}) pose[role].y += up;
  for (Role role : {kLeftKnee, kRightKnee}) pose[role] += glm::dvec3(0, up / 2, up / 2);
}

/// Turns the body about the X axis through the origin, so that it comes to lie on its back or its hands.
BodyPose Tilted(BodyPose pose, double angle) {
  for (glm::dvec3& j : pose.joints) {
    j = {j.x, j.y * std::cos(angle) - j.z * std::sin(angle), j.y * std::sin(angle) + j.z * std::cos(angle)};
  }
  double lowest = pose.joints[0].y;
  for (const glm::dvec3& j : pose.joints) lowest = std::min(lowest, j.y);
  Carry(pose, {0, -lowest, 0});
  return pose;
}

/// Returns the longest run of unsupported frames of `shown`, which leaves one clip and enters the other at kPoint.
int Floating(const Poses& shown, const Poses& left, const Poses& wanted) {
  const std::vector clips = {SupportingClip{.poses = left, .begin = 0, .left_at = kPoint},
                             SupportingClip{.poses = wanted, .begin = kPoint}};
  int run = 0, longest = 0;
  for (const Support& support : FindSupport(shown, clips, kPoint, kEnd, kFrameRate_hz)) {
    run = support.Holds() ? 0 : run + 1;
    longest = std::max(longest, run);
  }
  return longest;
}
int Floating(const Poses& shown, const Poses& clip) { return Floating(shown, clip, clip); }

/// Rises smoothly from 0 before frame `begin` to 1 from `end` on.
double Ramp(int frame, int begin, int end) {
  return Smootherstep(std::clamp((frame - begin) / double(end - begin), 0., 1.));
}

TEST(FindFootContacts, SeesAStepOfOneFoot) {
  const Poses steps = ClipOf(
      Standing(), [](BodyPose& pose, int f) { pose[kLeftFoot].y = f >= 20 && f < 40 ? 0.2 : 0.0; }, 60);
  const FootContacts contacts = FindFootContacts(steps, kFrameRate_hz);
  for (int f = 0; f < 60; ++f) {
    EXPECT_EQ(contacts[0][f], f < 19 || f > 40) << f;  // frames 19 and 40 are moving
    EXPECT_TRUE(contacts[1][f]);
  }
}

TEST(FindFootContacts, LetsAFootStandOnItsHeel) {
  const Poses heel = ClipOf(
      Standing(),
      [](BodyPose& pose, int) {
        pose[kLeftFoot].y = 0.2;
        pose[kLeftAnkle].y = 0.05;
      },
      9);
  EXPECT_TRUE(FindFootContacts(heel, kFrameRate_hz)[0][4]);
}

TEST(MassCentre, IsWhereABodyIsThatIsOneEverywhere) {
  BodyPose point;
  Carry(point, {1, 2, 3});
  EXPECT_NEAR(glm::distance(MassCentre(point), glm::dvec3(1, 2, 3)), 0, 1e-12) << "the masses sum to one";
}

TEST(MassCentre, MovesByEachSegmentsShare) {
  BodyPose pose;
  pose[kHead].y = 1;
  EXPECT_NEAR(MassCentre(pose).y, 0.081, 1e-12);
  pose = {};
  pose[kLeftKnee].x = 1;  // moves the thigh's end and the shank's beginning
  EXPECT_NEAR(MassCentre(pose).x, 0.100 * 0.433 + 0.0465 * (1 - 0.433), 1e-12);
  pose = {};
  pose[kRightHand].z = 1;
  EXPECT_NEAR(MassCentre(pose).z, 0.006 * 0.506, 1e-12);
}

TEST(JointVelocities, AreCentralAndOneSidedAtTheEnds) {
  const Poses falls = ClipOf(
      Standing(),
      [](BodyPose& pose, int f) {
        Carry(pose, {0, -0.01 * f * f, 0});
      },
      4);
  const std::vector<BodyPose> velocities = JointVelocities(falls, kFrameRate_hz);
  EXPECT_NEAR(velocities[0][kHead].y, kFrameRate_hz * -0.01, 1e-12);
  EXPECT_NEAR(velocities[1][kHead].y, kFrameRate_hz * -0.02, 1e-12);
  EXPECT_NEAR(velocities[3][kHead].y, kFrameRate_hz * -0.05, 1e-12);
  EXPECT_EQ(JointVelocities(std::vector{Standing()}, kFrameRate_hz)[0][kHead], glm::dvec3(0));
}

TEST(FindBearing, TakesTheLowestJointsThatRest) {
  EXPECT_EQ(FindBearing(Still(Standing()), kFrameRate_hz)[10].rests, kFeet);
  BodyPose stork = Standing();
  stork[kLeftFoot].y = stork[kLeftAnkle].y = 0.5;  // at rest, but on nothing
  EXPECT_EQ(FindBearing(Still(stork), kFrameRate_hz)[10].rests, Set({kRightAnkle, kRightFoot}));
  const BodyPose lying = Tilted(Standing(), -kPi / 2);
  EXPECT_TRUE(FindBearing(Still(lying), kFrameRate_hz)[10].rests[Index(kHead)]);
  EXPECT_TRUE(FindBearing(Still(lying), kFrameRate_hz)[10].rests[Index(kHipCentre)]);
}

TEST(FindBearing, TrustsAClipThatWalksOnTheSpotButNotOneThatGlides) {
  const auto at = [](double hips, double feet) {
    const Poses poses = ClipOf(Standing(), [&](BodyPose& pose, int f) {
      Carry(pose, {0, 0, hips * f / kFrameRate_hz});
      for (Role role : {kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot})
        pose[role].z += (feet - hips) * f / kFrameRate_hz;
    });
    return FindBearing(poses, kFrameRate_hz)[10];
  };
  EXPECT_TRUE(at(0, -1.2).rests.none());
  EXPECT_EQ(at(0, -1.2).bears, kFeet) << "a treadmill";
  EXPECT_TRUE(at(1, 1).bears.none()) << "on ice";
  EXPECT_EQ(at(1, 0).bears, kFeet) << "a step: the body goes over its feet";
}

TEST(FindSupport, HoldsWhatGoesOnUnbroken) {
  const Poses still = Still(Standing());
  EXPECT_EQ(Floating(still, still), 0);
  const std::vector clips = {SupportingClip{.poses = still}};
  const std::vector<Support> support = FindSupport(still, clips, kPoint, kEnd, kFrameRate_hz);
  ASSERT_EQ(support.size(), static_cast<std::size_t>(kEnd - kPoint + 1));
  for (const Support& frame : support) EXPECT_EQ(frame.joints, kFeet);
  EXPECT_TRUE(std::ranges::none_of(support, [](const Support& frame) { return frame.flight; }));
}

TEST(FindSupport, HoldsBodiesThatLieKneelOrStandOnTheirHands) {
  BodyPose kneeling = Standing();
  for (Role role : {kLeftAnkle, kRightAnkle}) kneeling[role] = {kneeling[role].x, 0.45, -0.35};
  for (Role role : {kLeftFoot, kRightFoot}) kneeling[role] = {kneeling[role].x, 0.40, -0.45};
  Carry(kneeling, {0, -0.38, 0});
  BodyPose hands = Standing();
  for (Role role : {kLeftHand, kRightHand}) hands[role] = {hands[role].x, 1.9, 0};
  for (const BodyPose& pose : {kneeling, Tilted(Standing(), -kPi / 2), Tilted(hands, kPi)}) {
    const Poses clip = Still(pose);
    // The body sways, unlike the body in the clip, but the same joints bear it.
    const Poses sways = ClipOf(pose, [](BodyPose& p, int f) { Carry(p, {0.02 * std::sin(f / 5.0), 0, 0}); });
    EXPECT_EQ(Floating(sways, clip), 0);
    EXPECT_GE(Floating(ClipOf(pose, [](BodyPose& p, int f) { Carry(p, {0, f > kPoint ? 0.05 : 0.0, 0}); }), clip), 30);
  }
}

// The controls: each fault must be seen, in either direction.
TEST(FindSupport, SeesABodyThatIsLifted) {
  const Poses clip = Still(Standing());
  for (const double lift : {0.05, 0.08}) {
    const Poses lifted = ClipOf(Standing(), [&](BodyPose& pose, int f) {
      Carry(pose, {0, lift * Ramp(f, kPoint, kPoint + 8) * (1 - Ramp(f, kEnd - 8, kEnd)), 0});
    });
    EXPECT_GE(Floating(lifted, clip), 25) << lift;
  }
  EXPECT_EQ(Floating(ClipOf(Standing(),
                            [](BodyPose& pose, int) {
                              Carry(pose, {0, 0.02, 0});
                            }),
                     clip),
            0)
      << "within what takes and other bodies are off";
}

TEST(FindSupport, SeesABodyThatGlides) {
  const Poses glides = ClipOf(Standing(), [](BodyPose& pose, int f) {
    Carry(pose, {std::max(f - kPoint, 0) * 0.6 / kFrameRate_hz, 0, std::max(f - kPoint, 0) * 0.8 / kFrameRate_hz});
  });
  EXPECT_GE(Floating(glides, Still(Standing())), 30);
  EXPECT_GE(Floating(glides, glides), 30) << "nor is it its own support";
}

TEST(FindSupport, SeesABodyThatSquatsInMidAirAndFeetThatAreTuckedAtOnce) {
  const Poses clip = Still(Standing());
  EXPECT_GE(
      Floating(ClipOf(Standing(), [](BodyPose& pose, int f) { Tuck(pose, 0.3 * Ramp(f, kPoint, kPoint + 12)); }), clip),
      25);
  const Poses tucks = ClipOf(Standing(), [](BodyPose& pose, int f) {
    Tuck(pose, 0.25 * Ramp(f, kPoint, kPoint + 6) * (1 - Ramp(f, kPoint + 14, kPoint + 20)));
  });
  EXPECT_GE(Floating(tucks, clip), 10);
}

/// Crouches, then takes off at frame 45 with this speed, m/s.
void Push(BodyPose& pose, int f, double speed) {
  constexpr double kPush = 0.8 * 9.81;
  const double before = (45 - f) / kFrameRate_hz, takes = speed / kPush, depth = 0.5 * speed * takes;
  if (before <= 0) return;
  const double rises = std::max(takes - before, 0.0);
  const double drop = depth * Ramp(f, 10, 45 - static_cast<int>(takes * kFrameRate_hz)) - 0.5 * kPush * rises * rises;
  Tuck(pose, drop);
  Carry(pose, {0, -drop, 0});
}

TEST(FindSupport, LetsABodyJumpAsGravityDoesAndNotOtherwise) {
  // In the air from frame 45 to 60: half a second, 30 cm high.
  const auto jump = [](double gravity, bool is_thrown = true) {
    return ClipOf(Standing(), [=](BodyPose& pose, int f) {
      const double t = (f - 45) / kFrameRate_hz, whole = 15 / kFrameRate_hz;
      if (is_thrown) Push(pose, f, gravity / 2 * whole);
      if (t > 0 && t < whole) Carry(pose, {0, gravity / 2 * t * (whole - t), 0});
    });
  };
  const Poses clip = Still(Standing());
  EXPECT_EQ(Floating(jump(9.81), clip), 0);
  EXPECT_GE(Floating(jump(9.81, false), clip), 10) << "nothing throws it";
  EXPECT_GE(Floating(jump(4), clip), 10) << "as on Mars";
  EXPECT_GE(Floating(jump(20), clip), 10);
  const Poses hangs = ClipOf(Standing(), [](BodyPose& pose, int f) {
    Carry(pose, {0, 0.3 * Ramp(f, 43, 50) * (1 - Ramp(f, 60, 67)), 0});
  });
  EXPECT_GE(Floating(hangs, clip), 15);
}

TEST(FindSupport, TakesTheTopOfAJumpForNoFloor) {
  // At the top of the jump the feet are slow for three frames, 30 cm up. A body that stays there rests on nothing.
  constexpr int kTop = kPoint;
  const Poses jump = ClipOf(Standing(), [](BodyPose& pose, int f) {
    const double t = (f - kTop) / kFrameRate_hz, half = 7.5 / kFrameRate_hz;
    if (std::abs(t) < half) Carry(pose, {0, 9.81 / 2 * (half * half - t * t), 0});
  });
  for (int f = kTop - 1; f <= kTop + 1; ++f) EXPECT_TRUE(FindBearing(jump, kFrameRate_hz)[f].rests.none()) << f;
  EXPECT_EQ(FindBearing(jump, kFrameRate_hz)[kTop + 12].rests, kFeet);
  EXPECT_EQ(Floating(jump, jump), 0) << "the clip's own";
  const Poses stays = ClipOf(Standing(), [&](BodyPose& pose, int f) { pose = jump[std::min(f, kTop)]; });
  EXPECT_GE(Floating(stays, jump), 35);
  EXPECT_GE(Floating(stays, jump, Still(Standing())), 35);
}

TEST(FindSupport, GivesWhoWalksOnTheSpotAFloorToStopOn) {
  const Poses walks = ClipOf(Standing(), [](BodyPose& pose, int f) {
    for (Role role : {kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot}) pose[role].z -= 0.9 * f / kFrameRate_hz;
  });
  BodyPose high = Standing();
  Carry(high, {0, 0.3, 0});
  const auto stops = [&](double lift) {
    return ClipOf(Standing(), [&](BodyPose& pose, int f) {
      pose = walks[std::min(f, kPoint)];
      Carry(pose, {0, lift * Ramp(f, kPoint, kPoint + 8), 0});
    });
  };
  EXPECT_EQ(Floating(stops(0), walks, Still(high)), 0);
  EXPECT_GE(Floating(stops(0.05), walks, Still(high)), 30);
  // A body that floats at the transition point is not supported by floor on which it stood earlier.
  const Poses flies = ClipOf(Standing(), [&](BodyPose& pose, int f) {
    pose = walks[f];
    Carry(pose, {0, f < 20 ? 0.0 : 0.1, 0});
  });
  EXPECT_GE(Floating(ClipOf(Standing(), [&](BodyPose& pose, int f) { pose = flies[std::min(f, kPoint)]; }), flies,
                     Still(high)),
            30);
}

TEST(FindSupport, AsksOfAFlightThatItIsOneParabolaWithATakeOff) {
  const Poses clip = Still(Standing());
  const auto flies = [](double wobble) {
    return ClipOf(Standing(), [=](BodyPose& pose, int f) {
      const double t = (f - 45) / kFrameRate_hz, whole = 15 / kFrameRate_hz;
      Push(pose, f, 9.81 / 2 * whole);
      if (t > 0 && t < whole) Carry(pose, {0, 9.81 / 2 * t * (whole - t) + wobble * std::sin(4 * kPi * t / whole), 0});
    });
  };
  EXPECT_EQ(Floating(flies(0.003), clip), 0);
  EXPECT_GE(Floating(flies(0.03), clip), 10) << "it swims in the air";
  const Poses dropped = ClipOf(Standing(), [](BodyPose& pose, int f) {
    const double t = std::max(f - kPoint, 0) / kFrameRate_hz;  // time constant: a third of a second
    Carry(pose, {0, std::max(9.81 / 18 - 9.81 / 2 * t * t, 0.0), 0});
  });
  EXPECT_GE(Floating(dropped, clip), 9) << "from where nothing held it";
}

TEST(FindSupport, IsNotFoundInAFootThatSwingsWhileTheOtherShouldBear) {
  const auto swings = [](double right_foot) {
    return ClipOf(Standing(), [=](BodyPose& pose, int f) {
      const double z = 0.4 * std::sin(f / 5.0);  // up to 2.4 m/s near the floor
      for (Role role : {kLeftAnkle, kLeftFoot}) pose[role] += glm::dvec3(0, 0.02, z);
      for (Role role : {kRightAnkle, kRightFoot}) pose[role].y += f > kPoint ? right_foot : 0;
    });
  };
  EXPECT_EQ(Floating(swings(0), swings(0)), 0);
  EXPECT_GE(Floating(swings(0.08), swings(0)), 8);
}

TEST(FindSupport, LetsABodyFollowAClipThatFliesAsNoBodyCan) {
  const Poses cartoon = ClipOf(Standing(), [](BodyPose& pose, int f) {
    Carry(pose, {0, 0.8 * std::pow(std::sin(kPi * std::clamp((f - 10) / 40.0, 0., 1.)), 2), 0});
  });
  Poses shown = Still(Standing());
  for (int f = kPoint; f < kFrames; ++f) shown[f] = cartoon[f - kPoint];
  EXPECT_EQ(Floating(shown, Still(Standing()), cartoon), 0);
  for (int f = kPoint; f < kFrames; ++f) Carry(shown[f], {0, 0.08, 0});
  EXPECT_GE(Floating(shown, Still(Standing()), cartoon), 8);
}

TEST(FindSupport, NeedsNoLevelFloorAndNoToesAtZero) {
  // It walks up a slope of one in five; the toes are 9 cm above the file's floor.
  const Poses climbs = ClipOf(Standing(), [](BodyPose& pose, int f) {
    constexpr int kStep = 15;
    const auto along = [](double step) { return 0.5 * step; };
    const double phase = f / double(kStep);
    for (const auto& [ankle, foot, knee, side] :
         {std::tuple{kLeftAnkle, kLeftFoot, kLeftKnee, 0}, std::tuple{kRightAnkle, kRightFoot, kRightKnee, 1}}) {
      const double step = std::floor((phase + side) / 2), part = std::min((phase + side) - 2 * step, 1.0);
      const double z = along(2 * (step + Smootherstep(part)) - side);
      const double lift = 0.15 * std::sin(kPi * part);
      for (Role role : {ankle, foot}) pose[role] += glm::dvec3(0, 0.09 + 0.2 * z + lift, z);
      pose[knee] += glm::dvec3(0, 0.09 + 0.2 * z, z);
    }
    for (Role role : AllRoles()) {
      if (pose[role].y > 0.85) pose[role] += glm::dvec3(0, 0.09 + 0.2 * along(phase), along(phase));
    }
  });
  EXPECT_EQ(Floating(climbs, climbs), 0);
  Poses lifted = climbs;
  for (int f = kPoint; f < kFrames; ++f) Carry(lifted[f], {0, 0.08, 0});
  EXPECT_GE(Floating(lifted, climbs), 4);
}

TEST(FindSupport, TellsAStepFromToesThatAreRaised) {
  // The toes are raised while the heel bears, so the toes rest on nothing.
  const Poses taps = ClipOf(Standing(), [](BodyPose& pose, int f) {
    for (Role role : {kLeftFoot, kRightFoot}) pose[role].y += f % 20 < 10 ? 0.06 : 0;
  });
  const Poses stands_on_air = ClipOf(Standing(), [](BodyPose& pose, int) { Carry(pose, {0, 0.06, 0}); });
  EXPECT_GE(Floating(stands_on_air, taps), 10);
  // A box of 30 cm is a surface of its own.
  const Poses box = ClipOf(Standing(), [](BodyPose& pose, int f) { Carry(pose, {0, f < 20 ? 0.0 : 0.3, 0}); });
  EXPECT_EQ(Floating(ClipOf(Standing(), [](BodyPose& pose, int) { Carry(pose, {0, 0.3, 0}); }), box), 0);
}

TEST(BalanceOffset, IsTheDistanceFromTheHullOfWhatBears) {
  EXPECT_FALSE(BalanceOffset(Standing(), {}));
  const auto with = [](const BodyPose& pose, std::initializer_list<Role> roles) {
    return *BalanceOffset(pose, Set(roles));
  };
  BodyPose spine;                 // the centre of mass stays at the origin
  spine[kSpine] = {0.3, 0, 0.4};  // no segment ends at this joint
  EXPECT_NEAR(with(spine, {kSpine}), 0.5, 1e-12);
  EXPECT_NEAR(with(spine, {kSpine, kHead}), 0, 1e-12) << "a corner of the hull";
  BodyPose standing = Standing();
  EXPECT_NEAR(with(standing, {kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot}), 0, 1e-12);
  EXPECT_NEAR(with(standing, {kLeftAnkle, kLeftFoot}), 0.1, 1e-12) << "beside one foot";
  Carry(standing, {0, 0, 0.5});
  standing[kLeftAnkle] = standing[kRightAnkle] = {0, 0, 0};
  standing[kLeftFoot] = standing[kRightFoot] = {0, 0, 0.1};
  EXPECT_NEAR(with(standing, {kLeftAnkle, kLeftFoot}), MassCentre(standing).z - 0.1, 1e-12);
}

}  // namespace
}  // namespace etude
