#pragma once

#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/tags_file/tags_file.h"
#include "io/clips/open_clip.h"

namespace etude {

/// The clips of a library, and the rules by which the clips' frames are tagged and matched.
struct BridgeLibraryOptions {
  std::vector<std::string> clips;  ///< references to clips; repeated clips are ignored
  /// The corrective clips, which are added to the library; empty = the coach's own clips among `clips`.
  std::vector<std::string> to;
  FuzzySystem system;
  double threshold = 0.4;          ///< two frames match if their fuzzy distance is smaller than this threshold
  int min_clips = 2;               ///< minimum number of clips in which the tags of a bridge frame must occur
  int most_per_class = 0;          ///< maximum number of bridge frames per clip and pose (combination of tags); 0 = all
  bool within_class = false;       ///< compare only frames with the same ten tags
  OpenOptions reading;
  OnProgress on_progress = {};     ///< receives the number of clips that have been read
};

/// The clips of `etude bridge`, performed by one body and tagged.
struct BridgeLibrary {
  FuzzySystem system;
  TagRules tag_rules;
  MatchRules match_rules;
  TaggedLibrary library;
  std::vector<std::string> sources;  ///< the references that open the clips again
  std::vector<int> corrective;       ///< indices of the clips into which every other clip must lead
  std::vector<Error> copies = {};    ///< clips that were left out, because they show the same motion as an earlier clip
};

/// Loads the clips, retargets all clips to one body, tags the clips, and finds the bridge frames. Of clips
/// that show the same motion, uses the first. Fails as `LoadClips` does.
Result<BridgeLibrary> LoadBridgeLibrary(const BridgeLibraryOptions& options);

/// Returns the tags of a library as the content of a tags file.
BridgeTags TagsOf(const BridgeLibrary& loaded);

/// Writes the tags of a library to a file. First reads back the text that it would write, and fails without writing if
/// the tags differ.
Result<void> WriteTags(const BridgeLibrary& loaded, const std::string& path);

}  // namespace etude
