#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/keypoints/people.h"
#include "io/files/json.h"

namespace etude {

constexpr std::size_t kMaxPeople = 64;  ///< maximum number of people in one frame

/// Returns the member with this name, or null if there is none.
const Json* Member(const Json& json, const char* name);
/// Returns the first of these members that is there, or null if there is none.
const Json* FirstMember(const Json& json, std::initializer_list<const char*> names);
/// Returns a text or a number; "" or nullopt if `json` is null or something else.
std::string TextOf(const Json* json);
std::optional<double> NumberOf(const Json* json);
/// Returns the texts of a list; empty if `list` is not a list. An entry that is not a text becomes "".
std::vector<std::string> TextsOf(const Json* list);

/// The names that a file states for the keypoints of a person, in their order.
struct KeypointNames {
  KeypointNames() = default;
  /// Finds the landmarks of the names. Names that differ only in their numbers ("1", "2", …) count as not stated.
  explicit KeypointNames(std::vector<std::string> stated);

  std::vector<std::string> names;  ///< empty if the file states none
  std::vector<Landmark>
      landmarks;          ///< of each name; kNoLandmark if the name is unknown, or several names mean the same
  std::size_t known = 0;  ///< number of names with a landmark
};

/// Returns the names in the `meta_info` of MMPose's files: `keypoint_id2name` or `keypoint_name2id`.
KeypointNames NamesOfMeta(const Json& json);

/// Reads a flat list of numbers: x, y, confidence, x, …. A point counts as not seen if any of its numbers is null.
Result<std::vector<Keypoint>> Triples(const Json* list, const Place& place);

constexpr double kMaxFlag = 2;  ///< COCO's flag of a visible keypoint

/// Makes a person from an estimator's keypoints. The file's names state which keypoint is which landmark. If it states
/// none, or `layout` is not "", a layout with this number of keypoints states it. A keypoint at exactly (0, 0) or
/// (−1, −1) in the file's coordinates was not seen. Fails if none or several layouts have this number of keypoints, if
/// fewer than 12 of the names are known, or if a name contradicts the layout.
Result<SeenPerson> ToPerson(const std::vector<Keypoint>& points, const std::string& layout, const KeypointNames& names,
                            const Place& place);

/// A person's keypoints as a file lists them.
struct ListedPerson {
  std::vector<Keypoint> points;
  KeypointNames names;  ///< the names that the points themselves state
};

/// Returns true for an object that has a list of keypoints, which is not empty.
bool HasKeypoints(const Json& person);

/// Reads the keypoints of one person: a list of points, or an object that has this list as `keypoints`,
/// `pose_keypoints_2d`, `pose_keypoints`, `pose_landmarks` or `landmarks`. The points are numbers (x, y, confidence, x,
/// …); or lists [x, y] or [x, y, score], with all scores optionally in `keypoint_scores` or `scores`; or objects with
/// `x`, `y` and optionally `name`, and `visibility`, `score` or `confidence`.
Result<ListedPerson> PointsOf(const Json& person, const Place& place);

/// Reads the people of one frame, each as PointsOf reads it. `names` are the file's names. If the entries of `list` are
/// points themselves, `list` is one person. null means no people.
Result<std::vector<SeenPerson>> PeopleOfList(const Json& list, const std::string& layout, const KeypointNames& names,
                                             const Place& place);

}  // namespace etude
