#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bench/clips/open_clip.h"
#include "bench/clips/references.h"
#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// Tells whether a text begins as a recording of a run does.
bool IsRecording(std::string_view text);

/// Reads the motions of a run's recording, called as its tracks are.
Result<ClipFile> FileOfRecording(const std::string& text, const std::string& path);

/// Makes "RUN#CELL@NAME" the file of that cell's recording, and the track in it. NAME may be a method of the same
/// world: the track is "" then, for its own. CELL may leave its method out. Other references stay as they are. Fails
/// when the run recorded no such cell.
Result<SplitReference> InRun(const SplitReference& wanted);

/// The name of the track that the recorded method made.
std::string OwnTrack(const std::vector<Clip>& clips);

}  // namespace etude
