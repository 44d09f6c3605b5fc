#include "engine/retargeting/joint_layouts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/motion/body.h"

namespace etude {
namespace {

/// The 70 keypoints of SAM 3D Body and the 127 joints of its body model MHR, in their order. A point that plays a role
/// has the role's name: the foot is the big toe (keypoints) or the ball (joints), the hand is the middle finger.
constexpr std::string_view kMhrKeypoints =
    "nose left_eye right_eye left_ear right_ear left_shoulder right_shoulder left_elbow right_elbow left_hip "
    "right_hip left_knee right_knee left_ankle right_ankle left_foot left_small_toe left_heel right_foot "
    "right_small_toe right_heel right_thumb_tip right_thumb_first right_thumb_second right_thumb_third "
    "right_index_tip right_index_first right_index_second right_index_third right_hand right_middle_first "
    "right_middle_second right_middle_third right_ring_tip right_ring_first right_ring_second right_ring_third "
    "right_pinky_tip right_pinky_first right_pinky_second right_pinky_third right_wrist left_thumb_tip "
    "left_thumb_first left_thumb_second left_thumb_third left_index_tip left_index_first left_index_second "
    "left_index_third left_hand left_middle_first left_middle_second left_middle_third left_ring_tip "
    "left_ring_first left_ring_second left_ring_third left_pinky_tip left_pinky_first left_pinky_second "
    "left_pinky_third left_wrist left_olecranon right_olecranon left_cubital_fossa right_cubital_fossa "
    "left_acromion right_acromion shoulder_centre";
constexpr std::string_view kMhrJoints =
    "body_world hip_centre left_hip left_knee left_ankle l_talocrural l_subtalar l_transversetarsal left_foot "
    "l_lowleg_twist1_proc l_lowleg_twist2_proc l_lowleg_twist3_proc l_lowleg_twist4_proc l_upleg_twist0_proc "
    "l_upleg_twist1_proc l_upleg_twist2_proc l_upleg_twist3_proc l_upleg_twist4_proc right_hip right_knee "
    "right_ankle r_talocrural r_subtalar r_transversetarsal right_foot r_lowleg_twist1_proc r_lowleg_twist2_proc "
    "r_lowleg_twist3_proc r_lowleg_twist4_proc r_upleg_twist0_proc r_upleg_twist1_proc r_upleg_twist2_proc "
    "r_upleg_twist3_proc r_upleg_twist4_proc c_spine0 spine c_spine2 c_spine3 r_clavicle right_shoulder "
    "right_elbow r_wrist_twist right_wrist r_pinky0 r_pinky1 r_pinky2 r_pinky3 r_pinky_null r_ring1 r_ring2 "
    "r_ring3 r_ring_null r_middle1 r_middle2 r_middle3 right_hand r_index1 r_index2 r_index3 r_index_null "
    "r_thumb0 r_thumb1 r_thumb2 r_thumb3 r_thumb_null r_lowarm_twist1_proc r_lowarm_twist2_proc "
    "r_lowarm_twist3_proc r_lowarm_twist4_proc r_uparm_twist0_proc r_uparm_twist1_proc r_uparm_twist2_proc "
    "r_uparm_twist3_proc r_uparm_twist4_proc l_clavicle left_shoulder left_elbow l_wrist_twist left_wrist "
    "l_pinky0 l_pinky1 l_pinky2 l_pinky3 l_pinky_null l_ring1 l_ring2 l_ring3 l_ring_null l_middle1 l_middle2 "
    "l_middle3 left_hand l_index1 l_index2 l_index3 l_index_null l_thumb0 l_thumb1 l_thumb2 l_thumb3 l_thumb_null "
    "l_lowarm_twist1_proc l_lowarm_twist2_proc l_lowarm_twist3_proc l_lowarm_twist4_proc l_uparm_twist0_proc "
    "l_uparm_twist1_proc l_uparm_twist2_proc l_uparm_twist3_proc l_uparm_twist4_proc shoulder_centre "
    "c_neck_twist1_proc c_neck_twist0_proc c_head c_jaw c_teeth c_jaw_null c_tongue0 c_tongue1 c_tongue2 "
    "c_tongue3 c_tongue4 r_eye r_eye_null l_eye l_eye_null head";

/// Returns the median distance of two joints; nullopt if the layout lacks one of them, or no frame shows both apart.
std::optional<double> LengthOf(std::span<const glm::dvec3> positions, const JointLayout& layout, Role from, Role to) {
  const auto column_of = [&](Role role) {
    const std::string name(RoleName(role));  // "left_hip", or "LHip" in layouts of marker names
    const std::size_t part = name.find('_') + 1;
    const std::string marker = std::string{ToUpper(name[0]), ToUpper(name[part])} + name.substr(part + 1);
    return static_cast<std::size_t>(
        std::ranges::find_if(layout.joints, [&](std::string_view one) { return one == name || one == marker; }) -
        layout.joints.begin());
  };
  const std::size_t a = column_of(from), b = column_of(to), joints = layout.joints.size();
  if (std::max(a, b) == joints) return std::nullopt;
  std::vector<double> lengths;
  for (std::size_t begin = 0; begin + joints <= positions.size(); begin += joints) {
    const double length = glm::distance(positions[begin + a], positions[begin + b]);
    if (length > 0) lengths.push_back(length);
  }
  return lengths.empty() ? std::nullopt : std::optional(UpperMedian(std::move(lengths)));
}

/// Returns the worst misfit of the layout's lengths to a person's, as a ratio of at least 1. Left and right limbs
/// should be equally long. Upper arm and forearm, and thigh and shank, may differ by a factor of 1.35. A hand should be
/// no longer than the forearm. Lengths that are not known have the misfit `unknown`.
double MisfitOf(std::span<const glm::dvec3> positions, const JointLayout& layout, double unknown) {
  using enum Role;
  constexpr double kProportion = 1.35;
  constexpr std::array<std::array<Role, 4>, 2> kLimbs = {
      {{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand}, {kLeftHip, kLeftKnee, kLeftAnkle, kLeftAnkle}}};
  double worst = 1;
  const auto compare = [&](std::optional<double> one, std::optional<double> other, double allowed) {
    worst = std::max(worst, one && other ? std::max(*one / *other, *other / *one) / allowed : unknown);
  };
  for (const auto& [upper, middle, end, tip] : kLimbs) {
    std::array<std::optional<double>, 2> uppers, lowers;
    for (const bool is_left : {true, false}) {
      const auto of = [&](Role role) { return is_left ? role : Mirrored(role); };
      uppers[is_left] = LengthOf(positions, layout, of(upper), of(middle));
      lowers[is_left] = LengthOf(positions, layout, of(middle), of(end));
      compare(uppers[is_left], lowers[is_left], kProportion);
      const auto hand = tip == end ? std::nullopt : LengthOf(positions, layout, of(end), of(tip));
      if (hand && lowers[is_left]) worst = std::max(worst, *hand / *lowers[is_left]);
    }
    compare(uppers[0], uppers[1], 1);
    compare(lowers[0], lowers[1], 1);
  }
  return worst;
}

}  // namespace

const std::vector<JointLayout>& JointLayouts() {
  static const std::vector<JointLayout> layouts = [] {
    std::vector<JointLayout> made;
    JointLayout own{"etude", {}};
    for (const Role role : AllRoles()) own.joints.push_back(RoleName(role));
    made.push_back(std::move(own));
    const std::vector<std::string_view> body = {
        "hip_centre",      "left_hip",    "right_hip",    "spine1",     "left_knee",     "right_knee",
        "spine",           "left_ankle",  "right_ankle",  "spine3",     "left_foot",     "right_foot",
        "shoulder_centre", "left_collar", "right_collar", "head",       "left_shoulder", "right_shoulder",
        "left_elbow",      "right_elbow", "left_wrist",   "right_wrist"};
    made.push_back({"smpl", body});
    made.push_back({"smpl", body});
    for (const std::string_view hand : {"left_hand", "right_hand"}) made.back().joints.push_back(hand);
    made.push_back({"h36m",
                    {"hip_centre", "right_hip", "right_knee", "right_ankle", "left_hip", "left_knee", "left_ankle",
                     "spine", "shoulder_centre", "nose", "head", "left_shoulder", "left_elbow", "left_wrist",
                     "right_shoulder", "right_elbow", "right_wrist"}});
    made.push_back({"coco",
                    {"nose", "left_eye", "right_eye", "left_ear", "right_ear", "left_shoulder", "right_shoulder",
                     "left_elbow", "right_elbow", "left_wrist", "right_wrist", "left_hip", "right_hip", "left_knee",
                     "right_knee", "left_ankle", "right_ankle"}});
    made.push_back(
        {"body_25", {"Nose", "Neck",    "RShoulder", "RElbow", "RWrist",  "LShoulder", "LElbow", "LWrist", "MidHip",
                     "RHip", "RKnee",   "RAnkle",    "LHip",   "LKnee",   "LAnkle",    "REye",   "LEye",   "REar",
                     "LEar", "LBigToe", "LSmallToe", "LHeel",  "RBigToe", "RSmallToe", "RHeel"}});
    made.push_back({"halpe_26", {"Nose",    "LEye",      "REye",      "LEar",   "REar", "LShoulder", "RShoulder",
                                 "LElbow",  "RElbow",    "LWrist",    "RWrist", "LHip", "RHip",      "LKnee",
                                 "RKnee",   "LAnkle",    "RAnkle",    "Head",   "Neck", "Hip",       "LBigToe",
                                 "RBigToe", "LSmallToe", "RSmallToe", "LHeel",  "RHeel"}});
    made.push_back({"mhr70", SplitAt(kMhrKeypoints, ' ')});
    made.push_back({"mhr", SplitAt(kMhrJoints, ' ')});
    // Kinect v2 and NTU RGB+D, LAFAN1, the order of MuJoCo's humanoid with SMPL's joints, and SMPL-X's first joints.
    made.push_back({"kinect_v2",
                    SplitAt("hip_centre spine neck head left_shoulder left_elbow left_wrist left_hand "
                            "right_shoulder right_elbow right_wrist right_hand left_hip left_knee "
                            "left_ankle left_foot right_hip right_knee right_ankle right_foot "
                            "shoulder_centre left_tip left_thumb right_tip right_thumb",
                            ' '),
                    false});
    made.push_back({"lafan1",
                    SplitAt("hip_centre left_hip left_knee left_ankle left_foot right_hip right_knee "
                            "right_ankle right_foot spine1 spine spine3 shoulder_centre head left_collar "
                            "left_shoulder left_elbow left_wrist right_collar right_shoulder right_elbow "
                            "right_wrist",
                            ' '),
                    false});
    made.push_back({"smpl_humanoid",
                    SplitAt("hip_centre left_hip left_knee left_ankle left_foot right_hip right_knee "
                            "right_ankle right_foot spine1 spine spine3 shoulder_centre head "
                            "left_collar left_shoulder left_elbow left_wrist left_hand right_collar "
                            "right_shoulder right_elbow right_wrist right_hand",
                            ' '),
                    false});
    made.push_back({"smplx", body, false});
    for (const std::string_view joint : {"jaw", "left_eye"}) made.back().joints.push_back(joint);
    return made;
  }();
  return layouts;
}

std::vector<std::string> JointLayoutNames() {
  std::vector<std::string> names;
  for (const JointLayout& layout : JointLayouts()) {
    if (names.empty() || names.back() != layout.name) names.emplace_back(layout.name);
  }
  return names;
}

std::vector<std::string> JointsOfLayout(std::string_view layout, std::size_t joints) {
  for (const JointLayout& one : JointLayouts()) {
    if (one.name == layout && one.joints.size() == joints) return {one.joints.begin(), one.joints.end()};
  }
  return {};
}

const JointLayout* FindBetterLayout(std::span<const glm::dvec3> positions, const JointLayout& used) {
  constexpr double kMinMisfit = 1.65;
  const double misfit = MisfitOf(positions, used, 1);
  if (misfit < kMinMisfit) return nullptr;
  const JointLayout* best = nullptr;
  double least = misfit;  // the cube of the other layout's misfit must be less
  for (const JointLayout& other : JointLayouts()) {
    if (other.joints.size() != used.joints.size() || other.name == used.name) continue;
    const double its = MisfitOf(positions, other, std::numeric_limits<double>::infinity()), cube = its * its * its;
    if (cube >= least) continue;
    least = cube;
    best = &other;
  }
  return best;
}

}  // namespace etude
