#pragma once

#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/tags_file/tags_file.h"
#include "io/clips/open_clip.h"

namespace etude {

/// What a library of clips is made of, and the rules by which its frames are tagged and matched.
struct BridgeLibraryOptions {
  std::vector<std::string> clips;  ///< references; each clip counts once
  std::vector<std::string> to;     ///< the corrective clips; empty: the coach's own among `clips`. They join the library
  FuzzySystem system;
  double threshold = 0.4;          ///< frames of a smaller fuzzy distance match
  int min_clips = 2;               ///< the least number of clips in which a bridge frame's tags occur
  int most_per_class = 0;          ///< the number of bridge frames kept per clip and pose; 0: all
  bool within_class = false;       ///< compares only frames with the same ten tags
  OpenOptions reading;
  OnProgress on_progress = {};     ///< told of clips read
};

/// The clips of `etude bridge`, performed by one body and tagged.
struct BridgeLibrary {
  FuzzySystem system;
  TagRules tag_rules;
  MatchRules match_rules;
  MotionLibrary library;
  std::vector<std::string> sources;  ///< what opens the clips again
  std::vector<int> corrective;       ///< the clips that every other one must lead into
};

/// Loads the clips, has one body perform them, and finds their bridge frames. Fails as `LoadClips` does.
Result<BridgeLibrary> LoadBridgeLibrary(const BridgeLibraryOptions& options);

/// Returns the tags of a library, as its file holds them.
BridgeTags TagsOf(const BridgeLibrary& loaded);

/// Writes the tags of a library to a file, after reading them back.
Result<void> WriteTags(const BridgeLibrary& loaded, const std::string& path);

}  // namespace etude
