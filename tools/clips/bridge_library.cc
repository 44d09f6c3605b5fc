#include "tools/clips/bridge_library.h"

#include <algorithm>
#include <set>

#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "sim/choreography/judged_proportions.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

/// Returns true for the clips with which a coach corrects (paper A, section 3.3): shaking the head, waving, a slow
/// demonstration, and the puzzled act.
bool IsCorrective(const std::string& source) {
  const std::string slow = "builtin:" + std::string(kSlowDemonstrationPrefix);
  const bool is_act = source == "builtin:head_shake" || source == "builtin:wave" || source == "builtin:puzzled";
  return is_act || source.starts_with(slow);
}

/// Expands references into clips, each once, in the order of their first mention.
Result<std::vector<std::string>> ListReferences(const std::vector<std::string>& named) {
  auto all = ExpandReferences(named);
  if (!all) return all;
  std::set<std::string> seen;
  std::erase_if(*all, [&](const std::string& reference) { return !seen.insert(reference).second; });
  return all;
}

/// Returns true if a reference names the clip; a glTF file's reference names all its animations.
bool Names(const std::string& reference, const LibraryClip& clip) {
  return clip.source == reference || clip.source.starts_with(reference + "#");
}

/// Returns the clips' names; files of equal names are distinguished by their folders.
std::vector<std::string> UniqueNames(const std::vector<LibraryClip>& clips) {
  std::vector<std::string> names;
  for (const LibraryClip& clip : clips) {
    const auto has_name = [&](const LibraryClip& other) { return other.name == clip.name; };
    names.push_back(std::count_if(clips.begin(), clips.end(), has_name) > 1 ? clip.source : clip.name);
  }
  return names;
}

}  // namespace

Result<BridgeLibrary> LoadBridgeLibrary(const BridgeLibraryOptions& options) {
  BridgeLibrary loaded;
  loaded.system = options.system;
  ASSIGN_OR_RETURN(const auto wanted, ListReferences(options.to));
  std::vector<std::string> named = options.clips;
  named.insert(named.end(), wanted.begin(), wanted.end());
  ASSIGN_OR_RETURN(const auto references, ListReferences(named));
  ASSIGN_OR_RETURN(const auto clips, LoadClips(references, {}, options.reading, options.on_progress));

  // Collect the motions, and note which clips are corrective.
  std::vector<BodyMotion> motions;
  for (const LibraryClip& clip : clips.clips) {
    const bool is_wanted =
        std::any_of(wanted.begin(), wanted.end(), [&](const std::string& reference) { return Names(reference, clip); });
    if (wanted.empty() ? IsCorrective(clip.source) : is_wanted)
      loaded.corrective.push_back(static_cast<int>(motions.size()));
    motions.push_back(clip.motion);
    loaded.sources.push_back(clip.source);
  }
  // Tag all clips on one body, and build the in-betweens.
  loaded.tag_rules.memberships = loaded.system.memberships;
  loaded.tag_rules.weights = loaded.system.weights;
  loaded.tag_rules.min_clips = options.min_clips;
  loaded.tag_rules.most_per_class = options.most_per_class;
  loaded.match_rules = {.weights = loaded.system.weights,
                        .threshold = options.threshold,
                        .pick = Pick::kFirst,
                        .within_class = options.within_class};
  loaded.library = MakeLibrary(UniqueNames(clips.clips), motions, JudgedProportions(), loaded.tag_rules);
  loaded.library.in_betweens = BuildInBetweens(
      loaded.library.tagged, {.weights = loaded.system.weights, .threshold = options.threshold, .tween = {}});
  return loaded;
}

BridgeTags TagsOf(const BridgeLibrary& loaded) {
  return CollectTags(loaded.library, loaded.sources, loaded.system, loaded.tag_rules, loaded.match_rules);
}

Result<void> WriteTags(const BridgeLibrary& loaded, const std::string& path) {
  const BridgeTags tags = TagsOf(loaded);
  ASSIGN_OR_RETURN(const auto text, WriteTagsFile(tags));
  ASSIGN_OR_RETURN(const auto back, ReadTagsFile(text, path));
  if (!(back == tags)) return Fail({path, 0, 0}, "does not read back as the same tags; nothing was written");
  return WriteFileAtomically(path, text);
}

}  // namespace etude
