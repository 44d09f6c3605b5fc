#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/keypoints/people.h"

namespace etude {

/// The persons of one film, as found or marked.
struct PeopleOfFilm {
  SeenPeople frames;
  int width = 0, height = 0;  ///< of the pictures they were found in; 0: the files do not tell
  std::string told;           ///< what was assumed of them, "" = nothing
};

/// The film whose keypoints they are. Zero: not known.
struct FilmOfKeypoints {
  int width = 0, height = 0;
  std::size_t frames = 0;
};

/// Reads keypoints from a folder of OpenPose's or MMPose's JSON (`*.json`, a file a frame in the order of their names,
/// numbers in them by their value) or from one file: COCO's, a list of COCO results, AlphaPose, MMPose, or landmarks of
/// MediaPipe's kind (`keypoint_lists.h`). Pixels of files have their centres at whole numbers, ours at halves. COCO's v
/// is 2 for a visible and 1 for a hidden keypoint (confidence 1 and 0.5), or a score within 0…1. Keypoints that all lie
/// within a tenth of 0…1, of a film known to be larger, are shares of its width and height, and `told` says so. The
/// order is told by the count, or by the names that a file gives. Fails with the file, what was found and what is
/// allowed: no frames, numbers that are not finite, a count of keypoints that no layout has, or two (25), when `layout`
/// is empty.
/// @param layout a name of KeypointLayouts(), or "": told by the count
/// @param film tells how many frames there are where a file lists only those that show somebody
Result<PeopleOfFilm> ReadKeypoints(const std::filesystem::path& path, const std::string& layout,
                                   const FilmOfKeypoints& film = {});

/// Reads annotation pictures (`ReadMarks`): PNG files in the order of their names, one a frame, at most one person
/// each.
Result<PeopleOfFilm> ReadMarkedPictures(const std::filesystem::path& folder);

/// Finds the one entry of a folder that belongs to the film of that name: its name is the film's, or begins with it and
/// goes on with no letter or digit ("cam01", "cam01_json", "cam01.json"). Fails when there is none or are several.
Result<std::filesystem::path> EntryOfFilm(const std::filesystem::path& folder, const std::string& film);

}  // namespace etude
