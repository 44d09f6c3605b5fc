#include "sim/skeleton_sensor/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "engine/document/fields.h"

namespace etude {
namespace {

using enum Role;

constexpr std::array kGroups = {JointGroup::kTorso, JointGroup::kShoulders, JointGroup::kElbows, JointGroup::kWrists,
                                JointGroup::kHands, JointGroup::kHips,      JointGroup::kKnees,  JointGroup::kFeet};
constexpr std::array<std::string_view, kJointGroupCount> kGroupNames = {"torso", "shoulders", "elbows", "wrists",
                                                                        "hands", "hips",      "knees",  "feet"};
constexpr std::array kBoneKinds = {BoneKind::kLowerSpine, BoneKind::kUpperSpine, BoneKind::kNeck, BoneKind::kCollar,
                                   BoneKind::kUpperArm,   BoneKind::kForearm,    BoneKind::kHand, BoneKind::kPelvis,
                                   BoneKind::kThigh,      BoneKind::kShank,      BoneKind::kFoot};
constexpr std::array<std::string_view, kBoneKindCount> kBoneNames = {
    "lower_spine", "upper_spine", "neck", "collar", "upper_arm", "forearm", "hand", "pelvis", "thigh", "shank", "foot"};

constexpr Range kMetres{0, 2}, kShare{0, 1}, kSeconds{0, 10};

struct NumberKey {
  const char* key;
  double SkeletonSensorOptions::*member;
  Range range;
};
const std::vector<NumberKey>& NumberKeys() {
  using Options = SkeletonSensorOptions;
  // Each row has the key in the file, the option that this key sets, and the option's allowed range.
  static const std::vector<NumberKey> keys = {
      {"reference_distance_m", &Options::reference_distance_m, {0.5, 10}},
      {"arm_stretch", &Options::arm_stretch, {0, 5}},
      {"hand_stretch", &Options::hand_stretch, {0, 5}},
      {"shoulder_stretch", &Options::shoulder_stretch, {0, 5}},
      {"planted_feet_m", &Options::planted_feet, kMetres},
      {"rest_time_s", &Options::rest_time_s, kSeconds},
      {"wander_time_s", &Options::wander_time_s, kSeconds},
      {"wander_smoothing_s", &Options::wander_smoothing_s, kSeconds},
      {"pose_length_m", &Options::pose_length_m, {0.01, 10}},
      {"far_pose_length_m", &Options::far_pose_length_m, {0.01, 10}},
      {"mode_share", &Options::mode_share, {0.001, 0.5}},
      {"mode_ratio", &Options::mode_ratio, {1, 20}},
      {"fast_share", &Options::fast_share, kShare},
      {"fast_time_s", &Options::fast_time_s, kSeconds},
      {"fast_quiet", &Options::fast_quiet, kShare},
      {"fast_tail", &Options::fast_tail, {0, 1.5}},
      {"nearest_guess_m", &Options::nearest_guess_m, {0.001, 2}},
      {"farthest_guess_m", &Options::farthest_guess_m, {0.001, 2}},
      {"wrong_guess_chance", &Options::wrong_guess_chance, kShare},
      {"dropout_share", &Options::dropout_share, {0, 0.9}},
      {"swaps_per_minute", &Options::swaps_per_minute, {0, 100}},
      {"outlier_chance", &Options::outlier_chance, kShare},
      {"outlier_size_m", &Options::outlier_size_m, kMetres},
  };
  return keys;
}

struct WholeKey {
  const char* key;
  int SkeletonSensorOptions::*member;
  Range range;
};
constexpr std::array<WholeKey, 3> kWholeKeys = {{
    {"lag_frames", &SkeletonSensorOptions::lag_frames, {0, 60}},
    {"shortest_episode", &SkeletonSensorOptions::shortest_episode, {1, 1000}},
    {"longest_episode", &SkeletonSensorOptions::longest_episode, {1, 1000}},
}};

struct GroupKey {
  const char* key;
  double GroupErrors::*member;
  Range range;
};
constexpr std::array<GroupKey, 4> kGroupKeys = {{{"size_m", &GroupErrors::size, {0, 2}},
                                                 {"depth_ratio", &GroupErrors::depth_ratio, {0.05, 20}},
                                                 {"still_m", &GroupErrors::still, {0, 2}},
                                                 {"white_m", &GroupErrors::white, {0, 2}}}};

void ReadGroup(const Node& node, std::string_view name, GroupErrors& group, Fields& outer) {
  Fields fields(node, fmt::format("the group '{}'", name));
  for (const GroupKey& key : kGroupKeys) group.*key.member = fields.Number(key.key, group.*key.member, key.range);
  if (auto finished = fields.Finish(); !finished) outer.Complain(finished.error().place, finished.error().message);
}

void ReadGroups(Fields& fields, SkeletonSensorOptions& options) {
  const Node* node = fields.Raw("groups");
  if (node == nullptr) return;
  Fields groups(*node, "'groups'");
  for (const JointGroup group : AllJointGroups()) {
    const Node* one = groups.Raw(GroupName(group));
    if (one != nullptr) ReadGroup(*one, GroupName(group), options[group], groups);
  }
  if (auto finished = groups.Finish(); !finished) fields.Complain(finished.error().place, finished.error().message);
}

void ReadCorrelations(Fields& fields, SkeletonSensorOptions& options) {
  const Node* node = fields.Raw("correlation");
  if (node == nullptr) return;
  Fields bones(*node, "'correlation'");
  for (const BoneKind kind : AllBoneKinds()) {
    double& rho = options.correlation[Index(kind)];
    rho = bones.Number(BoneName(kind), rho, {-0.99, 0.99});
  }
  if (auto finished = bones.Finish(); !finished) fields.Complain(finished.error().place, finished.error().message);
}

}  // namespace

JointGroup GroupOf(Role role) {
  using enum JointGroup;
  static constexpr std::array<JointGroup, kRoleCount> kGroupOfRoles = {
      kTorso,     kTorso,  kTorso,  kTorso,  // the centre, from the hip centre to the head
      kShoulders, kElbows, kWrists, kHands,  // the left arm
      kShoulders, kElbows, kWrists, kHands,  // the right arm
      kHips,      kKnees,  kFeet,   kFeet,   // the left leg
      kHips,      kKnees,  kFeet,   kFeet,   // the right leg
  };
  return kGroupOfRoles[Index(role)];
}

std::string_view GroupName(JointGroup group) { return kGroupNames[Index(group)]; }
std::span<const JointGroup, kJointGroupCount> AllJointGroups() { return kGroups; }

BoneKind BoneKindOf(Role child) {
  using enum BoneKind;
  static constexpr std::array<BoneKind, kRoleCount> kKindOfChildren = {
      kLowerSpine, kLowerSpine, kUpperSpine, kNeck,  // the centre, from the hip centre to the head
      kCollar,     kUpperArm,   kForearm,    kHand,  // the left arm
      kCollar,     kUpperArm,   kForearm,    kHand,  // the right arm
      kPelvis,     kThigh,      kShank,      kFoot,  // the left leg
      kPelvis,     kThigh,      kShank,      kFoot,  // the right leg
  };
  return kKindOfChildren[Index(child)];
}

std::string_view BoneName(BoneKind kind) { return kBoneNames[Index(kind)]; }
std::span<const BoneKind, kBoneKindCount> AllBoneKinds() { return kBoneKinds; }

double DepthDeviation(DepthLaw law, double z) {
  if (law == DepthLaw::kStructuredLight) return 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
  return 0.001 * (1.5 - 0.5 * z + 0.3 * z * z);
}

int SkeletonSensorOptions::Lag() const { return static_cast<int>(std::lround(std::min(1.0, strength) * lag_frames)); }

SkeletonSensorOptions SensorV1() {
  SkeletonSensorOptions v1;
  v1.view = {.width = 640, .height = 480, .fx = 580, .fy = 580, .cx = 320, .cy = 240, .skew = 0};  // view 58° × 45°
  v1.depth_law = DepthLaw::kStructuredLight;
  // The values of `size` for the trunk and the ends of limbs reproduce the published errors of torso, head, hands and
  // feet in a dance. The values for elbows and knees lie in between (ours). Errors are larger in depth than across the
  // line of sight; published ratios for a v2 are 1.2–1.8 at knees and feet, and the ratios of all groups are in this
  // range.
  constexpr GroupErrors kTrunk{.size = 0.025, .depth_ratio = 1.4, .still = 0.0014, .white = 0.0002};
  constexpr GroupErrors kMiddle{.size = 0.038, .depth_ratio = 1.4, .still = 0.0020, .white = 0.0006};
  constexpr GroupErrors kEnds{.size = 0.066, .depth_ratio = 1.4, .still = 0.0030, .white = 0.0010};
  v1.groups = {kTrunk, kTrunk, kMiddle, kEnds, kEnds, kTrunk, kMiddle, kEnds};
  // The correlations come from the v2's recordings, because no source states correlations for the v1.
  v1.correlation = SensorV2().correlation;
  v1.lag_frames = 3;  // Livingston et al. 2012: 106 ms at best
  return v1;
}

SkeletonSensorOptions SensorV2() {
  SkeletonSensorOptions v2;
  v2.view = {.width = 512, .height = 424, .fx = 365, .fy = 365, .cx = 256, .cy = 212, .skew = 0};  // view 70° × 60°
  v2.depth_law = DepthLaw::kTimeOfFlight;
  // `etude sensor fit` fitted these values, with 240 simulated worlds, to one recording with an optical reference: for
  // 6.6 s, a seated person lifts and lowers both arms 3 m in front of a Kinect v2. The recording does not determine:
  // errors of feet in motion (published: 5–6 cm); errors at other distances, of turned or standing bodies, and of other
  // people; lag, hidden limbs, swaps and dropouts.
  v2.reference_distance_m = 3.04;
  v2[JointGroup::kTorso] = {.size = 0.0344, .depth_ratio = 0.93, .still = 0.0014, .white = 0.000022};
  v2[JointGroup::kShoulders] = {.size = 0.0805, .depth_ratio = 1.16, .still = 0.0014, .white = 0.000044};
  v2[JointGroup::kElbows] = {.size = 0.0274, .depth_ratio = 0.70, .still = 0.0020, .white = 0.000088};
  v2[JointGroup::kWrists] = {.size = 0.0634, .depth_ratio = 0.83, .still = 0.0020, .white = 0.000088};
  v2[JointGroup::kHands] = {.size = 0.0688, .depth_ratio = 1.17, .still = 0.0020, .white = 0.000133};
  v2[JointGroup::kHips] = {.size = 0.0392, .depth_ratio = 0.70, .still = 0.0014, .white = 0.000022};
  v2[JointGroup::kKnees] = {.size = 0.0237, .depth_ratio = 1.33, .still = 0.0010, .white = 0.000044};
  v2[JointGroup::kFeet] = {.size = 0.0520, .depth_ratio = 1.19, .still = 0.0005, .white = 0.000088};
  v2.correlation = {0.690, 0.039, 0.516, -0.217, -0.082, 0.634, 0.897, 0.980, -0.232, 0.758, -0.107};
  v2.arm_stretch = 0.178;
  v2.hand_stretch = 4;
  v2.shoulder_stretch = 0.077;
  v2.planted_feet = 0.00392;
  v2.fast_share = 0.141;
  v2.fast_quiet = 0.00486;
  // This value was not fitted. A v2 smooths its output: without smoothing, a resting torso would jitter three times as
  // much.
  v2.wander_smoothing_s = 0.2;
  v2.lag_frames = 2;
  v2.swaps_when_facing = false;
  v2.outlier_chance = 0;
  return v2;
}

std::optional<SkeletonSensorOptions> FindSensorPreset(std::string_view name) {
  if (name == "v1") return SensorV1();
  if (name == "v2") return SensorV2();
  return std::nullopt;
}

Result<SkeletonSensorOptions> ReadSensorFile(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node node, ParseYaml(text, file));
  // Read every number; a missing number keeps the preset's value.
  Fields fields(node, "a sensor file");
  SkeletonSensorOptions options = *FindSensorPreset(fields.Choice("based_on", {"v1", "v2"}, "v2"));
  for (const NumberKey& key : NumberKeys()) {
    options.*key.member = fields.Number(key.key, options.*key.member, key.range);
  }
  for (const WholeKey& key : kWholeKeys) {
    options.*key.member = fields.Integer(key.key, options.*key.member, key.range);
  }
  options.swaps_when_facing = fields.Boolean("swaps_when_facing", options.swaps_when_facing);
  ReadGroups(fields, options);
  ReadCorrelations(fields, options);
  // Check that the values are consistent.
  if (options.longest_episode < options.shortest_episode) {
    fields.Complain(node.place, "'longest_episode' must not be less than 'shortest_episode'");
  }
  RETURN_IF_ERROR(fields.Finish());
  return options;
}

std::string WriteSensorFile(const SkeletonSensorOptions& options, std::string_view based_on) {
  std::string text = fmt::format("based_on: {}\n", based_on);
  const auto out = std::back_inserter(text);
  for (const NumberKey& key : NumberKeys()) fmt::format_to(out, "{}: {:.6g}\n", key.key, options.*key.member);
  for (const WholeKey& key : kWholeKeys) fmt::format_to(out, "{}: {}\n", key.key, options.*key.member);
  fmt::format_to(out, "swaps_when_facing: {}\ngroups:\n", options.swaps_when_facing);
  for (const JointGroup group : AllJointGroups()) {
    fmt::format_to(out, "  {}: {{", GroupName(group));
    for (const GroupKey& key : kGroupKeys) {
      fmt::format_to(out, "{}{}: {:.6g}", key.key == kGroupKeys[0].key ? "" : ", ", key.key,
                     options[group].*key.member);
    }
    text += "}\n";
  }
  text += "correlation:\n";
  for (const BoneKind kind : AllBoneKinds()) {
    fmt::format_to(out, "  {}: {:.4g}\n", BoneName(kind), options.correlation[Index(kind)]);
  }
  return text;
}

}  // namespace etude
