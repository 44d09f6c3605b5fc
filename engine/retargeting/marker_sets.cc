#include "engine/retargeting/marker_sets.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace etude {
namespace {

/// Adds a rule for each side; '?' in a marker's name is replaced by `left` or `right`.
void AddSides(std::vector<MarkerRule>& rules, Role left_role, const std::vector<std::string>& markers,
              std::string_view left, std::string_view right) {
  for (const bool is_left : {true, false}) {
    MarkerRule rule{is_left ? left_role : Mirrored(left_role), markers};
    for (std::string& marker : rule.markers) {
      if (const std::size_t at = marker.find('?'); at != std::string::npos) {
        marker.replace(at, 1, is_left ? left : right);
      }
    }
    rules.push_back(std::move(rule));
  }
}

using LimbMarkers = std::vector<std::pair<Role, std::vector<std::string>>>;

MarkerSet MakeSet(std::string name, std::string key, std::vector<MarkerRule> middle, const LimbMarkers& limbs,
                  std::string_view left, std::string_view right) {
  MarkerSet set{.name = std::move(name), .key = std::move(key), .rules = std::move(middle)};
  for (const auto& [role, markers] : limbs) AddSides(set.rules, role, markers, left, right);
  return set;
}

// Makes all sets: joints and keypoints first, then bones, then markers on the skin.
std::vector<MarkerSet> MakeSets() {
  std::vector<MarkerSet> sets;
  // Joints and keypoints.
  MarkerSet own{.name = "Etude's joints", .key = "etude", .rules = {}, .rank = 3};
  for (const Role role : AllRoles()) own.rules.push_back({role, {std::string(RoleName(role))}});
  sets.push_back(std::move(own));
  const LimbMarkers pose_limbs = {{Role::kLeftShoulder, {"?shoulder"}}, {Role::kLeftElbow, {"?elbow"}},
                                  {Role::kLeftWrist, {"?wrist"}},       {Role::kLeftHip, {"?hip"}},
                                  {Role::kLeftKnee, {"?knee"}},         {Role::kLeftAnkle, {"?ankle"}}};
  LimbMarkers with_toes = pose_limbs;
  with_toes.push_back({Role::kLeftFoot, {"?bigtoe"}});
  sets.push_back(
      MakeSet("OpenPose BODY_25", "body_25",
              {{Role::kHipCentre, {"midhip"}}, {Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"lear", "rear"}}},
              with_toes, "l", "r"));
  sets.push_back(
      MakeSet("HALPE_26", "halpe_26",
              {{Role::kHipCentre, {"hip"}}, {Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"nose", "head"}}},
              with_toes, "l", "r"));
  sets.push_back(MakeSet("COCO", "coco", {{Role::kHead, {"left_ear", "right_ear"}}}, pose_limbs, "left_", "right_"));
  // Bones. A bone's position in the file is that of the joint in which the bone begins.
  sets.push_back(MakeSet("Motive's bones", "motive", {{Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"head"}}},
                         {{Role::kLeftShoulder, {"?uarm"}},
                          {Role::kLeftElbow, {"?farm"}},
                          {Role::kLeftWrist, {"?hand"}},
                          {Role::kLeftHip, {"?thigh"}},
                          {Role::kLeftKnee, {"?shin"}},
                          {Role::kLeftAnkle, {"?foot"}},
                          {Role::kLeftFoot, {"?toe"}}},
                         "l", "r"));
  sets.push_back(MakeSet("HumanIK's bones", "humanik", {{Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"head"}}},
                         {{Role::kLeftShoulder, {"?arm"}},
                          {Role::kLeftElbow, {"?forearm"}},
                          {Role::kLeftWrist, {"?hand"}},
                          {Role::kLeftHip, {"?upleg"}},
                          {Role::kLeftKnee, {"?leg"}},
                          {Role::kLeftAnkle, {"?foot"}},
                          {Role::kLeftFoot, {"?toebase"}}},
                         "left", "right"));
  // Markers on the skin.
  MarkerSet augmented = MakeSet("OpenCap's augmented markers", "opencap", {},
                                {{Role::kLeftShoulder, {"?_shoulder_study"}},
                                 {Role::kLeftElbow, {"?_lelbow_study", "?_melbow_study"}},
                                 {Role::kLeftWrist, {"?_lwrist_study", "?_mwrist_study"}},
                                 {Role::kLeftHip, {"?hjc_study"}},
                                 {Role::kLeftKnee, {"?_knee_study", "?_mknee_study"}},
                                 {Role::kLeftAnkle, {"?_ankle_study", "?_mankle_study"}},
                                 {Role::kLeftFoot, {"?_toe_study"}}},
                                "l", "r");
  augmented.pelvis = {"l.asis_study", "r.asis_study", "l.psis_study", "r.psis_study"};
  augmented.has_skin_shoulders = true;
  augmented.rank = 2;
  sets.push_back(std::move(augmented));
  MarkerSet gait = MakeSet("Plug-in Gait", "plug-in-gait",
                           {{Role::kHead, {"lfhd", "rfhd", "lbhd", "rbhd"}},
                            {Role::kShoulderCentre, {"c7", "clav"}},
                            {Role::kSpine, {"t10", "strn"}}},
                           {{Role::kLeftShoulder, {"?sho"}},
                            {Role::kLeftElbow, {"?elb"}},
                            {Role::kLeftWrist, {"?wra", "?wrb"}},
                            {Role::kLeftHand, {"?fin"}},
                            {Role::kLeftKnee, {"?kne"}},
                            {Role::kLeftAnkle, {"?ank"}},
                            {Role::kLeftFoot, {"?toe"}}},
                           "l", "r");
  gait.pelvis = {"lasi", "rasi", "lpsi", "rpsi"};
  gait.sacrum = "sacr";
  gait.has_skin_limbs = gait.has_skin_shoulders = true;
  gait.rank = 1;
  sets.push_back(std::move(gait));
  return sets;
}

}  // namespace

