#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/joint_names.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/body_of_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A scheme's names for PersonSkeleton's joints, and its notation of the side.
struct Scheme {
  std::string scheme;
  std::string middle, left, right;     ///< '*' stands for the name
  std::array<std::string, 4> trunk{};  ///< Hips, Spine, Neck, Head
  std::array<std::string, 4> arm{};    ///< Shoulder (the collar bone), Arm, ForeArm, Hand
  std::array<std::string, 4> leg{};    ///< UpLeg, Leg, Foot, ToeBase
};

std::string Filled(std::string pattern, const std::string& name) { return pattern.replace(pattern.find('*'), 1, name); }

Skeleton Named(const Scheme& scheme) {
  Skeleton person = testing::PersonSkeleton();
  const auto rename = [&](const std::string& from, const std::string& to) {
    for (Joint& joint : person.joints) {
      if (joint.name == from) joint.name = to;
      if (joint.name == from + "_End") joint.name = to + "_End";
    }
  };
  // Rename all joints twice: first to "#" and the old name, because a scheme may give a joint's old name to a
  // different joint.
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
  ASSERT_OK(map, FindJointMap(skeleton, "stump.bvh"));
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
  EXPECT_THAT(testing::Message(map), ::testing::HasSubstr("no joint found for right_knee (a '"));
  EXPECT_THAT(testing::Message(map), ::testing::HasSubstr("'Stump'"));
}

// The schemes: sixteen words each, in the order of `Scheme`.
constexpr std::string_view kSchemes =
    R"(MmdInEnglish|*|*_L|*_R|center|upper body|neck|head|shoulder|arm|elbow|wrist|leg|knee|ankle|toe
