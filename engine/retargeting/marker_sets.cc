#include "engine/retargeting/marker_sets.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/retargeting/data_set_names.h"
#include "engine/retargeting/limb_finder.h"
#include "engine/retargeting/skin_names.h"

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
  MarkerSet own{.name = "Etude's joints", .key = "etude", .rules = {}, .is_own = true, .rank = 3};
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
                            {Role::kLeftWrist, {"?wri"}},
                            {Role::kLeftHand, {"?fin"}},
                            {Role::kLeftKnee, {"?kne"}},
                            {Role::kLeftAnkle, {"?ank"}},
                            {Role::kLeftFoot, {"?toe"}}},
                           "l", "r");
  gait.pelvis = {"lasi", "rasi", "lpsi", "rpsi"};
  gait.sacrum = "sacr";
  gait.wands = {"lthi", "rthi", "ltib", "rtib"};
  gait.has_skin_limbs = gait.has_skin_shoulders = true;
  gait.rank = 1;
  sets.push_back(gait);
  // The same markers under the names of CMU's recordings.
  MarkerSet waist = std::move(gait);
  waist.name = "Plug-in Gait with CMU's waist";
  waist.key = "cmu";
  waist.pelvis = {"lfwt", "rfwt", "lbwt", "rbwt"};
  waist.wands = {"lthi", "rthi", "lshn", "rshn"};
  sets.push_back(std::move(waist));
  return sets;
}

/// Returns the markers that determine one knee.
std::vector<std::string> KneeMarkers(const MarkerSet& set) {
  const auto rule = std::ranges::find(set.rules, Role::kLeftKnee, &MarkerRule::role);
  return rule == set.rules.end() ? std::vector<std::string>{} : rule->markers;
}

/// Returns true if the markers are Etude's own joints, some of which may be missing: ten or more of their names, with
/// one that no other set has.
bool AreOwnJoints(const MarkerColumns& columns) {
  constexpr std::ptrdiff_t kMinNames = 10;
  const auto has = [&](Role role) { return columns.contains(RoleName(role)); };
  return (has(Role::kHipCentre) || has(Role::kShoulderCentre)) && std::ranges::count_if(AllRoles(), has) >= kMinNames;
}

/// Chooses among MarkerSets. Other programs also write names such as "left_hip", so Etude's set is only chosen if the
/// user wants it, or if AreOwnJoints is true.
ChosenSet ChooseKnown(const MarkerColumns& columns, const std::string& wanted) {
  std::vector<std::pair<const MarkerSet*, std::size_t>> complete;
  for (const MarkerSet& set : MarkerSets()) {
    if (!MissingFrom(set, columns).empty()) continue;
    if (set.is_own && wanted != set.key && !AreOwnJoints(columns)) continue;
    const auto tells = [&](Role role) { return Determines(set, columns, role); };
    complete.emplace_back(&set, static_cast<std::size_t>(std::ranges::count_if(AllRoles(), tells)));
  }
  std::ranges::stable_sort(complete, [](const auto& a, const auto& b) {
    return std::pair(a.first->rank, a.second) > std::pair(b.first->rank, b.second);
  });
  ChosenSet chosen;
  for (const auto& [set, told] : complete) {
    if (chosen.known == nullptr && (wanted.empty() || set->key == wanted)) chosen.known = set;
  }
  for (const auto& [set, told] : complete) {
    const bool is_other = chosen.known != nullptr && KneeMarkers(*set) != KneeMarkers(*chosen.known);
    if (is_other && chosen.other == nullptr) chosen.other = set;
  }
  return chosen;
}