const std::vector<MarkerSet>& MarkerSets() {
  static const std::vector<MarkerSet> sets = MakeSets();
  return sets;
}

bool HasAll(const MarkerColumns& columns, std::span<const std::string> markers) {
  return std::ranges::all_of(markers, [&](const std::string& marker) { return columns.contains(marker); });
}

std::optional<std::array<std::string, 4>> PelvisOf(const MarkerSet& set, const MarkerColumns& columns) {
  std::array<std::string, 4> markers = set.pelvis;
  if (!set.sacrum.empty() && !HasAll(columns, markers)) markers[2] = markers[3] = set.sacrum;
  return !markers.front().empty() && HasAll(columns, markers) ? std::optional(std::move(markers)) : std::nullopt;
}

bool Determines(const MarkerSet& set, const MarkerColumns& columns, Role role) {
  if ((role == Role::kLeftHip || role == Role::kRightHip) && PelvisOf(set, columns)) return true;
  return std::ranges::any_of(
      set.rules, [&](const MarkerRule& rule) { return rule.role == role && HasAll(columns, rule.markers); });
}

std::vector<std::string> MissingFrom(const MarkerSet& set, const MarkerColumns& columns) {
  std::vector<std::string> lacks;
  for (const Role role : kNeededJoints) {
    if (!Determines(set, columns, role)) lacks.emplace_back(RoleName(role));
  }
  return lacks;
}

namespace {

/// Returns the markers that determine one knee.
std::vector<std::string> KneeMarkers(const MarkerSet& set) {
  const auto rule = std::ranges::find(set.rules, Role::kLeftKnee, &MarkerRule::role);
  return rule == set.rules.end() ? std::vector<std::string>{} : rule->markers;
}

}  // namespace

ChosenSet ChooseSet(const MarkerColumns& columns, const std::string& wanted) {
  std::vector<std::pair<const MarkerSet*, std::size_t>> complete;
  for (const MarkerSet& set : MarkerSets()) {
    if (!MissingFrom(set, columns).empty()) continue;
    const auto tells = [&](Role role) { return Determines(set, columns, role); };
    complete.emplace_back(&set, static_cast<std::size_t>(std::ranges::count_if(AllRoles(), tells)));
  }
  std::ranges::stable_sort(complete, [](const auto& a, const auto& b) {
    return std::pair(a.first->rank, a.second) > std::pair(b.first->rank, b.second);
  });
  ChosenSet chosen;
  for (const auto& [set, told] : complete) {
    if (chosen.set == nullptr && (wanted.empty() || set->key == wanted)) chosen.set = set;
  }
  for (const auto& [set, told] : complete) {
    const bool is_other = chosen.set != nullptr && KneeMarkers(*set) != KneeMarkers(*chosen.set);
    if (is_other && chosen.other == nullptr) chosen.other = set;
  }
  return chosen;
}

std::vector<std::string> MarkerSetKeys() {
  std::vector<std::string> keys;
  for (const MarkerSet& set : MarkerSets()) keys.push_back(set.key);
  return keys;
}

}  // namespace etude