HelpersNamedHipAndShoulder|*|Left*|Right*|Pelvis|Chest|Neck|Head|Shoulder|UpperArm|Elbow|Wrist|Thigh|Knee|Ankle|Toe
OptiTrack|*|L*|R*|Hip|Chest|Neck|Head|Shoulder|UArm|FArm|Hand|Thigh|Shin|Foot|Toe
TalkingWithHands|b_*|b_l_*|b_r_*|root|spine3|neck|head|shoulder|arm|forearm|wrist|upleg|leg|foot|ball
AutoRigPro|*.x|*.l|*.r|root|spine_01|neck|head
shoulder|arm_stretch|forearm_stretch|hand|thigh_stretch|leg_stretch|foot|toes_01
Quaternius|*|*.L|*.R|Hips|Torso|Neck|Head|Shoulder|UpperArm|LowerArm|Fist|UpperLeg|LowerLeg|Foot|Toes
MakeHuman|*|*.L|*.R|root|spine01|neck01|head|clavicle|upperarm01|lowerarm01|wrist|upperleg01|lowerleg01|foot|toe1-1
MotionBuilder|*|Left*|Right*|Hips|Spine2|Neck|Head|Shoulder|Arm|ForeArm|Hand|UpLeg|Leg|Foot|Toe
Mixamo|mixamorig:*|mixamorig:Left*|mixamorig:Right*|Hips|Spine|Neck|Head
Shoulder|Arm|ForeArm|Hand|UpLeg|Leg|Foot|ToeBase
MixamoInThreeJs|mixamorig*|mixamorigLeft*|mixamorigRight*|Hips|Spine|Neck|Head
Shoulder|Arm|ForeArm|Hand|UpLeg|Leg|Foot|ToeBase
MixamoInSketchfab|mixamorig:*_01|mixamorig:Left*_09|mixamorig:Right*_055|Hips|Spine|Neck|Head
Shoulder|Arm|ForeArm|Hand|UpLeg|Leg|Foot|ToeBase
Mass|Character1_*|Character1_Left*|Character1_Right*|Hips|Spine|Neck|Head
Shoulder|Arm|ForeArm|Hand|UpLeg|Leg|Foot|ToeBase
DeepMotion|*_JNT|l_*_JNT|r_*_JNT|hips|spine|neck|head|shoulder|arm|forearm|hand|upleg|leg|foot|toebase
Biovision|*|Left*|Right*|Hips|Chest|Neck|Head|Collar|Shoulder|Elbow|Wrist|Hip|Knee|Ankle|Toe
BiovisionSamples|*|Left*|Right*|Hips|Chest|Neck|Head|Collar|UpArm|LowArm|Hand|UpLeg|LowLeg|Foot|Toe
CmuForDaz|*|l*|r*|hip|chest|neck|head|collar|shoulder|elbow|hand|thigh|shin|foot|toe
Acclaim|*|l*|r*|root|thorax|upperneck|head|clavicle|humerus|radius|wrist|femur|tibia|foot|toes
Poser|*|l*|r*|hip|chest|neck|head|Collar|Shldr|ForeArm|Hand|Thigh|Shin|Foot|Toe
DazGenesis|*|l*|r*|hip|chestLower|neckLower|head|Collar|ShldrBend|ForearmBend|Hand|ThighBend|Shin|Foot|Toe
BandaiNamco|*|*_L|*_R|Hips|Chest|Neck|Head|Shoulder|UpperArm|LowerArm|Hand|UpperLeg|LowerLeg|Foot|Toes
VRoid|J_Bip_C_*|J_Bip_L_*|J_Bip_R_*|Hips|Chest|Neck|Head|Shoulder|UpperArm|LowerArm|Hand|UpperLeg|LowerLeg|Foot|ToeBase
Vrm|*|left*|right*|hips|chest|neck|head|Shoulder|UpperArm|LowerArm|Hand|UpperLeg|LowerLeg|Foot|Toes
KayKit|*|*.l|*.r|hips|chest|neck|head|shoulder|upperarm|lowerarm|wrist|upperleg|lowerleg|foot|toes
RobotExpressive|*|*.L|*.R|Body|Torso|Neck|Head|Shoulder|UpperArm|LowerArm|Palm2|UpperLeg|LowerLeg|Foot|Toes
Biped|Bip01 *|Bip01 L *|Bip01 R *|Pelvis|Spine1|Neck|Head|Clavicle|UpperArm|Forearm|Hand|Thigh|Calf|Foot|Toe0
ValveBiped|ValveBiped.Bip01_*|ValveBiped.Bip01_L_*|ValveBiped.Bip01_R_*|Pelvis|Spine2|Neck1|Head1
Clavicle|UpperArm|Forearm|Hand|Thigh|Calf|Foot|Toe0
Unreal|*_01|*_l|*_r|pelvis|spine|neck|head|clavicle|upperarm|lowerarm|hand|thigh|calf|foot|ball
Rigify|DEF-*|DEF-*.L|DEF-*.R|hips|chest|neck|head|shoulder|upper_arm|forearm|hand|thigh|shin|foot|toe
Smpl|*|left_*|right_*|pelvis|spine2|neck|head|collar|shoulder|elbow|wrist|hip|knee|ankle|foot
SmplNumbered|12_*|16_L_*|17_R_*|Pelvis|Spine2|Neck|Head|Collar|Shoulder|Elbow|Wrist|Hip|Knee|Ankle|Foot
Kinect|*|*Left|*Right|SpineBase|SpineMid|SpineShoulder|Head|Clavicle|Shoulder|Elbow|Wrist|Hip|Knee|Ankle|Foot
AzureKinect|*|*_LEFT|*_RIGHT|PELVIS|SPINE_CHEST|NECK|HEAD|CLAVICLE|SHOULDER|ELBOW|WRIST|HIP|KNEE|ANKLE|FOOT
Xsens|*|Left*|Right*|Pelvis|T8|Neck|Head|Shoulder|UpperArm|ForeArm|Hand|UpperLeg|LowerLeg|Foot|Toe
Rokoko|*|Left*|Right*|Hips|Spine2|Neck|Head|Shoulder|Arm|ForeArm|Hand|Thigh|Shin|Foot|Toe
MetaQuest|FullBody_*|FullBody_Left*|FullBody_Right*|Hips|SpineUpper|Neck|Head
Shoulder|ArmUpper|ArmLower|HandWrist|UpperLeg|LowerLeg|FootAnkle|FootBall
HAnim1|*|l_*|r_*|HumanoidRoot|vl5|vc7|skullbase|sternoclavicular|shoulder|elbow|wrist|hip|knee|ankle|midtarsal
HAnim2|*|l_*|r_*|humanoid_root|vl5|vc7|skullbase
sternoclavicular|shoulder|elbow|radiocarpal|hip|knee|talocrural|tarsometatarsal_2
Mhr|c_*|l_*|r_*|root|spine2|neck|head|clavicle|uparm|lowarm|wrist|upleg|lowleg|foot|ball
BonesOfTheBody|*|L_*|R_*|Pelvis|Thorax|Neck|Cranium|Clavicle|Humerus|Ulna|Hand|Femur|Tibia|Foot|Toes
OpenSim|*|*_l|*_r|pelvis|torso|neck|head|scapula|humerus|ulna|hand|femur|tibia|talus|toes
OpenSimJoints|*|*_l|*_r|ground_pelvis|back|neck|head|clav|acromial|elbow|radius_hand|hip|walker_knee|ankle|mtp
Mmd|*|左*|右*|センター|上半身|首|頭|肩|腕|ひじ|手首|足|ひざ|足首|つま先
MmdForBlender|*|*.L|*.R|センター|上半身|首|頭|肩|腕|ひじ|手首|足|ひざ|足首|つま先
Japanese|*|左_*|右_*|腰|胸|首|頭|鎖骨|上腕|前腕|手|大腿|下腿|足|つま先
French|*|*Gauche|*Droit|Bassin|Colonne|Cou|Tête|Clavicule|Bras|AvantBras|Main|Cuisse|Jambe|Pied|Orteil
FrenchJoints|*|*_G|*_D|bassin|colonne|cou|tête|clavicule|épaule|coude|poignet|hanche|genou|cheville|orteil
OurOwn|*|left_*|right_*|hip_centre|spine|shoulder_centre|head|collar|shoulder|elbow|wrist|hip|knee|ankle|foot)";

std::vector<Scheme> Schemes() {
  std::string text(kSchemes);
  std::ranges::replace(text, '\n', '|');
  const std::vector<std::string> words = testing::Parts(text, '|');
  std::vector<Scheme> schemes;
  for (std::size_t i = 0; i < words.size(); i += 16) {
    schemes.push_back({words[i], words[i + 1], words[i + 2], words[i + 3]});
    for (std::size_t k = 0; k < 4; ++k) {
      schemes.back().trunk[k] = words.at(i + 4 + k);
      schemes.back().arm[k] = words.at(i + 8 + k);
      schemes.back().leg[k] = words.at(i + 12 + k);
    }
  }
  return schemes;
}

INSTANTIATE_TEST_SUITE_P(, NamingSchemes, ::testing::ValuesIn(Schemes()),
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
