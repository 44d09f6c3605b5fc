#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/joint_names.h"
#include "tests/support/body_of_person.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// What a scheme calls PersonSkeleton's joints, and how it writes whose side they are on.
struct Scheme {
  const char* scheme;
  const char* middle;  ///< '*' stands for the name
  const char* left;
  const char* right;
  std::array<const char*, 4> trunk;  ///< Hips, Spine, Neck, Head
  std::array<const char*, 4> arm;    ///< Shoulder (the collar bone), Arm, ForeArm, Hand
  std::array<const char*, 4> leg;    ///< UpLeg, Leg, Foot, ToeBase
};

std::string Filled(std::string pattern, const std::string& name) { return pattern.replace(pattern.find('*'), 1, name); }

/// PersonSkeleton under other names.
Skeleton Named(const Scheme& scheme) {
  Skeleton person = testing::PersonSkeleton();
  const auto rename = [&](const std::string& from, const std::string& to) {
    for (Joint& joint : person.joints) {
      if (joint.name == from) joint.name = to;
      if (joint.name == from + "_End") joint.name = to + "_End";
    }
  };
  // Through numbers, since one scheme's names are another's for other joints.
  constexpr std::array kTrunk = {"Hips", "Spine", "Neck", "Head"};
  constexpr std::array kArm = {"Shoulder", "Arm", "ForeArm", "Hand"};
  constexpr std::array kLeg = {"UpLeg", "Leg", "Foot", "ToeBase"};
  for (const bool is_final : {false, true}) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto step = [&](const std::string& from, const std::string& to) {
        is_final ? rename("#" + from, to) : rename(from, "#" + from);
      };
      step(kTrunk[i], Filled(scheme.middle, scheme.trunk[i]));
      step(std::string("Left") + kArm[i], Filled(scheme.left, scheme.arm[i]));
      step(std::string("Right") + kArm[i], Filled(scheme.right, scheme.arm[i]));
      step(std::string("Left") + kLeg[i], Filled(scheme.left, scheme.leg[i]));
      step(std::string("Right") + kLeg[i], Filled(scheme.right, scheme.leg[i]));
    }
  }
  return person;
}

using NamingSchemes = ::testing::TestWithParam<Scheme>;

TEST_P(NamingSchemes, AreUnderstoodWhole) {
  const Skeleton skeleton = Named(GetParam());
  ASSERT_GE(skeleton.Find(Filled(GetParam().left, GetParam().arm[1])), 0) << "the control: it is renamed";
  testing::ExpectThePerson(skeleton);
}

TEST_P(NamingSchemes, GiveAKneeOfAnotherNameByBuildAndSaySo) {
  Skeleton skeleton = Named(GetParam());
  skeleton.joints[skeleton.Find(Filled(GetParam().right, GetParam().leg[1]))].name = "Stump";
  const auto map = FindJointMap(skeleton, "stump.bvh");
  ASSERT_TRUE(map) << ToString(map.error());
  EXPECT_EQ((*map)[Role::kRightKnee].joint, skeleton.Find("Stump"));
  EXPECT_THAT(map->by_anatomy, ::testing::Contains(Role::kRightKnee));
  EXPECT_GE(map->confidence, 0.9);
}

TEST_P(NamingSchemes, AreRefusedWithoutAKneeWhereTheBuildDoesNotTellIt) {
  Skeleton skeleton = Named(GetParam());
  Joint& knee = skeleton.joints[skeleton.Find(Filled(GetParam().right, GetParam().leg[1]))];
  knee.name = "Stump";
  knee.rest.translation *= 0.4;
  const auto map = FindJointMap(skeleton, "stump.bvh");
  ASSERT_FALSE(map);
  EXPECT_THAT(map.error().message, ::testing::HasSubstr("no joint found for right_knee (a '"));
  EXPECT_THAT(map.error().message, ::testing::HasSubstr("'Stump'"));
}

