#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A joint as the mean of some markers, all of which must be present.
struct MarkerRule {
  Role role;
  std::vector<std::string> markers;
};

/// A convention of marker names, in lower case.
struct MarkerSet {
  std::string name;
  std::string key;  ///< what --marker-set calls it
  std::vector<MarkerRule> rules;
  std::array<std::string, 4> pelvis = {};  ///< left and right front, left and right back; the hips follow from them
  std::string sacrum = "";                 ///< the marker midway between those of the back, instead of both
  /// Knees, ankles and elbows have one marker each, on the skin; further markers on thighs and shanks (wands) show the
  /// planes in which the limbs bend.
  bool has_skin_limbs = false;
  bool has_skin_shoulders = false;  ///< likewise shoulders, on top
  int rank = 0;                     ///< if a file contains several sets, the one of the highest rank is used
};

/// Lists the supported conventions.
const std::vector<MarkerSet>& MarkerSets();

/// Lists their keys.
std::vector<std::string> MarkerSetKeys();

/// The columns of one person's markers, by their names in lower case without prefix.
using MarkerColumns = std::map<std::string, std::size_t, std::less<>>;

/// The joints without which there is no body.
inline constexpr std::array kNeededJoints = {Role::kLeftShoulder, Role::kLeftElbow,  Role::kLeftWrist, Role::kRightShoulder,
                                Role::kRightElbow,   Role::kRightWrist, Role::kLeftHip,   Role::kLeftKnee,
                                Role::kLeftAnkle,    Role::kRightHip,   Role::kRightKnee, Role::kRightAnkle};

/// Returns true if a person's markers hold all of these.
bool HasAll(const MarkerColumns& columns, std::span<const std::string> markers);
/// Returns the markers of the pelvis, the sacrum's twice if it stands for the back; nullopt if some are missing.
std::optional<std::array<std::string, 4>> PelvisOf(const MarkerSet& set, const MarkerColumns& columns);
/// Returns true if the set determines a joint from a person's markers.
bool Determines(const MarkerSet& set, const MarkerColumns& columns, Role role);
/// Lists the needed joints that the set does not determine.
std::vector<std::string> MissingFrom(const MarkerSet& set, const MarkerColumns& columns);

/// The set used for one person, and a second one that the file also contains.
struct ChosenSet {
  const MarkerSet* set = nullptr;
  const MarkerSet* other = nullptr;
};
/// Chooses among the complete sets (the wanted one, if a key is given) by rank, then by the number of joints that they
/// determine. Null if there is none.
ChosenSet ChooseSet(const MarkerColumns& columns, const std::string& wanted);

}  // namespace etude
