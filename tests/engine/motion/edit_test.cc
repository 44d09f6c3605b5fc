#include "engine/motion/edit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "engine/motion/clip.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/person.h"
#include "tests/support/random_clip.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using testing::RandomClip;
using testing::Resting;
using testing::WorstDistance;

// ---- Resample ----

/// Returns one joint that turns about `axis` at `speed` rad/s; every second frame has the quaternion's other sign.
Clip Turning(const glm::dvec3& axis, double speed, int frames, double rate_hz) {
  Clip clip{.name = "turning", .skeleton = {}, .rate_hz = rate_hz, .frames = {}};
  clip.skeleton.joints.push_back({.name = "joint", .parent = -1, .rest = {}});
  for (int f = 0; f < frames; ++f) {
    const glm::dquat turn = glm::angleAxis(speed * f / rate_hz, axis);
    clip.frames.push_back({{.translation = {0.5 * f, 0, -f}, .rotation = f % 2 == 0 ? turn : -turn}});
  }
  return clip;
}

TEST(Resample, KeepsAConstantTurnOnItsGreatCircleAtAnyRate) {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -1, 2));
  const double speed = 40;  // rad/s, a third of a turn per frame
  const Clip clip = Turning(axis, speed, 61, 20);
  for (const double rate : {7.0, 24.0, 29.97, 30.0, 60.0, 120.0, 1000.0}) {
    const Clip resampled = Resample(clip, rate);
    EXPECT_EQ(resampled.rate_hz, rate);
    ASSERT_EQ(resampled.frames.size(), static_cast<std::size_t>(3 * rate + 1e-6) + 1);
    for (std::size_t k = 0; k < resampled.frames.size(); ++k) {
      const double t = static_cast<double>(k) / rate;
      const LocalTransform& joint = resampled.frames[k][0];
      const glm::dquat expected = glm::angleAxis(speed * t, axis);
      EXPECT_LT(std::min(glm::length(joint.rotation - expected), glm::length(joint.rotation + expected)), 1e-11);
      EXPECT_LT(glm::distance(joint.translation, {10 * t, 0, -20 * t}), 1e-10);
    }
  }
}

TEST(Resample, ChangesNothingAtTheSameRateAndTakesFramesAsTheyAreAtAWholePart) {
  const Clip clip = Turning({0, 1, 0}, 3, 50, 49);
  EXPECT_EQ(Resample(clip, 49).frames, clip.frames);
  const Clip seventh = Resample(clip, 7);
  ASSERT_EQ(seventh.frames.size(), 8u);
  for (std::size_t k = 0; k < seventh.frames.size(); ++k) EXPECT_EQ(seventh.frames[k], clip.frames[7 * k]);
  EXPECT_EQ(Resample(Turning({0, 1, 0}, 3, 1, 30), 60).frames.size(), 1u);
}

// ---- Trim ----

TEST(Trim, KeepsTheFramesNearestToBothEnds) {
  const Clip clip = Turning({0, 1, 0}, 1, 101, 100);
  ASSERT_OK(whole, Trim(clip, 0, 1));
  EXPECT_EQ(whole->frames, clip.frames);
  ASSERT_OK(part, Trim(clip, 0.1049, 0.2051));
  ASSERT_EQ(part->frames.size(), 12u);
  EXPECT_EQ(part->frames.front(), clip.frames[10]);
  EXPECT_EQ(part->frames.back(), clip.frames[21]);
  EXPECT_EQ(part->rate_hz, 100);
  ASSERT_OK(one, Trim(clip, 0.5, 0.5));
  EXPECT_EQ(one->frames.size(), 1u);
}

TEST(Trim, RefusesWhatIsNotWithinTheClip) {
  const Clip clip = Turning({0, 1, 0}, 1, 101, 100);
  const double nan = std::nan("");
  for (const auto& [from, to] : {std::pair{-0.01, 0.5}, std::pair{0.5, 1.01}, std::pair{0.6, 0.5}, std::pair{2.0, 3.0},
                                 std::pair{nan, 0.5}, std::pair{0.5, nan}, std::pair{0.0, 1e300}}) {
    EXPECT_THAT(testing::Message(Trim(clip, from, to)), HasSubstr("a range within the clip, which lasts 1 s"))
        << from << " " << to;
  }
}

// ---- Mirror ----