/// Makes a marker set if the markers are named like the joints of a skeleton; nullopt if a needed joint has no marker.
std::optional<MarkerSet> SetOfSkeletonNames(const MarkerColumns& columns, std::span<const std::string> names) {
  // Markers have no parents and form no chains. FindLimb therefore takes the first scheme that names all joints of a
  // limb.
  Skeleton points;
  std::vector<std::string> keys;
  for (const auto& [key, column] : columns) {
    points.joints.push_back({.name = names[column], .rest = {}});
    keys.push_back(key);
  }
  const JointNames known(points);
  const SkeletonTree tree(points);
  MarkerSet set{.name = "joint names of a skeleton", .key = "", .rules = {}};
  for (const Limb& limb : kLimbs) {
    const FoundLimb found = FindLimb(known, tree, limb.is_arm ? ArmSchemes() : LegSchemes(), limb.side, {-1, -1, -1});
    for (std::size_t i = 0; i < limb.roles.size(); ++i) {
      if (found.joints[i] < 0) return std::nullopt;
      set.rules.push_back({limb.roles[i], {keys[static_cast<std::size_t>(found.joints[i])]}});
    }
  }
  // Add the other joints whose names are clear: only one marker has the name, and it is in no limb.
  const auto add = [&](Role role, std::span<const std::string_view> words, std::optional<Side> side) {
    for (const std::string_view word : words) {
      const std::vector<NamedJoint> found = side ? known.Find(word, *side) : known.Find(word);
      if (found.empty()) continue;
      const std::vector<std::string> marker{keys[static_cast<std::size_t>(found.front().joint)]};
      if (found.size() == 1 && std::ranges::count(set.rules, marker, &MarkerRule::markers) == 0) {
        set.rules.push_back({role, marker});
        return;
      }
    }
  };
  constexpr std::string_view kPelvis[] = {"hips", "pelvis", "hip", "waist"}, kHand[] = {"hand"},
                             kToes[] = {"toe", "toes", "toebase", "bigtoe", "ball", "foot"};
  add(Role::kHipCentre, kPelvis, std::nullopt);
  add(Role::kShoulderCentre, NeckNames(), std::nullopt);
  add(Role::kHead, HeadNames(), std::nullopt);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const bool is_left = side == Side::kLeft;
    add(is_left ? Role::kLeftFoot : Role::kRightFoot, kToes, side);
    add(is_left ? Role::kLeftHand : Role::kRightHand, kHand, side);
  }
  return set;
}

bool HasEveryName(const MarkerSet& set, const MarkerColumns& columns) {
  return std::ranges::all_of(set.rules, [&](const MarkerRule& rule) { return HasAll(columns, rule.markers); });
}

void ReplaceRule(const MarkerRule& rule, MarkerSet& set) {
  std::erase_if(set.rules, [&](const MarkerRule& old) { return old.role == rule.role; });
  set.rules.push_back(rule);
}

