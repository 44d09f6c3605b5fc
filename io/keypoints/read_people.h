#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/keypoints/people.h"

namespace etude {

/// The people of one film, found by an estimator or marked by a person.
struct PeopleOfFilm {
  SeenPeople frames;
  int width = 0, height = 0;  ///< size of the pictures, pixels; 0 if the files do not state it
  std::string told;           ///< a note about assumptions that were made, "" if none
  std::string doubt;          ///< the reason why `layout` seems to be wrong, "" if none
  double score_scale = 1;     ///< the scores in the files were divided by this number
  bool is_from_one = false;   ///< true if frame numbers certainly count from 1
  bool is_base_open = false;  ///< true if frame numbers may count from 0 or from 1; they were taken as `from_one` says

  /// Adds a note to `told`.
  void Tell(const std::string& note) { told += (told.empty() ? "" : "; ") + note; }
};

/// The film that keypoints belong to. A zero means that the value is not known.
struct FilmOfKeypoints {
  int width = 0, height = 0;
  std::size_t frames = 0;
  bool from_one = false;  ///< frame numbers count from 1 if they may count from 0 or from 1
  double score_scale = 0;  ///< the number by which scores above 1 are divided; 0: their third quartile in the film
};

/// Reads keypoints from a folder of OpenPose's or MMPose's JSON (`*.json`, one file per frame, ordered by name with
/// numbers compared by value) or from one file of COCO annotations (`coco_file.h`), COCO results, AlphaPose, MMPose, or
/// MediaPipe's landmarks (`keypoint_lists.h`). In these files pixel centres are whole numbers; in the result they end
/// in .5. COCO's v is 2 for a visible and 1 for a hidden keypoint (confidence 1 and 0.5), or a score. Scores above 1,
/// such as percentages, are divided by `film.score_scale`, and `told` says so. A keypoint at exactly (0,
/// 0) or (−1, −1) was not seen. If most confident keypoints lie within ±1.1 and the film is known to be larger,
/// coordinates are taken as shares of the film's width and height; if moreover more than a tenth of them are negative,
/// as coordinates of −1…1 (OpenPose's --keypoint_scale 4); `told` says so. The names in the file, or without names the
/// number of keypoints, determine which keypoint is which landmark. 25 keypoints are taken as `body_25` if the mid-hip
/// lies between the hips, and `told` says so; `doubt` says if the position of the mid-hip contradicts a `layout` of 25
/// keypoints. Fails if there are no frames or if numbers are not finite. With an empty `layout`, also fails if neither
/// the names nor the number of keypoints determine the landmarks. The error states the file, what was found, and what
/// is allowed.
/// @param layout a name of KeypointLayouts(), or "" to choose it by the names or the number of keypoints
/// @param film the film's size and number of frames, as far as they are known: files may list only frames with people
Result<PeopleOfFilm> ReadKeypoints(const std::filesystem::path& path, const std::string& layout,
                                   const FilmOfKeypoints& film = {});

/// Returns the one scale of films whose scores seem to be of one estimator: the largest scale of all films. Returns 0
/// for a film whose scale stays as it is: it is the largest, its scores do not exceed 1, or its scale is less than a
/// quarter of the largest, as another estimator's may be.
/// @param scale the film's scale
double SharedScoreScale(double scale, std::span<const PeopleOfFilm> films);

/// Reads annotation pictures (`ReadMarks`): PNG files in the order of their names, one per frame, with at most one
/// person each. Fails if the sizes of the pictures differ.
Result<PeopleOfFilm> ReadMarkedPictures(const std::filesystem::path& folder);

/// Finds the one entry of a folder that belongs to a film: its name is the film's name, alone or followed by a
/// character that is neither letter nor digit ("cam01", "cam01_json", "cam01.json"), perhaps after "results_". Fails if
/// the folder has no such entry, or more than one.
Result<std::filesystem::path> EntryOfFilm(const std::filesystem::path& folder, const std::string& film);

}  // namespace etude
