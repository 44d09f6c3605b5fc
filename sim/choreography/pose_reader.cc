#include "sim/choreography/pose_reader.h"

#include <array>
#include <string>

#include "engine/document/fields.h"
#include "engine/fuzzy/features.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

/// Wider than any body, narrow enough to catch a slip of the keyboard.
constexpr Range kControlRange = {-200, 200};

/// The keys of one group of a pose ("left_arm"), written into the controls that `set` names.
template <std::size_t kCount, typename Set>
bool ReadGroup(Fields& pose, const std::string& yaml_key, std::string_view group,
               std::span<const ControlName, kCount> names, Set set) {
  const Node* node = pose.Raw(yaml_key);
  if (node == nullptr) return false;
  std::optional<Fields> keys;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (names[i].group != group) continue;
    if (names[i].key.empty()) {
      if (auto value = pose.OptionalNumber(yaml_key, kControlRange)) set(i, *value * names[i].per_unit);
    } else {
      if (!keys) keys.emplace(*node, "'" + yaml_key + "'");
      if (auto value = keys->OptionalNumber(names[i].key, kControlRange)) set(i, *value * names[i].per_unit);
    }
  }
  if (keys) {
    if (auto ok = keys->Finish(); !ok) pose.Complain(ok.error().place, ok.error().message);
  }
  return true;
}

void ReadSide(Fields& pose, const std::string& yaml_key, std::string_view group, std::span<const Side> sides,
              Controls& controls) {
  const bool given = ReadGroup(pose, yaml_key, group, SideControlNames(), [&](std::size_t control, double value) {
    for (Side side : sides) controls.Of(side, static_cast<SideControl>(control)) = value;
  });
  if (given && (group == "leg" || group == "knee")) {
    for (Side side : sides) controls.Of(side, SideControl::kLegFree) = 1;
  }
}

Controls ReadControls(Fields& pose) {
  Controls controls = ReadyStance();
  for (std::string_view group : {"hips", "jump_cm", "trunk", "neck"}) {
    ReadGroup(pose, std::string(group), group, MiddleControlNames(),
              [&](std::size_t control, double value) { controls[static_cast<MiddleControl>(control)] = value; });
  }
  constexpr Side kBoth[] = {Side::kLeft, Side::kRight};
  const std::pair<std::string_view, std::string_view> groups[] = {
      {"arm", "arms"}, {"elbow", "elbows"}, {"wrist", "wrists"}, {"leg", "legs"}, {"knee", "knees"}, {"foot", "feet"}};
  for (const auto& [one, both] : groups) {
    ReadSide(pose, std::string(both), one, kBoth, controls);
    ReadSide(pose, "left_" + std::string(one), one, {kBoth, 1}, controls);
    ReadSide(pose, "right_" + std::string(one), one, {kBoth + 1, 1}, controls);
  }
  return controls;
}

Result<void> CheckList(const Node& list, std::string_view name) {
  constexpr std::size_t kMost = 256;
  if (list.kind != Node::Kind::kSequence || list.items.empty()) {
    return Fail(list.place, "'{}' must be a list of at least one pose, found {}", name, Describe(list));
  }
  if (list.items.size() > kMost) return Fail(list.place, "{} {}; at most {}", list.items.size(), name, kMost);
  return {};
}

/// The pose's beat, within [0, beats).
double ReadBeat(Fields& pose, double beats) {
  const auto beat = pose.OptionalNumber("beat", {0, beats});
  if (!beat && pose.ok()) pose.Complain(pose.node().place, "a pose needs a 'beat'");
  if (beat && *beat >= beats) {
    pose.Complain(pose.node().place, fmt::format("beat {} is the next loop's; allowed: 0 to below {}", *beat, beats));
  }
  return beat.value_or(0);
}

Ease ReadEase(Fields& pose) {
  constexpr std::array kEases = {std::pair("smooth", Ease::kSmooth), std::pair("linger", Ease::kLinger),
                                 std::pair("rush", Ease::kRush), std::pair("snap", Ease::kSnap)};
  std::vector<std::string> names;
  for (const auto& [name, ease] : kEases) names.emplace_back(name);
  const std::string chosen = pose.Choice("ease", names, "smooth");
  for (const auto& [name, ease] : kEases) {
    if (chosen == name) return ease;
  }
  return Ease::kSmooth;
}

KeyPose::Target ReadTarget(Fields& pose, const Node& node, std::string_view feature, double tolerance_deg) {
  constexpr Range kDegrees = {0, 180}, kTolerance = {1, 90};
  if (node.kind != Node::Kind::kMapping) {
    return {std::string(feature), pose.Number(feature, 0, kDegrees), tolerance_deg};
  }
  Fields keys(node, "a key pose's feature");
  KeyPose::Target target = {std::string(feature), keys.Number("degrees", 0, kDegrees),
                            keys.Number("tolerance_deg", tolerance_deg, kTolerance)};
  if (auto ok = keys.Finish(); !ok) pose.Complain(ok.error().place, ok.error().message);
  return target;
}

}  // namespace

Result<std::vector<PoseKey>> ReadPoses(const Node& poses, double beats) {
  RETURN_IF_ERROR(CheckList(poses, "poses"));
  std::vector<PoseKey> keys;
  for (const Node& item : poses.items) {
    Fields pose(item, "a pose");
    const double beat = ReadBeat(pose, beats);
    const double hold = pose.Number("hold_beats", 0, {0, beats});
    const Ease ease = ReadEase(pose);
    const Controls controls = ReadControls(pose);
    if (!keys.empty() && beat <= keys.back().beat) {
      pose.Complain(item.place, fmt::format("beat {} does not come after the pose before it, which lasts to beat {}",
                                            beat, keys.back().beat));
    }
    if (beat + hold >= beats) pose.Complain(item.place, fmt::format("the pose is held beyond beat {}", beats));
    RETURN_IF_ERROR(pose.Finish());
    keys.push_back({beat, controls, ease});
    if (hold > 0) keys.push_back({beat + hold, controls});
  }
  return keys;
}

Result<std::vector<KeyPose>> ReadKeyPoses(const Node& key_poses, double beats) {
  RETURN_IF_ERROR(CheckList(key_poses, "key_poses"));
  std::vector<KeyPose> read;
  for (const Node& item : key_poses.items) {
    Fields pose(item, "a key pose");
    KeyPose key_pose{.beat = ReadBeat(pose, beats), .targets = {}};
    const double tolerance_deg = pose.Number("tolerance_deg", 20, {1, 90});
    for (Feature feature : AllFeatures()) {
      const std::string_view name = FeatureName(feature);
      if (const Node* node = pose.Raw(name)) key_pose.targets.push_back(ReadTarget(pose, *node, name, tolerance_deg));
    }
    if (key_pose.targets.empty()) pose.Complain(item.place, "a key pose needs at least one feature, e.g. 'RH: 90'");
    RETURN_IF_ERROR(pose.Finish());
    read.push_back(std::move(key_pose));
  }
  return read;
}

}  // namespace etude
