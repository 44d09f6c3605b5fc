#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A rule for a joint's position: the mean of some markers, all of which must be present.
struct MarkerRule {
  Role role;
  std::vector<std::string> markers;
  bool is_joint = false;  ///< true: the user takes them as the joint, also in a set of skin markers
};

/// A convention of marker names, in lower case.
struct MarkerSet {
  std::string name;
  std::string key;  ///< the value of --marker-set that selects this set
  std::vector<MarkerRule> rules;
  std::array<std::string, 4> pelvis = {};  ///< markers of the pelvis: left and right front, left and right back; the
                                           ///< hips are computed from these markers
  std::string sacrum = "";                 ///< the marker that may replace the two markers on the back of the pelvis
  /// True if the marker of a knee, ankle or elbow that has only one marker is on the skin. Further markers on thighs
  /// and shanks (wands) then show the planes in which the limbs bend.
  bool has_skin_limbs = false;
  bool has_skin_shoulders = false;  ///< true if each shoulder has one marker, on top of it
  bool is_own = false;              ///< true for Etude's joints: Y is up, and the floor may be kept
  std::array<std::string, 4> wands = {};  ///< markers beside left and right thigh, left and right shank; "" = none
  int rank = 0;                     ///< if a person has several sets, the set with the highest rank is used
};

/// Lists the supported conventions.
const std::vector<MarkerSet>& MarkerSets();

/// Lists the names of all sets, as text for users.
std::string NamesOfMarkerSets();

/// Lists the keys of all sets.
std::vector<std::string> MarkerSetKeys();

/// Maps each marker's name, in lower case without prefix, to its column, for one person.
using MarkerColumns = std::map<std::string, std::size_t, std::less<>>;
/// Returns a marker's name in lower case and without prefix.
std::string MarkerKey(std::string_view name);

/// The joints that a body needs.
inline constexpr std::array kNeededJoints = {Role::kLeftShoulder,  Role::kLeftElbow,  Role::kLeftWrist,
                                             Role::kRightShoulder, Role::kRightElbow, Role::kRightWrist,
                                             Role::kLeftHip,       Role::kLeftKnee,   Role::kLeftAnkle,
                                             Role::kRightHip,      Role::kRightKnee,  Role::kRightAnkle};

/// Returns true if a person has all of these markers.
bool HasAll(const MarkerColumns& columns, std::span<const std::string> markers);
/// Returns the names of the pelvis's four markers. If the marker on the sacrum replaces the two markers on the back,
/// its name appears twice. Returns nullopt if markers are missing.
std::optional<std::array<std::string, 4>> PelvisOf(const MarkerSet& set, const MarkerColumns& columns);
/// Lists the markers that determine a joint, by their keys; empty if none do.
std::vector<std::string> MarkersOfRole(const MarkerSet& set, const MarkerColumns& columns, Role role);
/// Returns true if the joint's marker lies on the skin, and the joint under it.
bool LiesUnderSkin(const MarkerSet& set, Role role);
/// Returns true if the set determines a joint from a person's markers.
bool Determines(const MarkerSet& set, const MarkerColumns& columns, Role role);
/// Lists the needed joints that the set does not determine.
std::vector<std::string> MissingFrom(const MarkerSet& set, const MarkerColumns& columns);

/// The set by which one person's markers are read.
struct ChosenSet {
  std::optional<MarkerSet> made = {};  ///< a set made for this person
  const MarkerSet* known = nullptr;    ///< otherwise one of MarkerSets
  const MarkerSet* other = nullptr;    ///< the best other complete set whose knee markers differ; null if none
  const MarkerSet* set() const { return made ? &*made : known; }  ///< null if there is none
};
/// Chooses one of the sets that are complete. If the user wants a set, `wanted` is the set's key, and only that set is
/// chosen. If `wanted` is "", chooses the set with the highest rank; of equal ranks, the set that determines the most
/// joints. If no set is complete, or only a set of joints that lacks some of its names, makes the set of skin markers
/// (SetOfSkinNames; it may be incomplete). If the names do not show skin markers either, makes a set if a naming scheme
/// of skeletons (joint_names.h) names all needed joints, and more joints than the chosen set determines.
/// Markers with the names of Etude's own joints keep their meaning: their set is then chosen, although it is
/// incomplete. If the names are those of a data set (FindDataSet), its joints replace the rules of the chosen set,
/// unless the user wants a set or the set is of markers on the skin. `roles` states which markers the user takes as
/// joints. They replace the set's rules for the same joints; if there is no set, they form a set of their own, which
/// may be incomplete. `names` are the file's names of all columns.
ChosenSet ChooseSet(const MarkerColumns& columns, std::span<const std::string> names, const std::string& wanted,
                    const std::map<Role, std::string>& roles);

}  // namespace etude
