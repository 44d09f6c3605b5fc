#include "engine/retargeting/body_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/retargeting/map_file.h"
#include "tests/support/person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::At;
using testing::AtRest;
using ::testing::HasSubstr;

/// Returns a clip of 20 frames with one person for each prefix, side by side, all at rest.
Clip People(const std::vector<std::string>& prefixes) {
  Skeleton all;
  for (const std::string& prefix : prefixes) {
    const int first = static_cast<int>(all.joints.size());
    for (Joint joint : testing::PersonSkeleton().joints) {
      joint.name = prefix + joint.name;
      if (joint.parent < 0) joint.rest.translation.x = 3.0 * first;
      joint.parent = joint.parent < 0 ? -1 : joint.parent + first;
      all.joints.push_back(joint);
    }
  }
  return AtRest(all, 20);
}

/// Lets a person bend an arm from frame 12 on, by this angle in degrees.
void Bend(Clip& clip, const std::string& prefix, double degrees = 50) {
  for (std::size_t k = 12; k < clip.frames.size(); ++k) {
    At(clip, k, prefix + "RightForeArm").rotation = testing::Turn(glm::radians(degrees), {0, 1, 0});
  }
}

/// Returns the prefix of the chosen body, and expects that every role has this prefix.
std::string Chosen(const Clip& clip, const std::set<std::string>& skinned = {},
                   const JointMapOverrides* taught = nullptr) {
  const auto chosen = ChooseBody(clip, "a.glb", taught, skinned);
  if (!chosen) return ToString(chosen.error());
  std::set<std::string> prefixes;
  for (const RolePoint& point : chosen->map.points) {
    const std::string& name = clip.skeleton.joints[static_cast<std::size_t>(point.joint)].name;
    prefixes.insert(name.substr(0, name.find(':') + 1));
  }
  return prefixes.size() == 1 ? *prefixes.begin() : "several bodies";
}

std::set<std::string> JointsOf(const Clip& clip, const std::string& prefix) {
  std::set<std::string> names;
  for (const Joint& joint : clip.skeleton.joints) {
    if (joint.name.starts_with(prefix)) names.insert(joint.name);
  }
  return names;
}

TEST(ChooseBody, TakesTheBodyThatMovesInThisClip) {
  for (const char* mover : {"Ann:", "Bob:", "Cas:"}) {
    Clip clip = People({"Ann:", "Bob:", "Cas:"});
    Bend(clip, mover);
    EXPECT_EQ(Chosen(clip), mover);
  }
  // A body that only slides moves, too; a tremor of a hundredth of a degree is rest.
  Clip slides = People({"Ann:", "Bob:"});
  Bend(slides, "Ann:", 0.01);
  At(slides, 5, "Bob:Hips").translation.z += 30;
  EXPECT_EQ(Chosen(slides), "Bob:");
}

TEST(ChooseBody, OfSeveralThatMoveOrRestTakesASkeletonThenTheFirst) {
  for (const bool moves : {true, false}) {
    Clip clip = People({"Ctrl:", "Ann:", "Bob:"});
    for (const char* one : {"Ctrl:", "Ann:", "Bob:"}) {
      if (moves) Bend(clip, one);
    }
    std::set<std::string> both = JointsOf(clip, "Ann:");
    both.merge(JointsOf(clip, "Bob:"));
    EXPECT_EQ(Chosen(clip), "Ctrl:");
    EXPECT_EQ(Chosen(clip, both), "Ann:");
    EXPECT_EQ(Chosen(clip, JointsOf(clip, "Bob:")), "Bob:");
  }
  // A skeleton at rest gives way to a body that moves.
  Clip clip = People({"Ann:", "Bob:"});
  Bend(clip, "Bob:");
  EXPECT_EQ(Chosen(clip, JointsOf(clip, "Ann:")), "Bob:");
}

TEST(ChooseBody, KeepsTheBodyThatTheUserNames) {
  Clip clip = People({"Ann:", "Bob:"});
  Bend(clip, "Bob:");
  JointMapOverrides taught;
  taught.joints[Role::kLeftHip] = {"Ann:LeftUpLeg", {}};
  EXPECT_EQ(Chosen(clip, JointsOf(clip, "Bob:"), &taught), "Ann:");
}

TEST(ChooseBody, NamesTheBodiesThatAreLeftOut) {
  Clip clip = People({"Ann:", "Bob:"});
  Bend(clip, "Bob:");
  ASSERT_OK(second, ChooseBody(clip, "a.glb"));
  EXPECT_EQ(second->doubt,
            "the file contains a second body with the left hip 'Ann:LeftUpLeg'; Etude uses the body with "
            "'Bob:LeftUpLeg' (use --joint-map to choose another body)");
  ASSERT_OK(more, ChooseBody(People({"Ann:", "Bob:", "Cas:"}), "a.glb"));
  EXPECT_THAT(more->doubt,
              HasSubstr("2 other bodies with the left hips 'Bob:LeftUpLeg', 'Cas:LeftUpLeg'; Etude uses the body"));
  ASSERT_OK(alone, ChooseBody(People({"Ann:"}), "a.glb"));
  EXPECT_EQ(alone->doubt, "");
}

}  // namespace
}  // namespace etude
