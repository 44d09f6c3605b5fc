#include "engine/retargeting/marker_sets.h"

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

MarkerSet MakeSet(std::string name, std::vector<MarkerRule> middle, const LimbMarkers& limbs, std::string_view left,
                  std::string_view right) {
  MarkerSet set{.name = std::move(name), .rules = std::move(middle)};
  for (const auto& [role, markers] : limbs) AddSides(set.rules, role, markers, left, right);
  return set;
}

// Joints and keypoints first, then bones, then markers on the skin.
std::vector<MarkerSet> MakeSets() {
  std::vector<MarkerSet> sets;
  MarkerSet own{.name = "Etude's joints", .rules = {}};
  for (const Role role : AllRoles()) own.rules.push_back({role, {std::string(RoleName(role))}});
  sets.push_back(std::move(own));
  const LimbMarkers pose_limbs = {{Role::kLeftShoulder, {"?shoulder"}}, {Role::kLeftElbow, {"?elbow"}},
                                  {Role::kLeftWrist, {"?wrist"}},       {Role::kLeftHip, {"?hip"}},
                                  {Role::kLeftKnee, {"?knee"}},         {Role::kLeftAnkle, {"?ankle"}}};
  LimbMarkers with_toes = pose_limbs;
  with_toes.push_back({Role::kLeftFoot, {"?bigtoe"}});
  sets.push_back(
      MakeSet("OpenPose BODY_25",
              {{Role::kHipCentre, {"midhip"}}, {Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"lear", "rear"}}},
              with_toes, "l", "r"));
  sets.push_back(MakeSet(
      "HALPE_26", {{Role::kHipCentre, {"hip"}}, {Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"nose", "head"}}},
      with_toes, "l", "r"));
  sets.push_back(MakeSet("COCO", {{Role::kHead, {"left_ear", "right_ear"}}}, pose_limbs, "left_", "right_"));
  sets.push_back(MakeSet("Motive's bones", {{Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"head"}}},
                         {{Role::kLeftShoulder, {"?uarm"}},
                          {Role::kLeftElbow, {"?farm"}},
                          {Role::kLeftWrist, {"?hand"}},
                          {Role::kLeftHip, {"?thigh"}},
                          {Role::kLeftKnee, {"?shin"}},
                          {Role::kLeftAnkle, {"?foot"}},
                          {Role::kLeftFoot, {"?toe"}}},
                         "l", "r"));
  sets.push_back(MakeSet("HumanIK's bones", {{Role::kShoulderCentre, {"neck"}}, {Role::kHead, {"head"}}},
                         {{Role::kLeftShoulder, {"?arm"}},
                          {Role::kLeftElbow, {"?forearm"}},
                          {Role::kLeftWrist, {"?hand"}},
                          {Role::kLeftHip, {"?upleg"}},
                          {Role::kLeftKnee, {"?leg"}},
                          {Role::kLeftAnkle, {"?foot"}},
                          {Role::kLeftFoot, {"?toebase"}}},
                         "left", "right"));
  MarkerSet augmented = MakeSet("OpenCap's augmented markers", {},
                                {{Role::kLeftShoulder, {"?_shoulder_study"}},
                                 {Role::kLeftElbow, {"?_lelbow_study", "?_melbow_study"}},
                                 {Role::kLeftWrist, {"?_lwrist_study", "?_mwrist_study"}},
                                 {Role::kLeftHip, {"?hjc_study"}},
                                 {Role::kLeftKnee, {"?_knee_study", "?_mknee_study"}},
                                 {Role::kLeftAnkle, {"?_ankle_study", "?_mankle_study"}},
                                 {Role::kLeftFoot, {"?_toe_study"}}},
                                "l", "r");
  augmented.pelvis = {"l.asis_study", "r.asis_study", "l.psis_study", "r.psis_study"};
  sets.push_back(std::move(augmented));
  MarkerSet gait = MakeSet("Plug-in Gait",
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
  gait.is_gait = true;
  sets.push_back(std::move(gait));
  return sets;
}

}  // namespace

const std::vector<MarkerSet>& MarkerSets() {
  static const std::vector<MarkerSet> sets = MakeSets();
  return sets;
}

}  // namespace etude
