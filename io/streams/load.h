#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/streams/labels.h"
#include "engine/streams/stream_maker.h"
#include "engine/teaching/labelled_streams.h"
#include "io/clips/clip_library.h"

namespace etude {

/// Reads one recording or clip. A clip ("builtin:clap", a cell's motion in a run, or any motion file that is not a
/// recording of a sensor) is converted to the recording of an error-free sensor. `clips` gives the options for opening
/// clips.
Result<std::vector<NamedStream>> LoadStream(const std::string& reference, const StreamReading& reading,
                                            const StreamOptions& options, const OpenOptions& clips = {});

/// Converts clips to the recordings of an error-free sensor.
std::vector<NamedStream> StreamsOf(const ClipLibrary& library);

/// The recordings of files, patterns and folders; a folder's recordings include the recordings of its subfolders and
/// are sorted by path.
struct LoadedStreams {
  std::vector<NamedStream> streams;
  /// Files of folders and patterns that could not be read; a file that is named directly makes the load fail.
  std::vector<Error> refused;
  int passed_over = 0;  ///< number of files, found in folders, that are not recordings
};
/// Loads recordings. Fails if there are none, if `clips` gives a joint map or a unit but no reference is a clip,
/// and if it gives an axis but no reference is a clip or a recording whose format states the axis (CSV, TRC).
Result<LoadedStreams> LoadStreams(const std::vector<std::string>& references, const StreamReading& reading,
                                  const StreamOptions& options, const OpenOptions& clips = {});

/// Returns the files of labels at a path: the path itself or, if the path names a folder, all MSRC-12 tag streams in
/// this folder.
Result<std::vector<std::string>> LabelFiles(const std::string& path);
/// Loads the labels of all files that LabelFiles returns.
Result<std::vector<Label>> LoadLabels(const std::string& path);

}  // namespace etude
