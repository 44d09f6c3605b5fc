#include "sim/skeleton_sensor/sensor_file.h"

#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr Range kMetres{0, 2}, kShare{0, 1}, kSeconds{0, 10};

struct NumberKey {
  const char* key;
  double SkeletonSensorOptions::*member;
  Range range;
};
const std::vector<NumberKey>& NumberKeys() {
  using Options = SkeletonSensorOptions;
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

Result<SkeletonSensorOptions> ReadSensorFile(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node node, ParseYaml(text, file));
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
  if (options.longest_episode < options.shortest_episode) {
    fields.Complain(node.place, "'longest_episode' is less than 'shortest_episode'");
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
