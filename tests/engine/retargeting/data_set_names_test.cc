#include "engine/retargeting/data_set_names.h"

#include <gmock/gmock.h>

#include "engine/base/text.h"
#include "engine/formats/npz.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/joint_layouts.h"
#include "engine/retargeting/markers.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Names of a data set's joints, in the order of a layout.
struct Scheme {
  const char* layout;
  const char* names;
};
constexpr Scheme kSchemes[] = {
    // Human3.6M: its own names; MMPose; VideoPose and others; with another root; I2L-MeshNet; pelvis and head top
    {"h36m",
     "Hip RHip RKnee RFoot LHip LKnee LFoot Spine Thorax Neck/Nose Head LShoulder LElbow LWrist RShoulder RElbow "
     "RWrist"},
    {"h36m",
     "root right_hip right_knee right_foot left_hip left_knee left_foot spine thorax neck_base head "
     "left_shoulder left_elbow left_wrist right_shoulder right_elbow right_wrist"},
    {"h36m",
     "Hip RHip RKnee RAnkle LHip LKnee LAnkle Spine Thorax Nose Head LShoulder LElbow LWrist RShoulder RElbow "
     "RWrist"},
    {"h36m",
     "root RHip RKnee RAnkle LHip LKnee LAnkle torso neck nose head LShoulder LElbow LWrist RShoulder RElbow "
     "RWrist"},
    {"h36m",
     "Pelvis R_Hip R_Knee R_Ankle L_Hip L_Knee L_Ankle Torso Neck Nose Head L_Shoulder L_Elbow L_Wrist "
     "R_Shoulder R_Elbow R_Wrist"},
    {"h36m",
     "pelvis right_hip right_knee right_ankle left_hip left_knee left_ankle spine neck nose head_top "
     "left_shoulder left_elbow left_wrist right_shoulder right_elbow right_wrist"},
    // SMPL: smplx and HumanML3D; with short sides; I2L-MeshNet
    {"smpl",
     "pelvis left_hip right_hip spine1 left_knee right_knee spine2 left_ankle right_ankle spine3 left_foot "
     "right_foot neck left_collar right_collar head left_shoulder right_shoulder left_elbow right_elbow "
     "left_wrist right_wrist left_hand right_hand"},
    {"smpl",
     "Pelvis L_Hip R_Hip Spine_1 L_Knee R_Knee Spine_2 L_Ankle R_Ankle Spine_3 L_Foot R_Foot Neck L_Collar "
     "R_Collar Head L_Shoulder R_Shoulder L_Elbow R_Elbow L_Wrist R_Wrist"},
    {"smpl",
     "Pelvis L_Hip R_Hip Torso L_Knee R_Knee Spine L_Ankle R_Ankle Chest L_Toe R_Toe Neck L_Thorax R_Thorax Head "
     "L_Shoulder R_Shoulder L_Elbow R_Elbow L_Wrist R_Wrist L_Hand R_Hand"},
    // HALPE_26: MMPose
    {"halpe_26",
     "nose left_eye right_eye left_ear right_ear left_shoulder right_shoulder left_elbow right_elbow "
     "left_wrist right_wrist left_hip right_hip left_knee right_knee left_ankle right_ankle head neck hip "
     "left_big_toe right_big_toe left_small_toe right_small_toe left_heel right_heel"},
    {"body_25",
     "nose neck right_shoulder right_elbow right_wrist left_shoulder left_elbow left_wrist mid_hip right_hip "
     "right_knee right_ankle left_hip left_knee left_ankle right_eye left_eye right_ear left_ear "
     "left_big_toe left_small_toe left_heel right_big_toe right_small_toe right_heel"},
    {"coco",
     "Nose LEye REye LEar REar LShoulder RShoulder LElbow RElbow LWrist RWrist LHip RHip LKnee RKnee LAnkle "
     "RAnkle"},
};

std::vector<std::string> NamesIn(const Scheme& scheme) {
  const auto words = SplitAt(scheme.names, ' ');
  return {words.begin(), words.end()};
}

/// Reads an array whose joint j is at (0.1 + j / 100, height, 0) in all frames; a body of person's height.
RawMotion Read(const std::vector<std::string>& names) {
  NumberArray positions{.shape = {2, names.size(), 3}, .values = {}};
  for (std::size_t i = 0; i < 2 * names.size(); ++i) {
    const double j = static_cast<double>(i % names.size());
    for (const double x : {0.1 + j / 100, 1.7 * j / static_cast<double>(names.size() - 1), 0.0})
      positions.values.push_back(x);
  }
  const Npz arrays =
      *ReadNpz(WriteNpz({{"positions", positions}, {"rate_hz", {{}, {30}}}}, {{"names", names}}), "a.npz");
  auto raw = ReadRawNpz(arrays, "a.npz");
  EXPECT_TRUE(raw);
  return *raw;
}

