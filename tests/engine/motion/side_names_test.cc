#include "engine/motion/side_names.h"

#include <gtest/gtest.h>

#include <utility>

namespace etude {
namespace {

TEST(OtherSide, IsFoundInEveryNamingScheme) {
  constexpr std::pair<const char*, const char*> kPairs[] = {
      {"LeftArm", "RightArm"},
      {"left_arm", "right_arm"},
      {"LEFT_ARM", "RIGHT_ARM"},
      {"ShoulderLeft", "ShoulderRight"},
      {"left_shoulder", "right_shoulder"},
      {"upperarm.l", "upperarm.r"},
      {"UpperArm.L", "UpperArm.R"},
      {"UpperArm_L", "UpperArm_R"},
      {"lowerarm_l", "lowerarm_r"},
      {"L_Elbow", "R_Elbow"},
      {"lShldr", "rShldr"},
      {"LThigh", "RThigh"},
      {"LUpArm", "RUpArm"},
      {"Bip01 L Thigh", "Bip01 R Thigh"},
      {"mixamorig:LeftArm", "mixamorig:RightArm"},
      {"right_actor:LeftArm", "right_actor:RightArm"},
      {"Character1_LeftHandIndex1", "Character1_RightHandIndex1"},
      {"J_Bip_L_UpperArm", "J_Bip_R_UpperArm"},
      {"LeftToeBase_End", "RightToeBase_End"},
      {"hand.L.001", "hand.R.001"},
      {"l", "r"},
  };
  for (const auto& [left, right] : kPairs) {
    EXPECT_EQ(OtherSide(left), right);
    EXPECT_EQ(OtherSide(right), left);
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

}  // namespace
}  // namespace etude
