#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/clip.h"
#include "io/clips/references.h"

namespace etude {

struct ClipFile;
struct OpenOptions;

/// Reads motions that runs recorded. Runs belong to layers above this folder, so the caller that opens clips passes an
/// implementation (`OpenOptions::recorded`); `bench/run/recorded_motions.h` provides this implementation.
class RecordedMotions {
 public:
  virtual ~RecordedMotions() = default;

  /// Replaces "RUN#CELL@NAME" by the file of the cell's recording and the name of the track in this file. An empty
  /// track name stands for the motion of the recorded method (`OwnTrack`). Returns any other reference unchanged. Fails
  /// if the run did not record this cell.
  virtual Result<SplitReference> Find(const SplitReference& wanted) const = 0;

  /// Returns true if a file's text begins like a recording.
  virtual bool IsRecording(std::string_view text) const = 0;

  /// Reads the motions of a recording; each clip gets the name of its track. Error messages name the file `path`. A
  /// motion whose joints are not the twenty roles is read as markers, with `options`.
  virtual Result<ClipFile> Read(const std::string& text, const std::string& path, const OpenOptions& options) const = 0;

  /// Returns the name of the track that holds the motion of the recorded cell's method. `clips` are all tracks of the
  /// recording.
  virtual std::string OwnTrack(const std::vector<Clip>& clips) const = 0;
};

}  // namespace etude