TEST(Mirror, ReflectsEveryJointIntoTheOneOfTheOtherSide) {
  Clip clip = testing::AtRest(testing::PersonSkeleton(), 3);
  testing::LowerArms(clip, 1);
  testing::At(clip, 2, "Hips") = {{12, 90, 5}, testing::Turn(0.7, glm::normalize(glm::dvec3(1, 2, 3)))};
  testing::At(clip, 2, "LeftUpLeg").rotation = testing::Turn(1.1, glm::normalize(glm::dvec3(-1, 0.3, 0.2)));
  const Clip mirrored = Mirror(clip);

  std::vector<GlobalTransform> before, after;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    ComputeGlobals(clip.skeleton, clip.frames[f], before);
    ComputeGlobals(mirrored.skeleton, mirrored.frames[f], after);
    for (std::size_t i = 0; i < before.size(); ++i) {
      std::string name = clip.skeleton.joints[i].name;
      if (name.starts_with("Left")) {
        name = "Right" + name.substr(4);
      } else if (name.starts_with("Right")) {
        name = "Left" + name.substr(5);
      }
      const int twin = mirrored.skeleton.Find(name);
      ASSERT_GE(twin, 0) << name;
      EXPECT_LT(glm::distance(after[twin].position, glm::dvec3(-1, 1, 1) * before[i].position), 1e-12) << name;
    }
  }
  EXPECT_GT(WorstDistance(clip, mirrored), 10);  // the control: mirroring changes the clip
}

TEST(Mirror, IsTheClipItselfWhenDoneTwice) {
  Clip clip = RandomClip(4, {.rest_rotations = true, .moving_offsets = true, .scales = true});
  clip.skeleton.joints[3].name = "hand.l";
  const Clip twice = Mirror(Mirror(clip));
  EXPECT_EQ(twice.frames, clip.frames);
  EXPECT_EQ(RestPose(twice.skeleton), RestPose(clip.skeleton));
  EXPECT_EQ(twice.skeleton.joints[3].name, "hand.l");
  EXPECT_EQ(Mirror(clip).skeleton.joints[3].name, "hand.r");
}

TEST(Mirror, ReflectsWhatScalesDo) {
  // A second implementation: reflected matrices.
  const Clip clip = RandomClip(5, {.rest_rotations = true, .moving_offsets = true, .scales = true});
  const Clip mirrored = Mirror(clip);
  const glm::dmat3 reflection(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  std::vector<GlobalTransform> before, after;
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    ComputeGlobals(clip.skeleton, clip.frames[f], before);
    ComputeGlobals(mirrored.skeleton, mirrored.frames[f], after);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_LT(glm::distance(after[i].position, reflection * before[i].position), 1e-12);
      const glm::dmat3 expected = reflection * before[i].axes * reflection;
      for (int k = 0; k < 3; ++k) EXPECT_LT(glm::distance(after[i].axes[k], expected[k]), 1e-12);
    }
  }
}

TEST(Mirror, OfABodyExchangesSides) {
  BodyMotion motion{.rate_hz = 25, .poses = std::vector<BodyPose>(2)};
  testing::Dice dice(6);
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint = dice.Vector();
  }
  const BodyMotion mirrored = Mirror(motion);
  EXPECT_EQ(mirrored.rate_hz, 25);
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const glm::dvec3& hand = motion.poses[f][Role::kLeftHand];
    EXPECT_EQ(mirrored.poses[f][Role::kRightHand], glm::dvec3(-hand.x, hand.y, hand.z));
    EXPECT_EQ(Mirror(mirrored).poses[f].joints, motion.poses[f].joints);
  }
  // Both kinds of mirror agree.
  EXPECT_LT(WorstDistance(Mirror(ToClip(motion, "a")), ToClip(mirrored, "b")), 1e-12);
}

// ---- WithoutScales ----

TEST(WithoutScales, KeepsEveryJointWhereItIs) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Clip clip = RandomClip(seed, {.roots = 2, .rest_rotations = true, .moving_offsets = true, .scales = true});
    const Clip unscaled = WithoutScales(clip);
    EXPECT_LT(WorstDistance(clip, unscaled), 1e-12);
    EXPECT_LT(WorstDistance(Resting(clip), Resting(unscaled)), 1e-12);
    for (const LocalPose& pose : unscaled.frames) {
      for (const LocalTransform& local : pose) {
        EXPECT_EQ(local.scale, glm::dvec3(1));
        EXPECT_NEAR(glm::length(local.rotation), 1, 1e-15);
      }
    }
    // The control: scales that are simply dropped change positions.
    Clip forgotten = clip;
    for (LocalPose& pose : forgotten.frames) {
      for (LocalTransform& local : pose) local.scale = glm::dvec3(1);
    }
    EXPECT_GT(WorstDistance(clip, forgotten), 0.1);
  }
}

