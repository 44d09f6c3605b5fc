#include "engine/motion/motion_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "tests/engine/motion/moving_body.h"

namespace etude {
namespace {

using enum Role;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

void MoveAll(BodyPose& pose, const glm::dvec3& by) {
  for (glm::dvec3& joint : pose.joints) joint += by;
}

BodyMotion Lifted(BodyMotion motion, double from, double to, double height) {
  return WithChange(std::move(motion), from, to, [&](BodyPose& pose, double) { MoveAll(pose, {0, height, 0}); });
}

TEST(MotionFaults, AreNoneOfPeopleWhoSwayOrHopAtAnyRate) {
  for (const double rate : {24, 30, 60, 120}) {
    for (const BodyMotion& motion : {Swaying(rate), Hopping(rate)}) {
      const MotionFaults found = FindMotionFaults(motion);
      EXPECT_THAT(FaultSentences(found.faults), IsEmpty()) << rate;
      EXPECT_EQ(found.floor_m, 0);
      EXPECT_FALSE(found.is_floor_found);
    }
  }
}

TEST(FaultRules, StateEveryKindWithItsThresholds) {
  const std::vector<FaultRule>& rules = FaultRules();
  ASSERT_EQ(rules.size(), static_cast<std::size_t>(FaultKind::kSpeed) + 1);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    EXPECT_EQ(FaultName(static_cast<FaultKind>(i)), rules[i].name);
    EXPECT_THAT(rules[i].rule, ContainsRegex("[0-9]")) << rules[i].name;
  }
  EXPECT_EQ(rules.back().name, "speed");
  EXPECT_THAT(rules[static_cast<std::size_t>(FaultKind::kBends)].rule, HasSubstr("25° for 0.1 s"));
  EXPECT_THAT(rules[static_cast<std::size_t>(FaultKind::kSkates)].rule, HasSubstr("faster than 14 cm/s, for 0.4 s"));
}

TEST(MotionFaults, AreNotSoughtInLessThanEightFrames) {
  BodyMotion motion = Swaying(30, 0.2);
  MoveAll(motion.poses[3], {9, 9, 9});
  EXPECT_THAT(FindMotionFaults(motion).faults, IsEmpty());
  EXPECT_THAT(FindMotionFaults({.rate_hz = 30, .poses = {}}).faults, IsEmpty());
}

TEST(MotionFaults, OfABodyThatSinksHaveItsDepthAndTime) {
  for (const double rate : {30, 120}) {
    for (const BodyMotion& motion : {Swaying(rate), Hopping(rate)}) {
      for (const double seconds : {0.4, 2.0 / 3}) {
        const MotionFault sinks = OneFault(Lifted(motion, 2, 2 + seconds, -0.12), FaultKind::kSinks);
        ExpectTime(sinks, 2, 2 + seconds);
        EXPECT_NEAR(sinks.size, 0.12, 0.01);
      }
      const MotionFault half = OneFault(Lifted(motion, 3, 9, -0.08), FaultKind::kSinks);
      ExpectTime(half, 3, 6);
      EXPECT_NEAR(half.size, 0.08, 0.01);
    }
  }
}

TEST(MotionFaults, OfStepsThatSinkBackAreNoLevels) {
  // The body rises by 4 cm at once and sinks back within half a second, again and again.
  BodyMotion saw = Swaying(30);
  for (std::size_t f = 0; f < saw.poses.size(); ++f) {
    MoveAll(saw.poses[f], {0, 0.04 * (1 - static_cast<double>(f % 15) / 15), 0});
  }
  for (const MotionFault& fault : FindMotionFaults(saw).faults) {
    const bool is_level = fault.kind == FaultKind::kSinks || fault.kind == FaultKind::kFloats;
    EXPECT_FALSE(is_level && fault.size > 0.05) << FaultSentences({fault}).front();
  }
}

TEST(MotionFaults, OfABodyThatFloatsAreMeasuredFromHeightZero) {
  for (const BodyMotion& motion : {Swaying(30), Hopping(60)}) {
    const MotionFault floats = OneFault(Lifted(motion, 1.5, 3.5, 0.06), FaultKind::kFloats);
    ExpectTime(floats, 1.5, 3.5);
    EXPECT_NEAR(floats.size, 0.06, 0.01);
    const MotionFault always = OneFault(Lifted(motion, 0, 9, 0.15), FaultKind::kFloats);
    ExpectTime(always, 0, 6);
    EXPECT_NEAR(always.size, 0.15, 0.01);
    EXPECT_THAT(always.text, HasSubstr("never touch the floor"));
    EXPECT_THAT(FindMotionFaults(Lifted(motion, 0, 9, 0.15), {.floor_m = 0.15}).faults, IsEmpty())
        << "on a floor at 15 cm";
    EXPECT_THAT(FindMotionFaults(Lifted(motion, 0, 9, 0.04)).faults, IsEmpty()) << "joints are above the soles";
  }
}

TEST(MotionFaults, AreJudgedOnAFloorThatIsFoundIfTheMotionIsFarFromZero) {
  const MotionFaults found = FindMotionFaults(Lifted(Swaying(30), 0, 9, -1.1));
  EXPECT_TRUE(found.is_floor_found);
  EXPECT_NEAR(found.floor_m, -1.1, 0.03);
  EXPECT_THAT(found.faults, IsEmpty());
}

TEST(MotionFaults, ANarrowRampUpwardsIsAFloatAndAStepIsNone) {
  // Only the height shows this fault: 30 cm for two seconds, reached smoothly.
  const auto rise = [](double t) { return 0.3 * std::clamp(std::min(t, 3 - t) / 0.5, 0.0, 1.0); };
  const auto floats = WithChange(Swaying(30), 1, 4, [&](BodyPose& pose, double t) {
    MoveAll(pose, {0.6 * std::sin(4 * t), rise(t), 0});
  });
  bool is_told = false;
  for (const MotionFault& fault : FindMotionFaults(floats).faults) is_told |= fault.kind == FaultKind::kFloats;
  EXPECT_TRUE(is_told);
  // A body that stands still up there stands on something.
  const auto stands = WithChange(Swaying(30), 1, 4, [&](BodyPose& pose, double t) { MoveAll(pose, {0, rise(t), 0}); });
  EXPECT_THAT(FindMotionFaults(stands).faults, IsEmpty());
}

TEST(MotionFaults, OfABodyThatSkatesHaveItsSpeedWithinATenth) {
  for (const double rate : {30, 120}) {
    for (const BodyMotion& motion : {Swaying(rate), Hopping(rate)}) {
      for (const double speed : {0.2, 0.4, 1.0}) {
        BodyMotion skating = motion;
        for (std::size_t f = 0; f < skating.poses.size(); ++f) {
          const double t = std::clamp(static_cast<double>(f) / rate - 2, 0.0, 2.0);
          MoveAll(skating.poses[f], {0.6 * speed * t, 0, -0.8 * speed * t});
        }
        const MotionFault skates = OneFault(skating, FaultKind::kSkates);
        ExpectTime(skates, 2, 4, 0.4);
        EXPECT_NEAR(skates.size, speed, 0.1 * speed);
      }
    }
  }
}

TEST(MotionFaults, OfABodyThatJumpsAreFoundForOneFrameAndForGood) {
  for (const glm::dvec3& by : {glm::dvec3(0.5, 0, 0), glm::dvec3(0, 0.5, 0), glm::dvec3(-0.3, 0, 0.4)}) {
    const MotionFault once =
        OneFault(WithChange(Hopping(30), 2, 2 + 1.0 / 30, [&](BodyPose& pose, double) { MoveAll(pose, by); }),
                 FaultKind::kJumps);
    ExpectTime(once, 2, 2);
    EXPECT_NEAR(once.size, 0.5, 0.05);
  }
  const auto moved = WithChange(Swaying(60), 2, 9, [](BodyPose& pose, double) { MoveAll(pose, {0.4, 0, 0.3}); });
  const MotionFault for_good = OneFault(moved, FaultKind::kJumps);
  ExpectTime(for_good, 2, 2);
  EXPECT_NEAR(for_good.size, 0.5, 0.02);
}

TEST(MotionFaults, OfOneJointThatPopsNameTheInnermostJoint) {
  for (const double frames : {1, 3}) {
    const auto motion = WithChange(Hopping(30), 2, 2 + frames / 30, [](BodyPose& pose, double) {
      for (const Role joint : {kLeftWrist, kLeftHand}) pose[joint] += glm::dvec3(0, 0.3, 0.4);
    });
    const MotionFault pops = FindMotionFaults(motion).faults.front();
    EXPECT_EQ(FaultName(pops.kind), "pops");
    EXPECT_EQ(pops.joint, kLeftWrist);
    EXPECT_NEAR(pops.size, 0.5, 0.05);
    ExpectTime(pops, 2, 2, 0.15);
  }
}

TEST(MotionFaults, ASecondInWhichNothingMovesIsAFreezeAndNotItsCatchingUp) {
  for (const double rate : {30, 120}) {
    BodyMotion motion = Hopping(rate);
    const auto from = static_cast<std::size_t>(2 * rate), count = static_cast<std::size_t>(rate);
    for (std::size_t f = from; f < from + count; ++f) motion.poses[f] = motion.poses[from];
    const MotionFault freezes = OneFault(motion, FaultKind::kFreezes);
    ExpectTime(freezes, 2, 3);
  }
}

TEST(MotionFaults, APoseThatIsRepeatedExactlyForLongIsAFreezeEvenIfItIsReachedSmoothly) {
  const auto held = [](double seconds, double tremor_m) {
    BodyMotion motion{.rate_hz = 30, .poses = {}};
    for (int f = 0; f < 30 * (4 + seconds); ++f) {
      const double t = f / 30.0, moved = t < 2 ? t : std::max(t - seconds, 2.0);
      const double sway = 0.05 * std::cos(kPi * moved / 2) + tremor_m * (f % 2);
      motion.poses.push_back(Posed(0.86, 0, sway, 0.5 * std::cos(kPi * moved / 2)));
    }
    return motion;
  };
  EXPECT_THAT(FaultSentences(FindMotionFaults(held(2, 0)).faults), IsEmpty()) << "authored clips hold poses";
  EXPECT_THAT(FaultSentences(FindMotionFaults(held(6, 2e-5)).faults), IsEmpty()) << "a person who stands still";
  ExpectTime(OneFault(held(6, 0), FaultKind::kFreezes), 2, 8);
  // A clip that is one pose from its beginning to its end is a recording fault, too.
  const MotionFault always = OneFault({30, std::vector<BodyPose>(195, Posed(0.86, 0, 0, 0))}, FaultKind::kFreezes);
  ExpectTime(always, 0, 194 / 30.0);
  EXPECT_EQ(always.text, "freezes for 6.47 s in all frames");
}

TEST(MotionFaults, OfALimbThatStretchesNameItsFarEnd) {
  const auto motion = WithChange(Swaying(30), 2, 4, [](BodyPose& pose, double) {
    for (const Role joint : {kRightHand, kRightWrist}) {
      pose[joint] += 0.05 * (pose[kRightWrist] - pose[kRightElbow]);
    }
  });
  const MotionFault stretches = OneFault(motion, FaultKind::kStretches);
  EXPECT_EQ(stretches.joint, kRightWrist);
  EXPECT_NEAR(stretches.size, 0.05, 0.01);
  ExpectTime(stretches, 2, 4);
}

TEST(MotionFaults, OfABodyThatIsTornNameTheJoint) {
  struct Torn {
    Role joint;
    std::vector<Role> moved;
    glm::dvec3 by;
  };
  const Torn torn[] = {{kLeftHip, {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}, {0.4, 0, 0}},
                       {kRightShoulder, {kRightShoulder, kRightElbow, kRightWrist, kRightHand}, {0, 0.4, 0}},
                       {kHead, {kHead}, {0.4, 0, 0}},
                       {kLeftFoot, {kLeftFoot}, {0, 0, 0.4}},
                       {kRightHand, {kRightHand}, {-0.4, 0, 0}}};
  for (const Torn& one : torn) {
    for (const auto& [from, to] : {std::pair(0.0, 9.0), {2.0, 3.5}}) {
      const auto moved = WithChange(Swaying(30), from, to, [&](BodyPose& pose, double) {
        for (const Role joint : one.moved) pose[joint] += one.by;
      });
      const auto faults = FindMotionFaults(moved).faults;
      const auto told = std::ranges::find(faults, FaultKind::kTorn, &MotionFault::kind);
      ASSERT_NE(told, faults.end()) << RoleName(one.joint) << " " << from;
      EXPECT_EQ(told->joint, one.joint) << told->text;
      EXPECT_GT(told->size, 0.15) << told->text;
      ExpectTime(*told, from, std::min(to, 6.0), 0.07);
      EXPECT_EQ(std::ranges::count(faults, FaultKind::kTorn, &MotionFault::kind), 1);
    }
  }
  // The head is at the neck for a second.
  const auto headless =
      WithChange(Swaying(30), 2, 3, [](BodyPose& pose, double) { pose[kHead] = pose[kShoulderCentre]; });
  const auto faults = FindMotionFaults(headless).faults;
  EXPECT_TRUE(
      std::ranges::any_of(faults, [](const MotionFault& f) { return f.kind == FaultKind::kTorn && f.joint == kHead; }));
}

TEST(MotionFaults, TellExchangedSides) {
  const auto exchange = [](std::vector<Role> lefts) {
    return WithChange(Swaying(30), 2, 4, [=](BodyPose& pose, double) {
      for (const Role left : lefts) std::swap(pose[left], pose[Mirrored(left)]);
    });
  };
  for (const auto& lefts :
       {std::vector{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand},
        std::vector{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot},
        std::vector{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand, kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}}) {
    const auto faults = FindMotionFaults(exchange(lefts)).faults;
    const auto told =
        std::ranges::find_if(faults, [](const MotionFault& f) { return f.kind == FaultKind::kTorn && !f.joint; });
    ASSERT_NE(told, faults.end()) << lefts.size();
    ExpectTime(*told, 2, 4);
  }
}

TEST(MotionFaults, OfOneFootThatSkatesNameIt) {
  for (const double rate : {30, 120}) {
    const auto motion = WithChange(Swaying(rate), 2, 9, [](BodyPose& pose, double t) {
      for (const Role joint : {kRightAnkle, kRightFoot}) pose[joint].z += 0.2 * std::min(t, 1.0);
    });
    const auto faults = FindMotionFaults(motion).faults;
    const auto told = std::ranges::find(faults, FaultKind::kSkates, &MotionFault::kind);
    ASSERT_NE(told, faults.end()) << rate;
    EXPECT_EQ(told->joint, kRightFoot);
    EXPECT_NEAR(told->size, 0.2, 0.02);
    ExpectTime(*told, 2, 3, 0.1);
  }
}

TEST(MotionFaults, OfJointsThatAreNotShownHaveTheirTime) {
  const BodyMotion motion = Swaying(30);
  FaultOptions options{.unseen = std::vector<JointSet>(motion.poses.size()), .lost_after_s = 2};
  for (JointSet& joints : options.unseen) joints.set(Index(kSpine));  // a joint that is never seen has no gap
  for (int f = 60; f < 90; ++f) options.unseen[f].set(Index(kHead));
  options.unseen[150].set(Index(kHead));
  const auto faults = FindMotionFaults(motion, options).faults;
  ASSERT_EQ(faults.size(), 2u) << ::testing::PrintToString(FaultSentences(faults));
  EXPECT_EQ(faults[0].kind, FaultKind::kGaps);
  EXPECT_EQ(faults[0].joint, kHead);
  EXPECT_NEAR(faults[0].size, 1, 1e-9);
  ExpectTime(faults[0], 2, 3);
  ExpectTime(faults[1], 6, 8);
  // A gap before the first frame belongs to the file's beginning.
  const auto late = FindMotionFaults(motion, {.begin_s = 1.5, .lost_before_s = 1}).faults;
  ASSERT_EQ(late.size(), 1u) << ::testing::PrintToString(FaultSentences(late));
  ExpectTime(late[0], 0.5, 1.5);
}

TEST(MotionFaults, OfAnArmThroughChestOrHeadNameTheWrist) {
  const auto reach = [](double y, double z) {
    // The forearm keeps its length; the elbow changes.
    return WithChange(Swaying(60), 1, 5, [y, z](BodyPose& pose, double t) {
      const double part = std::clamp(std::min(t, 4 - t), 0.0, 1.0);
      const glm::dvec3 elbow = pose[kRightElbow], hand = pose[kRightHand] - pose[kRightWrist];
      const glm::dvec3 target(pose[kSpine].x, y, z);
      const glm::dvec3 wrist = glm::mix(pose[kRightWrist], target, part);
      pose[kRightElbow] = wrist + glm::length(pose[kRightWrist] - elbow) * glm::normalize(elbow - wrist);
      pose[kRightHand] = wrist + hand;
      pose[kRightWrist] = wrist;
    });
  };
  const auto is_told = [](const BodyMotion& motion) {
    const auto found = FindMotionFaults(motion).faults;
    return std::ranges::any_of(
        found, [](const MotionFault& f) { return f.kind == FaultKind::kPasses && f.joint == kRightWrist; });
  };
  EXPECT_TRUE(is_told(reach(1.3, 0)));
  EXPECT_TRUE(is_told(reach(1.5, 0))) << "through the head";
  EXPECT_FALSE(is_told(reach(1.3, 0.12))) << "a hand on the chest";
}

TEST(MotionFaults, AWrongRateIsToldByTheGravityOfFlights) {
  for (const double factor : {0.5, 2.0, 4.0}) {
    BodyMotion motion = Hopping(60);
    motion.rate_hz *= factor;
    const MotionFault rate = OneFault(motion, FaultKind::kRate);
    EXPECT_NEAR(rate.size, factor * factor * kGravity, 0.1 * factor * factor * kGravity);
    EXPECT_THAT(rate.text, HasSubstr(factor > 1 ? " times too high" : "is the frame rate 2 times too low"));
  }
}

TEST(MotionFaults, AMotionWithoutFlightsIsToldByItsSpeed) {
  BodyMotion motion = Swaying(60);
  motion.rate_hz *= 40;
  const auto found = FindMotionFaults(motion).faults;
  EXPECT_TRUE(std::ranges::any_of(found, [](const MotionFault& fault) { return fault.kind == FaultKind::kSpeed; }));
}

TEST(MotionFaults, NothingIsSaidOfJointsThatAReaderPlaced) {
  BodyMotion motion = Hopping(30);
  motion.poses[60][kLeftHand].y += 0.5;
  FaultOptions options{.unseen = std::vector<JointSet>(motion.poses.size())};
  EXPECT_THAT(FaultSentences(FindMotionFaults(motion, options).faults), ElementsAre(HasSubstr("left_hand pops")));
  for (JointSet& joints : options.unseen) joints.set(Index(kLeftHand));
  EXPECT_THAT(FindMotionFaults(motion, options).faults, IsEmpty());
}

TEST(MotionFaults, LimbsBetweenMarkersMayGiveWayAsSkinDoes) {
  BodyMotion motion = Swaying(30);
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    BodyPose& pose = motion.poses[f];
    const double change = 0.04 * std::sin(0.3 * static_cast<double>(f));
    for (const Role end : {kLeftWrist, kRightWrist, kLeftElbow, kRightElbow, kLeftAnkle, kRightAnkle}) {
      pose[end] += change * (pose[end] - pose[*ParentOf(end)]);
    }
  }
  EXPECT_FALSE(FindMotionFaults(motion).faults.empty()) << "of a skeleton";
  EXPECT_THAT(FaultSentences(FindMotionFaults(motion, {.is_of_markers = true}).faults), IsEmpty());
}

TEST(MotionFaults, AreDatedFromTheTimeOfTheFirstFrame) {
  BodyMotion motion = Hopping(30);
  motion.poses[60][kHead].y += 0.5;
  const auto faults = FindMotionFaults(motion, {.begin_s = 3}).faults;
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NEAR(faults.front().from_s, 5, 0.05);
  EXPECT_THAT(faults.front().text, HasSubstr("at 4.97 s"));
}

TEST(MotionFaults, OfManyAlikeTheLargestAreToldAndTheOthersCounted) {
  BodyMotion motion = Hopping(60);
  for (int i = 1; i <= 5; ++i) motion.poses[60 * static_cast<std::size_t>(i)][kHead].y += 0.5 + 0.1 * i;
  EXPECT_THAT(FaultSentences(FindMotionFaults(motion).faults),
              ElementsAre(HasSubstr("head pops by 80 cm at 2.98"), HasSubstr("head pops by 90 cm at 3.98"),
                          HasSubstr("head pops by 100 cm at 4.98"), "and 2 more like these"));
}

}  // namespace
}  // namespace etude