TEST(DataSetNames, AreTheJointsOfTheirLayout) {
  int checked = 0;
  for (const Scheme& scheme : kSchemes) {
    const std::vector<std::string> names = NamesIn(scheme);
    const std::vector<std::string> expected = JointsOfLayout(scheme.layout, names.size());
    ASSERT_EQ(expected.size(), names.size()) << scheme.names;
    const RawMotion named = Read(names);
    for (std::size_t j = 0; j < names.size(); ++j) {
      const std::string joint = PlainJointName(expected[j]);
      const auto role = FindRole(joint);
      if (std::string_view(scheme.layout) == "halpe_26" && joint == "head") continue;  // the mean of nose and head
      // The sets name eyes, ears and roles; a role counts if the names are of a known data set.
      if (role && FindDataSet(names)) {
        EXPECT_EQ(named.roles[Index(*role)], static_cast<int>(j)) << scheme.names << ": " << joint;
      }
      if (!role) {
        EXPECT_EQ(FindJoint(named, joint), static_cast<int>(j)) << scheme.names << ": " << joint;
      }
      ++checked;
    }
  }
  EXPECT_EQ(checked, 6 * 17 + 24 + 22 + 24 + 25 + 25 + 17);
}

TEST(DataSetNames, OfMarkersDetermineTheirJoints) {
  for (const Scheme& scheme : kSchemes) {
    if (std::string_view(scheme.layout) == "coco")
      continue;  // no data set's sign: left_hip and ears are in others, too
    const std::vector<std::string> names = NamesIn(scheme), expected = JointsOfLayout(scheme.layout, names.size());
    const auto bodies = [&](const std::vector<std::string>& joints) {
      RawMotion raw = Read(joints);
      MarkerOptions options{.up = {.axis = {0, 1, 0}, .evidence = UpEvidence::kFile, .source = "test"}};
      options.keeps_shown = true;
      auto found = FindMarkerBodies(MarkersOf(raw), "a.npz", options);
      EXPECT_TRUE(found) << scheme.names;
      return found ? std::move(found->front()) : MarkerBody{};
    };
    const MarkerBody named = bodies(names), plain = bodies(expected);
    for (const Role role : AllRoles()) {
      const auto at = [&](const RawMotion& motion) {
        const int joint = motion.roles[Index(role)];
        return joint < 0 ? glm::dvec3(-1) : motion.At(0, static_cast<std::size_t>(joint));
      };
      EXPECT_EQ(at(named.shown), at(plain.shown)) << scheme.names << ": " << RoleName(role);
    }
  }
}

TEST(DataSetNames, DoNotChangeOtherNames) {
  for (const char* names : {"hip_centre spine shoulder_centre head left_hip right_hip left_knee right_knee neck",
                            "Hips Spine Spine1 Spine2 Neck Head LeftUpLeg RightUpLeg LeftLeg",
                            "nose left_eye left_shoulder left_hip left_knee neck", "LASI RASI LPSI T10 C7"}) {
    EXPECT_FALSE(FindDataSet(NamesIn({"", names}))) << names;
  }
  EXPECT_EQ(PlainJointName("Ann:L_Hip"), "left_hip");
  EXPECT_EQ(PlainJointName("HipRight"), "right_hip");
  EXPECT_EQ(PlainJointName("hip_centre"), "hip_centre");
  EXPECT_EQ(PlainJointName("LASI"), "lasi");
}

TEST(DataSetNames, OfKinectAndWithoutSomeColumnsAreKnown) {
  const auto column = [](const char* names, std::string_view joint) {
    const std::vector<std::string> all = NamesIn({"", names});
    const auto known = FindDataSet(all);
    if (!known) return std::string("unknown");
    const auto found = std::ranges::find(known->joints, joint, &KnownJoint::joint);
    return found == known->joints.end() ? "none" : all[found->points.front()];
  };
  constexpr const char* kKinect = "SpineBase SpineMid Neck Head ShoulderLeft HipLeft SpineShoulder";
  EXPECT_EQ(column(kKinect, "hip_centre"), "SpineBase");
  EXPECT_EQ(column(kKinect, "spine"), "SpineMid");
  EXPECT_EQ(column(kKinect, "shoulder_centre"), "SpineShoulder");
  constexpr const char* kSmpl = "pelvis left_hip spine1 spine2 spine3 neck left_shoulder";
  EXPECT_EQ(column(kSmpl, "spine"), "spine2");
  EXPECT_EQ(column(kSmpl, "shoulder_centre"), "neck");
  EXPECT_EQ(column(kSmpl, "head"), "none");
}

}  // namespace
}  // namespace etude