/// If the names are those of a data set, replaces the chosen set's rules for the joints that the data set has.
void TakeJointsOfDataSet(const MarkerColumns& columns, std::span<const std::string> names, ChosenSet& chosen) {
  if (chosen.set() == nullptr || !chosen.set()->pelvis.front().empty()) return;
  std::vector<std::string> keys, points;
  for (const auto& [key, column] : columns) {
    keys.push_back(key);
    points.push_back(names[column]);
  }
  const auto known = FindDataSet(points);
  if (!known) return;
  MarkerSet set = *chosen.set();
  bool is_changed = false;
  for (const KnownJoint& one : known->joints) {
    const auto role = FindRole(one.joint);
    if (!role) continue;
    MarkerRule rule{*role, {}};
    for (const std::size_t point : one.points) rule.markers.push_back(keys[point]);
    const auto is_it = [&](const MarkerRule& old) { return old.role == rule.role && old.markers == rule.markers; };
    if (std::ranges::any_of(set.rules, is_it)) continue;
    ReplaceRule(rule, set);
    is_changed = true;
  }
  if (!is_changed) return;
  set.name = fmt::format("joints of {}, found by name", known->data_set);
  set.is_own = false;
  chosen.made = std::move(set);
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

std::vector<std::string> MarkersOfRole(const MarkerSet& set, const MarkerColumns& columns, Role role) {
  for (const MarkerRule& rule : set.rules) {
    if (rule.role == role && HasAll(columns, rule.markers)) return rule.markers;
  }
  if (role != Role::kLeftHip && role != Role::kRightHip) return {};
  const auto pelvis = PelvisOf(set, columns);
  if (!pelvis) return {};
  std::vector<std::string> markers(pelvis->begin(), pelvis->end());
  markers.erase(std::ranges::unique(markers).begin(), markers.end());
  return markers;
}

bool LiesUnderSkin(const MarkerSet& set, Role role) {
  const bool is_shoulder = role == Role::kLeftShoulder || role == Role::kRightShoulder;
  const auto is_single = [&](const MarkerRule& rule) {
    return rule.role == role && rule.markers.size() == 1 && !rule.is_joint;
  };
  return (is_shoulder ? set.has_skin_shoulders : set.has_skin_limbs) && std::ranges::any_of(set.rules, is_single);
}

bool Determines(const MarkerSet& set, const MarkerColumns& columns, Role role) {
  return !MarkersOfRole(set, columns, role).empty();
}

std::vector<std::string> MissingFrom(const MarkerSet& set, const MarkerColumns& columns) {
  std::vector<std::string> lacks;
  for (const Role role : kNeededJoints) {
    if (!Determines(set, columns, role)) lacks.emplace_back(RoleName(role));
  }
  return lacks;
}

ChosenSet ChooseSet(const MarkerColumns& columns, std::span<const std::string> names, const std::string& wanted,
                    const std::map<Role, std::string>& roles) {
  ChosenSet chosen = ChooseKnown(columns, wanted);
  // Some sets of joints have names ("RHip") that are also given to skin markers, but not all names of the set.
  const bool may_be_skin = chosen.known != nullptr && chosen.known->rank == 0 && !HasEveryName(*chosen.known, columns);
  if ((chosen.known == nullptr || may_be_skin) && wanted.empty()) {
    // If a column is missing, another scheme would take Etude's names for other joints: "left_hand" for the wrist.
    if (AreOwnJoints(columns)) {
      chosen.known = &MarkerSets().front();
    } else {
      const auto count_of = [&](const MarkerSet& set) {
        return std::ranges::count_if(AllRoles(), [&](Role role) { return Determines(set, columns, role); });
      };
      chosen.made = SetOfSkinNames(columns, names);
      if (!chosen.made) chosen.made = SetOfSkeletonNames(columns, names);
      const bool is_made = chosen.made && !chosen.made->has_skin_limbs;
      if (is_made && may_be_skin && count_of(*chosen.made) <= count_of(*chosen.known)) chosen.made.reset();
    }
  }
  if (wanted.empty()) TakeJointsOfDataSet(columns, names, chosen);
  std::vector<MarkerRule> told;
  for (const auto& [role, marker] : roles) {
    if (const auto found = columns.find(MarkerKey(marker)); found != columns.end())
      told.push_back({role, {found->first}, chosen.made.has_value()});
  }
  if (told.empty()) return chosen;
  const MarkerSet* base = chosen.set();
  MarkerSet set = base == nullptr ? MarkerSet{.name = "the joint map", .key = "", .rules = {}} : *base;
  if (base != nullptr) set.name = "the joint map, and " + base->name;
  set.is_own = false;
  for (const MarkerRule& rule : told) ReplaceRule(rule, set);
  chosen.made = std::move(set);
  return chosen;
}

std::string MarkerKey(std::string_view name) { return InLowerCase(std::string(name.substr(name.rfind(':') + 1))); }

std::string NamesOfMarkerSets() {
  std::vector<std::string> names;
  for (const MarkerSet& set : MarkerSets()) names.push_back(set.name);
  return Join(names);
}

std::vector<std::string> MarkerSetKeys() {
  std::vector<std::string> keys;
  for (const MarkerSet& set : MarkerSets()) keys.push_back(set.key);
  return keys;
}

}  // namespace etude
