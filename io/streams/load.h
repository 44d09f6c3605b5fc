#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/streams/labels.h"
#include "engine/streams/stream_maker.h"
#include "engine/teaching/labelled_streams.h"
#include "io/clips/clip_library.h"

namespace etude {

/// Reads one recording or clip ("builtin:clap", a cell's motion in a run, any file that is a clip and no recording of
/// a sensor: what a sensor without errors would say of it). `clips` tells how clips are opened.
Result<std::vector<NamedStream>> LoadStream(const std::string& reference, const StreamReading& reading,
                                            const StreamOptions& options, const OpenOptions& clips = {});

/// Makes recordings of clips, as a sensor without errors would.
std::vector<NamedStream> StreamsOf(const ClipLibrary& library);

/// The recordings of files, patterns and folders (with all below, sorted).
struct LoadedStreams {
  std::vector<NamedStream> streams;
  std::vector<Error> refused;  ///< files of folders and patterns that could not be read; those named alone fail
  int passed_over = 0;         ///< files of folders that are no recordings
};
/// Loads recordings; fails when there is none, and when `clips` tells a joint map, a unit or an axis of what are no
/// clips.
Result<LoadedStreams> LoadStreams(const std::vector<std::string>& references, const StreamReading& reading,
                                  const StreamOptions& options, const OpenOptions& clips = {});

/// Returns the files of labels that a path means: itself, or, of a folder, all tag streams in it.
Result<std::vector<std::string>> LabelFiles(const std::string& path);
/// Loads the labels of a file, or of all tag streams of a folder.
Result<std::vector<Label>> LoadLabels(const std::string& path);

}  // namespace etude
