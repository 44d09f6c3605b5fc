#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/files/json.h"
#include "io/keypoints/read_people.h"

namespace etude {

constexpr std::size_t kMaxPeople = 64;  ///< maximum number of people in one frame

/// Returns the member with this name, or null if there is none.
const Json* Member(const Json& json, const char* name);
/// Returns the texts of a list; empty if `list` is no list. An entry that is no text becomes "".
std::vector<std::string> TextsOf(const Json* list);

/// Reads a flat list of numbers: x, y, confidence, x, …. A point counts as not seen if any of its numbers is null.
Result<std::vector<Keypoint>> Triples(const Json* list, const Place& place);

/// Makes a person from an estimator's keypoints. `layout` states which keypoint is which landmark. If `layout` is "",
/// the only layout with this number of keypoints is used. If none or several have this number, the landmarks are
/// found from `names`. Fails if fewer than 12 of the names are known.
Result<SeenPerson> ToPerson(const std::vector<Keypoint>& points, const std::string& layout,
                            const std::vector<std::string>& names, const Place& place);

/// Reads the people of one frame. Each entry of `list` is a person: a list of points, or an object that has this list
/// as `keypoints`, `pose_keypoints_2d`, `pose_keypoints`, `pose_landmarks` or `landmarks`. The points are numbers (x,
/// y, confidence, x, …); or lists [x, y] or [x, y, score], with all scores optionally in `keypoint_scores` or
/// `scores`; or objects with `x`, `y` and optionally `visibility`, `score` or `confidence`. If the entries of `list`
/// are such lists or objects of points themselves, `list` is one person. null means no people.
Result<std::vector<SeenPerson>> PeopleOfList(const Json& list, const std::string& layout,
                                             const std::vector<std::string>& names, const Place& place);

/// Returns true for a non-empty list, and for an object with a list `instance_info` or `frames`.
bool IsKeypointList(const Json& json);

/// Reads the keypoints of a whole film from one list. Known forms:
/// - results of COCO's evaluation and of AlphaPose: objects with `image_id` (a number, or a name whose last number
///   counts) and `keypoints`;
/// - MMPose's `instance_info`: objects with `frame_id` and `instances`, names in `meta_info`;
/// - frames in order, as users of MediaPipe save them: objects with `pose_landmarks`, `landmarks`, `keypoints`,
///   `people` or `instances`, or bare lists of people or of points; null means no people.
/// Frame numbers count from 1 if no number is 0 and the film's number of frames is unknown or equals the last number;
/// otherwise they count from 0. If frames have no numbers but all have a time (`timestamp`, `timestamp_ms`, `time`, …),
/// and the film's number of frames differs from the list's, the frame numbers are computed from the times, whose unit
/// does not matter. `told` says if frames are missing.
Result<PeopleOfFilm> ReadKeypointList(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                                      const Place& place);

/// Moves the frames of a film, one per file name, to the positions that the numbers at the ends of the names state.
/// Inserts a frame without people for each missing number, and `told` says so. Leaves the frames as they are if the
/// names do not begin with the same text, if the numbers do not ascend or differ by fractions of their median step,
/// if the film has as many frames as there are names, if frames are missing only at the end, or if the last position
/// would be at least `of.frames` plus ten times the number of names.
void LayByNames(std::span<const std::string> names, const FilmOfKeypoints& of, PeopleOfFilm& film);

}  // namespace etude