TEST(WithoutScales, TurnsJointsAsTheirScaledAxesDo) {
  // Uniform scales do not turn the axes, so all rotations stay the same.
  Clip clip = RandomClip(7, {.rest_rotations = true});
  for (LocalPose& pose : clip.frames) {
    for (LocalTransform& local : pose) local.scale = glm::dvec3(1.7);
  }
  const Clip unscaled = WithoutScales(clip);
  for (std::size_t f = 0; f < clip.frames.size(); ++f) {
    for (std::size_t i = 0; i < clip.frames[f].size(); ++i) {
      EXPECT_NEAR(std::abs(glm::dot(unscaled.frames[f][i].rotation, clip.frames[f][i].rotation)), 1, 1e-14);
    }
  }
  // With sheared axes, no nearby rotation is closer to the axes than the chosen one.
  const Clip sheared = RandomClip(8, {.rest_rotations = true, .scales = true});
  const Clip straight = WithoutScales(sheared);
  std::vector<GlobalTransform> axes, rotations;
  ComputeGlobals(sheared.skeleton, sheared.frames[0], axes);
  ComputeGlobals(straight.skeleton, straight.frames[0], rotations);
  const auto gap = [](const glm::dmat3& a, const glm::dmat3& b) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += glm::dot(a[k] - b[k], a[k] - b[k]);
    return sum;
  };
  testing::Dice dice(9);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double own = gap(axes[i].axes, rotations[i].axes);
    for (int k = 0; k < 20; ++k) {
      const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(0.01 + 0.01 * k, glm::normalize(dice.Vector())));
      EXPECT_GT(gap(axes[i].axes, turn * rotations[i].axes), own);
    }
  }
}

TEST(WithoutScales, StandsJointsThatAreFlattenedOrMirrored) {
  for (const glm::dvec3& scale : {glm::dvec3(0), glm::dvec3(1, 0, 1), glm::dvec3(-1, 1, 1), glm::dvec3(1e-200)}) {
    Clip clip = RandomClip(10, {.rest_rotations = true});
    for (LocalPose& pose : clip.frames) pose[2].scale = scale;
    const Clip unscaled = WithoutScales(clip);
    EXPECT_LT(WorstDistance(clip, unscaled), 1e-12);
    for (const LocalTransform& local : unscaled.frames[0]) EXPECT_NEAR(glm::length(local.rotation), 1, 1e-15);
  }
}

TEST(WithoutScales, StandsJointsWhoseOneAxisIsLongBeyondMeasure) {
  // A joint turned and stretched below a stretched one has sheared axes.
  Clip clip = Turning(glm::normalize(glm::dvec3(1, 2, 3)), 20, 2, 20);
  clip.skeleton.joints.push_back({.name = "child", .parent = 0, .rest = {}});
  const glm::dquat own = glm::angleAxis(1.0, glm::normalize(glm::dvec3(2, -1, 1)));
  const auto turn_of_child = [&](int axis, double stretch) {
    LocalTransform above{.scale = {3, 1, 1}}, child{.rotation = own};
    child.scale[axis] = stretch;
    clip.frames = {{above, child}};
    const Clip unscaled = WithoutScales(clip);
    return glm::length(unscaled.frames[0][1].rotation - own);
  };
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(turn_of_child(axis, 1e6), 1e-12) << "flat for all that its inverse says: keeps the rotation of its own";
    EXPECT_GT(turn_of_child(axis, 1e3), 0.05) << "the control: takes the rotation nearest to its axes";
  }
}

TEST(WithoutScales, LeavesAClipWithoutAnyAsItIs) {
  const Clip clip = RandomClip(11, {.rest_rotations = true, .moving_offsets = true});
  EXPECT_EQ(WithoutScales(clip).frames, clip.frames);
}

// ---- WithWorldAxesAtRest, WithOneRoot ----

TEST(WithWorldAxesAtRest, LeavesNoRotationsAtRestAndEveryJointWhereItIs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Clip clip = RandomClip(seed, {.roots = 2, .rest_rotations = true, .moving_offsets = seed % 2 == 0});
    const Clip aligned = WithWorldAxesAtRest(clip);
    for (const Joint& joint : aligned.skeleton.joints) EXPECT_EQ(joint.rest.rotation, glm::dquat(1, 0, 0, 0));
    EXPECT_LT(WorstDistance(clip, aligned), 1e-12);
    EXPECT_LT(WorstDistance(Resting(clip), Resting(aligned)), 1e-12);
    // A joint's rotation in the world stays the same.
    std::vector<GlobalTransform> before, after;
    for (std::size_t i = 0; i < clip.skeleton.joints.size(); ++i) {
      const auto turn = [i](const Clip& of, std::vector<GlobalTransform>& globals) {
        ComputeGlobals(of.skeleton, of.frames[0], globals);
        const glm::dmat3 first = globals[i].axes;
        ComputeGlobals(of.skeleton, of.frames[1], globals);
        return globals[i].axes * glm::transpose(first);
      };
      const glm::dmat3 a = turn(clip, before), b = turn(aligned, after);
      for (int k = 0; k < 3; ++k) EXPECT_LT(glm::distance(a[k], b[k]), 1e-12);
    }
  }
}

