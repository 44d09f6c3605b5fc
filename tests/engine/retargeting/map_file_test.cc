#include "engine/retargeting/map_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/body_of_person.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(JointMapFile, NamesJointsByRole) {
  ASSERT_OK(taught, ReadJointMapFile("roles:\n  left_elbow: LForeArm\n  head: 'Skull: top'\n", "map.yaml"));
  ASSERT_EQ(taught->joints.size(), 2u);
  EXPECT_EQ(taught->joints.at(kLeftElbow).name, "LForeArm");
  EXPECT_EQ(taught->joints.at(kHead).name, "Skull: top");
  EXPECT_EQ(taught->joints.at(kHead).place.line, 3);
}

TEST(JointMapFile, MayTellUnitUpAndRateAlone) {
  ASSERT_OK(taught, ReadJointMapFile("unit: cm\nup: z\nrate: 59.94\n", "map.yaml"));
  EXPECT_TRUE(taught->joints.empty());
  EXPECT_EQ(taught->metres_per_unit, 0.01);
  EXPECT_EQ(taught->up, UpAxis::kZ);
  EXPECT_EQ(taught->rate_hz, 59.94);
  EXPECT_EQ(ReadJointMapFile("unit: 0.25\n", "map.yaml")->metres_per_unit, 0.25);
}

TEST(JointMapFile, ComplainsWhereItIsWrong) {
  const auto map = [](const std::string& text) -> Result<JointMap> {
    ASSIGN_OR_RETURN(const auto taught, ReadJointMapFile(text, "map.yaml"));
    return FindJointMap(testing::PersonSkeleton(), "person.bvh", &taught);
  };
  EXPECT_TRUE(testing::AnswersAreKept("tests/engine/retargeting/map_complaints.txt",
                                      [&](const std::string& text) { return testing::Refusal(map(text)); }));
}

void ExpectRoundTrip(const Skeleton& skeleton) {
  ASSERT_OK(map, FindJointMap(skeleton, "person.bvh"));
  const std::string text = WriteJointMapFile(skeleton, *map);
  const auto taught = ReadJointMapFile(text, "map.yaml");
  ASSERT_TRUE(taught) << ToString(taught.error()) << "\n" << text;
  EXPECT_EQ(taught->joints.size(), kRoleCount - map->composed.size());
  ASSERT_OK(again, FindJointMap(skeleton, "person.bvh", &*taught));
  EXPECT_EQ(again->composed, map->composed);
  for (const Role role : AllRoles()) {
    EXPECT_EQ((*again)[role].joint, (*map)[role].joint) << RoleName(role);
    EXPECT_EQ((*again)[role].offset, (*map)[role].offset) << RoleName(role);
  }
}

TEST(JointMapFile, ReadBackGivesTheSameMap) {
  ExpectRoundTrip(testing::PersonSkeleton());
  Skeleton without_tips = testing::PersonSkeleton();
  for (Joint& joint : without_tips.joints) {
    if (joint.is_end_site) joint.rest.translation = {0, 0, 0};
  }
  ExpectRoundTrip(without_tips);
}

TEST(JointMapFile, HoldsNamesOfAnyCharacters) {
  Skeleton person = testing::PersonSkeleton();
  for (Joint& joint : person.joints) joint.name = "null: #\\\"\t{" + joint.name;
  person.joints[person.Find("null: #\\\"\t{Hips")].name = "~";
  ExpectRoundTrip(person);
}

TEST(JointMapFile, ListsWhatIsComposedAndWhatIsNotUsed) {
  Skeleton person = testing::PersonSkeleton();
  person.joints[person.Find("LeftHand_End")].rest.translation = {0, 0, 0};
  const std::string text = WriteJointMapFile(person, *FindJointMap(person, "person.bvh"));
  EXPECT_THAT(text, HasSubstr("\n  left_elbow: \"LeftForeArm\"\n"));
  EXPECT_THAT(text,
              HasSubstr("\n  # left_hand: the file has no such joint; Etude uses a point fixed to \"LeftHand\"\n"));
  EXPECT_THAT(text, HasSubstr("\n#   \"LeftShoulder\"\n"));
  EXPECT_THAT(text, Not(HasSubstr("#   \"LeftForeArm\"")));
}

TEST(JointMapFile, LeavesOutAJointThatBearsTheNameOfAnother) {
  Skeleton person = testing::PersonSkeleton();
  person.joints.insert(person.joints.begin(), Joint{"Head", -1, {}, false});
  for (Joint& joint : person.joints) ++joint.parent;
  person.joints[0].parent = person.joints[1].parent = -1;
  person.joints[person.Find("Head_End")].name = "Head";
  ASSERT_OK(map, FindJointMap(person, "person.bvh"));
  const std::string text = WriteJointMapFile(person, *map);
  EXPECT_THAT(text, HasSubstr("\n  # head: the joint \"Head\", but not the first joint with this name\n"));
  ASSERT_OK(taught, ReadJointMapFile(text, "map.yaml"));
  ASSERT_OK(again, FindJointMap(person, "person.bvh", &*taught));
  EXPECT_EQ((*again)[kHead].joint, (*map)[kHead].joint);
}

}  // namespace
}  // namespace etude