INSTANTIATE_TEST_SUITE_P(
    , NamingSchemes,
    ::testing::Values(Scheme{"MmdInEnglish",
                             "*",
                             "*_L",
                             "*_R",
                             {"center", "upper body", "neck", "head"},
                             {"shoulder", "arm", "elbow", "wrist"},
                             {"leg", "knee", "ankle", "toe"}},
                      Scheme{"HelpersNamedHipAndShoulder",
                             "*",
                             "Left*",
                             "Right*",
                             {"Pelvis", "Chest", "Neck", "Head"},
                             {"Shoulder", "UpperArm", "Elbow", "Wrist"},
                             {"Thigh", "Knee", "Ankle", "Toe"}},
                      Scheme{"OptiTrack",
                             "*",
                             "L*",
                             "R*",
                             {"Hip", "Chest", "Neck", "Head"},
                             {"Shoulder", "UArm", "FArm", "Hand"},
                             {"Thigh", "Shin", "Foot", "Toe"}},
                      Scheme{"TalkingWithHands",
                             "b_*",
                             "b_l_*",
                             "b_r_*",
                             {"root", "spine3", "neck", "head"},
                             {"shoulder", "arm", "forearm", "wrist"},
                             {"upleg", "leg", "foot", "ball"}},
                      Scheme{"AutoRigPro",
                             "*.x",
                             "*.l",
                             "*.r",
                             {"root", "spine_01", "neck", "head"},
                             {"shoulder", "arm_stretch", "forearm_stretch", "hand"},
                             {"thigh_stretch", "leg_stretch", "foot", "toes_01"}},
                      Scheme{"Quaternius",
                             "*",
                             "*.L",
                             "*.R",
                             {"Hips", "Torso", "Neck", "Head"},
                             {"Shoulder", "UpperArm", "LowerArm", "Fist"},
                             {"UpperLeg", "LowerLeg", "Foot", "Toes"}},
                      Scheme{"MakeHuman",
                             "*",
                             "*.L",
                             "*.R",
                             {"root", "spine01", "neck01", "head"},
                             {"clavicle", "upperarm01", "lowerarm01", "wrist"},
                             {"upperleg01", "lowerleg01", "foot", "toe1-1"}},
                      Scheme{"MotionBuilder",
                             "*",
                             "Left*",
                             "Right*",
                             {"Hips", "Spine2", "Neck", "Head"},
                             {"Shoulder", "Arm", "ForeArm", "Hand"},
                             {"UpLeg", "Leg", "Foot", "Toe"}},
                      Scheme{"Mixamo",
                             "mixamorig:*",
                             "mixamorig:Left*",
                             "mixamorig:Right*",
                             {"Hips", "Spine", "Neck", "Head"},
                             {"Shoulder", "Arm", "ForeArm", "Hand"},
                             {"UpLeg", "Leg", "Foot", "ToeBase"}},
                      Scheme{"MixamoInThreeJs",
                             "mixamorig*",
                             "mixamorigLeft*",
                             "mixamorigRight*",
                             {"Hips", "Spine", "Neck", "Head"},
                             {"Shoulder", "Arm", "ForeArm", "Hand"},
                             {"UpLeg", "Leg", "Foot", "ToeBase"}},
                      Scheme{"MixamoInSketchfab",
                             "mixamorig:*_01",
                             "mixamorig:Left*_09",
                             "mixamorig:Right*_055",
                             {"Hips", "Spine", "Neck", "Head"},
                             {"Shoulder", "Arm", "ForeArm", "Hand"},
                             {"UpLeg", "Leg", "Foot", "ToeBase"}},
                      Scheme{"Mass",
                             "Character1_*",
                             "Character1_Left*",
                             "Character1_Right*",
                             {"Hips", "Spine", "Neck", "Head"},
                             {"Shoulder", "Arm", "ForeArm", "Hand"},
                             {"UpLeg", "Leg", "Foot", "ToeBase"}},
                      Scheme{"DeepMotion",
                             "*_JNT",
                             "l_*_JNT",
                             "r_*_JNT",
                             {"hips", "spine", "neck", "head"},
                             {"shoulder", "arm", "forearm", "hand"},
                             {"upleg", "leg", "foot", "toebase"}},
                      Scheme{"Biovision",
                             "*",
                             "Left*",
                             "Right*",
                             {"Hips", "Chest", "Neck", "Head"},
                             {"Collar", "Shoulder", "Elbow", "Wrist"},
                             {"Hip", "Knee", "Ankle", "Toe"}},
                      Scheme{"BiovisionSamples",
                             "*",
                             "Left*",
                             "Right*",
                             {"Hips", "Chest", "Neck", "Head"},
                             {"Collar", "UpArm", "LowArm", "Hand"},
                             {"UpLeg", "LowLeg", "Foot", "Toe"}},
                      Scheme{"CmuForDaz",
                             "*",
                             "l*",
                             "r*",
                             {"hip", "chest", "neck", "head"},
                             {"collar", "shoulder", "elbow", "hand"},
                             {"thigh", "shin", "foot", "toe"}},
                      Scheme{"Acclaim",
                             "*",
                             "l*",
                             "r*",
                             {"root", "thorax", "upperneck", "head"},
                             {"clavicle", "humerus", "radius", "wrist"},
                             {"femur", "tibia", "foot", "toes"}},
                      Scheme{"Poser",
                             "*",
                             "l*",
                             "r*",
                             {"hip", "chest", "neck", "head"},
                             {"Collar", "Shldr", "ForeArm", "Hand"},
                             {"Thigh", "Shin", "Foot", "Toe"}},
                      Scheme{"DazGenesis",
                             "*",
                             "l*",
                             "r*",
                             {"hip", "chestLower", "neckLower", "head"},
                             {"Collar", "ShldrBend", "ForearmBend", "Hand"},
                             {"ThighBend", "Shin", "Foot", "Toe"}},
                      Scheme{"BandaiNamco",
                             "*",
                             "*_L",
                             "*_R",
                             {"Hips", "Chest", "Neck", "Head"},
                             {"Shoulder", "UpperArm", "LowerArm", "Hand"},
                             {"UpperLeg", "LowerLeg", "Foot", "Toes"}},
                      Scheme{"VRoid",
                             "J_Bip_C_*",
                             "J_Bip_L_*",
                             "J_Bip_R_*",
                             {"Hips", "Chest", "Neck", "Head"},
                             {"Shoulder", "UpperArm", "LowerArm", "Hand"},
                             {"UpperLeg", "LowerLeg", "Foot", "ToeBase"}},
                      Scheme{"Vrm",
                             "*",
                             "left*",
                             "right*",
                             {"hips", "chest", "neck", "head"},
                             {"Shoulder", "UpperArm", "LowerArm", "Hand"},
                             {"UpperLeg", "LowerLeg", "Foot", "Toes"}},
                      Scheme{"KayKit",
                             "*",
                             "*.l",
                             "*.r",
                             {"hips", "chest", "neck", "head"},
                             {"shoulder", "upperarm", "lowerarm", "wrist"},
                             {"upperleg", "lowerleg", "foot", "toes"}},
                      Scheme{"RobotExpressive",
                             "*",
                             "*.L",
                             "*.R",
                             {"Body", "Torso", "Neck", "Head"},
                             {"Shoulder", "UpperArm", "LowerArm", "Palm2"},
                             {"UpperLeg", "LowerLeg", "Foot", "Toes"}},
                      Scheme{"Biped",
                             "Bip01 *",
                             "Bip01 L *",
                             "Bip01 R *",
                             {"Pelvis", "Spine1", "Neck", "Head"},
                             {"Clavicle", "UpperArm", "Forearm", "Hand"},
                             {"Thigh", "Calf", "Foot", "Toe0"}},
                      Scheme{"ValveBiped",
                             "ValveBiped.Bip01_*",
                             "ValveBiped.Bip01_L_*",
                             "ValveBiped.Bip01_R_*",
                             {"Pelvis", "Spine2", "Neck1", "Head1"},
                             {"Clavicle", "UpperArm", "Forearm", "Hand"},
                             {"Thigh", "Calf", "Foot", "Toe0"}},
                      Scheme{"Unreal",
                             "*_01",
                             "*_l",
                             "*_r",
                             {"pelvis", "spine", "neck", "head"},
                             {"clavicle", "upperarm", "lowerarm", "hand"},
                             {"thigh", "calf", "foot", "ball"}},
                      Scheme{"Rigify",
                             "DEF-*",
                             "DEF-*.L",
                             "DEF-*.R",
                             {"hips", "chest", "neck", "head"},
                             {"shoulder", "upper_arm", "forearm", "hand"},
                             {"thigh", "shin", "foot", "toe"}},
                      Scheme{"Smpl",
                             "*",
                             "left_*",
                             "right_*",
                             {"pelvis", "spine2", "neck", "head"},
                             {"collar", "shoulder", "elbow", "wrist"},
                             {"hip", "knee", "ankle", "foot"}},
                      Scheme{"SmplNumbered",
                             "12_*",
                             "16_L_*",
                             "17_R_*",
                             {"Pelvis", "Spine2", "Neck", "Head"},
                             {"Collar", "Shoulder", "Elbow", "Wrist"},
                             {"Hip", "Knee", "Ankle", "Foot"}},
                      Scheme{"Kinect",
                             "*",
                             "*Left",
                             "*Right",
                             {"SpineBase", "SpineMid", "SpineShoulder", "Head"},
                             {"Clavicle", "Shoulder", "Elbow", "Wrist"},
                             {"Hip", "Knee", "Ankle", "Foot"}},
                      Scheme{"AzureKinect",
                             "*",
                             "*_LEFT",
                             "*_RIGHT",
                             {"PELVIS", "SPINE_CHEST", "NECK", "HEAD"},
                             {"CLAVICLE", "SHOULDER", "ELBOW", "WRIST"},
                             {"HIP", "KNEE", "ANKLE", "FOOT"}},
                      Scheme{"Xsens",
                             "*",
                             "Left*",
                             "Right*",
                             {"Pelvis", "T8", "Neck", "Head"},
                             {"Shoulder", "UpperArm", "ForeArm", "Hand"},
                             {"UpperLeg", "LowerLeg", "Foot", "Toe"}},
                      Scheme{"Rokoko",
                             "*",
                             "Left*",
                             "Right*",
                             {"Hips", "Spine2", "Neck", "Head"},
                             {"Shoulder", "Arm", "ForeArm", "Hand"},
                             {"Thigh", "Shin", "Foot", "Toe"}},
                      Scheme{"MetaQuest",
                             "FullBody_*",
                             "FullBody_Left*",
                             "FullBody_Right*",
                             {"Hips", "SpineUpper", "Neck", "Head"},
                             {"Shoulder", "ArmUpper", "ArmLower", "HandWrist"},
                             {"UpperLeg", "LowerLeg", "FootAnkle", "FootBall"}},
                      Scheme{"HAnim1",
                             "*",
                             "l_*",
                             "r_*",
                             {"HumanoidRoot", "vl5", "vc7", "skullbase"},
                             {"sternoclavicular", "shoulder", "elbow", "wrist"},
                             {"hip", "knee", "ankle", "midtarsal"}},
                      Scheme{"HAnim2",
                             "*",
                             "l_*",
                             "r_*",
                             {"humanoid_root", "vl5", "vc7", "skullbase"},
                             {"sternoclavicular", "shoulder", "elbow", "radiocarpal"},
                             {"hip", "knee", "talocrural", "tarsometatarsal_2"}},
                      Scheme{"Mhr",
                             "c_*",
                             "l_*",
                             "r_*",
                             {"root", "spine2", "neck", "head"},
                             {"clavicle", "uparm", "lowarm", "wrist"},
                             {"upleg", "lowleg", "foot", "ball"}},
                      Scheme{"BonesOfTheBody",
                             "*",
                             "L_*",
                             "R_*",
                             {"Pelvis", "Thorax", "Neck", "Cranium"},
                             {"Clavicle", "Humerus", "Ulna", "Hand"},
                             {"Femur", "Tibia", "Foot", "Toes"}},
                      Scheme{"OpenSim",
                             "*",
                             "*_l",
                             "*_r",
                             {"pelvis", "torso", "neck", "head"},
                             {"scapula", "humerus", "ulna", "hand"},
                             {"femur", "tibia", "talus", "toes"}},
                      Scheme{"OpenSimJoints",
                             "*",
                             "*_l",
                             "*_r",
                             {"ground_pelvis", "back", "neck", "head"},
                             {"clav", "acromial", "elbow", "radius_hand"},
                             {"hip", "walker_knee", "ankle", "mtp"}},
                      Scheme{"Mmd",
                             "*",
                             "左*",
                             "右*",
                             {"センター", "上半身", "首", "頭"},
                             {"肩", "腕", "ひじ", "手首"},
                             {"足", "ひざ", "足首", "つま先"}},
                      Scheme{"MmdForBlender",
                             "*",
                             "*.L",
                             "*.R",
                             {"センター", "上半身", "首", "頭"},
                             {"肩", "腕", "ひじ", "手首"},
                             {"足", "ひざ", "足首", "つま先"}},
                      Scheme{"Japanese",
                             "*",
                             "左_*",
                             "右_*",
                             {"腰", "胸", "首", "頭"},
                             {"鎖骨", "上腕", "前腕", "手"},
                             {"大腿", "下腿", "足", "つま先"}},
                      Scheme{"French",
                             "*",
                             "*Gauche",
                             "*Droit",
                             {"Bassin", "Colonne", "Cou", "Tête"},
                             {"Clavicule", "Bras", "AvantBras", "Main"},
                             {"Cuisse", "Jambe", "Pied", "Orteil"}},
                      Scheme{"FrenchJoints",
                             "*",
                             "*_G",
                             "*_D",
                             {"bassin", "colonne", "cou", "tête"},
                             {"clavicule", "épaule", "coude", "poignet"},
                             {"hanche", "genou", "cheville", "orteil"}},
                      Scheme{"OurOwn",
                             "*",
                             "left_*",
                             "right_*",
                             {"hip_centre", "spine", "shoulder_centre", "head"},
                             {"collar", "shoulder", "elbow", "wrist"},
                             {"hip", "knee", "ankle", "foot"}}),
    [](const auto& test) { return test.param.scheme; });

