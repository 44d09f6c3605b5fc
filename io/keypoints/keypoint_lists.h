#pragma once

#include <string>
#include <vector>

#include "io/files/json.h"
#include "io/keypoints/read_people.h"

namespace etude {

constexpr std::size_t kMostPeople = 64;  ///< in a frame

/// Returns the member of that name, or null where there is none.
const Json* Member(const Json& json, const char* name);
/// Returns the texts of a list; of anything else none.
std::vector<std::string> TextsOf(const Json* list);

/// Reads the triples x, y, confidence of a list; a point with a null was not seen.
Result<std::vector<Keypoint>> Triples(const Json* list, const Place& place);

/// Makes a person of the keypoints of an estimator, in the order of `layout`, else of the only layout of their count,
/// else of the `names` that the file gives them.
Result<SeenPerson> ToPerson(const std::vector<Keypoint>& points, const std::string& layout,
                            const std::vector<std::string>& names, const Place& place);

/// Reads the people of one frame from a list of objects, each with `keypoints` as triples or pairs, or as [x, y] each,
/// and `keypoint_scores`, `scores` or none; or a list of points with `x`, `y` and `visibility` or `score`, which is one
/// person.
Result<std::vector<SeenPerson>> PeopleOfList(const Json& list, const std::string& layout,
                                             const std::vector<std::string>& names, const Place& place);

/// True for a list that is not empty, or an object with a list `instance_info` or `frames`.
bool IsKeypointList(const Json& json);

/// Reads the keypoints of a whole film from one list:
/// - results as COCO's evaluation and AlphaPose have them: objects with `image_id` (a number, or a name with one) and
///   `keypoints`;
/// - MMPose's `instance_info`: objects with `frame_id` and `instances`, names in `meta_info`;
/// - frames in their order: objects with `pose_landmarks`, `landmarks`, `keypoints`, `people` or `instances`, or bare
/// lists
///   of people or of points, as MediaPipe's users save them; null: nobody.
/// Numbers count from 0 where there is one, else from 1 where the last frame's is the film's count.
Result<PeopleOfFilm> ReadKeypointList(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                                      const Place& place);

}  // namespace etude
