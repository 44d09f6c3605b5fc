#pragma once

#include <string>

#include "io/files/json.h"
#include "io/keypoints/read_people.h"

namespace etude {

/// Returns true for a non-empty list, for an object with a list `instance_info` or `frames`, and for AlphaPose's
/// formats `open` and `cmu`.
bool IsKeypointList(const Json& json);

/// Reads the keypoints of a whole film from one list. Known forms:
/// - results of COCO's evaluation and of AlphaPose: objects with `image_id` (a number, or a name whose last number
///   counts) and `keypoints`; objects without `keypoints` are left out, and `told` says so;
/// - AlphaPose's formats `open` and `cmu`: one object whose keys are the names of the images;
/// - MMPose's `instance_info`: objects with `frame_id` and `instances`, names in `meta_info`;
/// - frames in order, as users of MediaPipe save them: objects with `pose_landmarks`, `landmarks`, `keypoints`,
///   `people` or `instances`, or bare lists of people or of points; null means no people.
/// Objects with the same frame number are people of one frame. FilmOfNumbers states what the numbers mean. If frames
/// have no numbers but all have a time (`timestamp`, `timestamp_ms`, `time`, …), and the film's number of frames
/// differs from the list's, LayByTimes computes the frame numbers. Without numbers and times, the film gets as many
/// frames as the list has. Fails if only some of the objects have a frame number.
Result<PeopleOfFilm> ReadKeypointList(const Json& json, const std::string& layout, const FilmOfKeypoints& of,
                                      const Place& place);

}  // namespace etude