std::vector<int> JointsOf(const std::vector<NamedJoint>& named) {
  std::vector<int> joints;
  for (const NamedJoint& joint : named) joints.push_back(joint.joint);
  return joints;
}

TEST(JointNames, TellAWordFromAPartOfAWord) {
  Skeleton skeleton;
  for (const char* name :
       {"LeftForeArm", "LeftArm", "leftarm", "ALARM", "Leftover_Arm", "LArmTwist", "Arm", "Arm_L_02", "Arm_L_90"})
    skeleton.joints.push_back({.name = name, .parent = -1, .rest = {}});
  skeleton.joints.push_back({.name = "LeftArm", .parent = -1, .rest = {}, .is_end_site = true});
  EXPECT_THAT(JointsOf(JointNames(skeleton).Find("arm", Side::kLeft)), ElementsAre(1, 2, 7, 8));
  EXPECT_THAT(JointsOf(JointNames(skeleton).Find("arm", Side::kRight)), IsEmpty());
}

TEST(JointNames, TakeEveryDigitForOne) {
  for (const char digit : std::string("0123456789")) {
    Skeleton skeleton;
    for (const std::string& name : {std::string("Spine") + digit, std::string("LeftArm") + digit + "Twist"}) {
      skeleton.joints.push_back({.name = name, .parent = -1, .rest = {}});
    }
    const JointNames names(skeleton);
    EXPECT_THAT(JointsOf(names.Find(std::string("spine") + digit)), ElementsAre(0));
    EXPECT_THAT(JointsOf(names.Find("spine")), ElementsAre(0)) << "a number at the end may be left out";
    EXPECT_THAT(JointsOf(names.Find(std::string("arm") + digit + "twist", Side::kLeft)), ElementsAre(1));
  }
}

TEST(JointNames, GiveThePrefixWithoutItsNumbers) {
  Skeleton skeleton;
  for (const char* name : {"Bip01 L Thigh", "rig|mixamorig:LeftThigh", "l_thigh_jnt"})
    skeleton.joints.push_back({.name = name, .parent = -1, .rest = {}});
  const std::vector<NamedJoint> found = JointNames(skeleton).Find("thigh", Side::kLeft);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].prefix, "bip");
  EXPECT_EQ(found[1].prefix, "");
  EXPECT_EQ(found[2].prefix, "");
  EXPECT_EQ(found[2].suffixes, 1u);
}

TEST(JointNames, OfEndlessNamesTakeNoTime) {
  Skeleton skeleton;
  for (int i = 0; i < 1000; ++i) {
    skeleton.joints.push_back({.name = std::string(100'000, 'A') + "_1_1_LeftArm", .parent = -1, .rest = {}});
    skeleton.joints.push_back({.name = "a_b_c_d_e_f_g_1_1_1_1_LeftArm_1_1_1_1", .parent = -1, .rest = {}});
  }
  EXPECT_THAT(JointNames(skeleton).Find("arm", Side::kLeft), IsEmpty());
}

}  // namespace
}  // namespace etude