TEST(WithOneRoot, PutsSeveralRootsUnderOneThatStandsStill) {
  Clip clip = RandomClip(12, {.roots = 3, .rest_rotations = true});
  clip.skeleton.joints[4].name = "root";
  const Clip rooted = WithOneRoot(clip);
  ASSERT_EQ(rooted.skeleton.joints.size(), clip.skeleton.joints.size() + 1);
  EXPECT_EQ(rooted.skeleton.joints[0].name, "root_");
  for (std::size_t i = 0; i < rooted.skeleton.joints.size(); ++i) {
    EXPECT_EQ(rooted.skeleton.joints[i].parent < 0, i == 0);
    EXPECT_LT(rooted.skeleton.joints[i].parent, static_cast<int>(i));
  }
  EXPECT_LT(WorstDistance(clip, rooted), 1e-15);
  EXPECT_EQ(WithOneRoot(rooted).skeleton.joints.size(), rooted.skeleton.joints.size());
}

TEST(OtherSide, IsFoundInEveryNamingScheme) {
  for (const std::string& both :
       testing::Parts("LeftArm>RightArm^left_arm>right_arm^LEFT_ARM>RIGHT_ARM^ShoulderLeft>ShoulderRight^"
                      "left_shoulder>right_shoulder^upperarm.l>upperarm.r^UpperArm.L>UpperArm.R^UpperArm_L>UpperArm_R^"
                      "lowerarm_l>lowerarm_r^L_Elbow>R_Elbow^lShldr>rShldr^LThigh>RThigh^LUpArm>RUpArm^"
                      "Bip01 L Thigh>Bip01 R Thigh^mixamorig:LeftArm>mixamorig:RightArm^"
                      "right_actor:LeftArm>right_actor:RightArm^Character1_LeftHandIndex1>Character1_RightHandIndex1^"
                      "J_Bip_L_UpperArm>J_Bip_R_UpperArm^LeftToeBase_End>RightToeBase_End^hand.L.001>hand.R.001^l>r")) {
    const std::vector<std::string> sides = testing::Parts(both, '>');
    EXPECT_EQ(OtherSide(sides[0]), sides[1]);
    EXPECT_EQ(OtherSide(sides[1]), sides[0]);
  }
}

TEST(OtherSide, IsNotSeenInOtherWords) {
  for (const char* name : {"Collar", "LowerBack", "lowerback", "Lower", "leftover", "Root", "upright", "Hips", "Reflex",
                           "L5", "R2D2", "Neck1", "LowerNeck", "left:Hips", "", ":", "Ärmel", "skull"}) {
    EXPECT_EQ(OtherSide(name), name);
  }
}

Skeleton WithNames(std::initializer_list<const char*> names) {
  Skeleton skeleton;
  for (const char* name : names) skeleton.joints.push_back({.name = name, .parent = -1, .rest = {}});
  return skeleton;
}

std::vector<std::string> NamesOf(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) names.push_back(joint.name);
  return names;
}

TEST(WithSidesSwapped, TakesASideGluedToTheNameWhereTheOtherOneIsThereToo) {
  const Skeleton skeleton =
      WithNames({"root", "lowerback", "lfemur", "rfemur", "leftarm", "rightarm", "L5", "L4", "leftover", "LeftEye"});
  const std::vector<std::string> swapped = {"root",    "lowerback", "rfemur", "lfemur",   "rightarm",
                                            "leftarm", "L5",        "L4",     "leftover", "RightEye"};
  EXPECT_EQ(NamesOf(WithSidesSwapped(skeleton)), swapped);
  EXPECT_EQ(NamesOf(WithSidesSwapped(WithSidesSwapped(skeleton))), NamesOf(skeleton));
}

// ---- WithRootAt ----

TEST(WithRootAt, LeavesEveryJointWhereItWas) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Clip clip = WithoutScales(RandomClip(seed));
    for (int root = 0; root < static_cast<int>(clip.skeleton.joints.size()); ++root) {
      const Clip rooted = WithRootAt(clip, root);
      ASSERT_EQ(rooted.frames.size(), clip.frames.size());
      EXPECT_EQ(rooted.skeleton.joints[0].name, clip.skeleton.joints[root].name);
      EXPECT_EQ(rooted.skeleton.joints[0].parent, -1);
      std::vector<GlobalTransform> before, after;
      for (std::size_t f = 0; f < clip.frames.size(); ++f) {
        ComputeGlobals(clip.skeleton, clip.frames[f], before);
        ComputeGlobals(rooted.skeleton, rooted.frames[f], after);
        for (std::size_t i = 0; i < before.size(); ++i) {
          const int same = rooted.skeleton.Find(clip.skeleton.joints[i].name);
          ASSERT_GE(same, 0);
          EXPECT_LT(glm::distance(before[i].position, after[same].position), 1e-9);
        }
      }
    }
  }
}

}  // namespace

}  // namespace etude
