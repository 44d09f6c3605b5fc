#include "cli/bridge_library.h"

#include <algorithm>
#include <set>

#include "bench/clips/clip_library.h"
#include "bench/tasks/transition/stage.h"
#include "cli/clip_reading.h"
#include "cli/progress_bar.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

/// Paper A, section 3.3: shaking the head, waving, a slow demonstration; and the puzzled act.
bool IsCorrective(const std::string& source) {
  const std::string slow = "builtin:" + std::string(kSlowDemonstrationPrefix);
  const bool is_act = source == "builtin:head_shake" || source == "builtin:wave" || source == "builtin:puzzled";
  return is_act || source.starts_with(slow);
}

/// Clips in the order of their first mention, each once.
Result<std::vector<std::string>> ListReferences(const std::vector<std::string>& named) {
  auto all = ExpandAll(named);
  if (!all) return all;
  std::set<std::string> seen;
  std::erase_if(*all, [&](const std::string& reference) { return !seen.insert(reference).second; });
  return all;
}

/// Whether a reference stands for the clip; that of a glTF file stands for all its animations.
bool Names(const std::string& reference, const LibraryClip& clip) {
  return clip.source == reference || clip.source.starts_with(reference + "#");
}

/// Files of the same name in several folders are told apart by their folders.
std::vector<std::string> UniqueNames(const std::vector<LibraryClip>& clips) {
  std::vector<std::string> names;
  for (const LibraryClip& clip : clips) {
    const auto has_name = [&](const LibraryClip& other) { return other.name == clip.name; };
    names.push_back(std::count_if(clips.begin(), clips.end(), has_name) > 1 ? clip.source : clip.name);
  }
  return names;
}

}  // namespace

Result<BridgeLibrary> LoadBridgeLibrary(const BridgeCommandOptions& options) {
  BridgeLibrary loaded;
  ASSIGN_OR_RETURN(loaded.system, ReadFuzzy(options.fuzzy));
  ASSIGN_OR_RETURN(const auto reading, ReadOptions(options.reading));
  ASSIGN_OR_RETURN(const auto wanted, ListReferences(options.to));
  std::vector<std::string> named = options.clips;
  named.insert(named.end(), wanted.begin(), wanted.end());
  ASSIGN_OR_RETURN(const auto references, ListReferences(named));
  ASSIGN_OR_RETURN(const auto clips, LoadClips(references, {}, reading, TellOf("clips read")));

  std::vector<BodyMotion> motions;
  for (const LibraryClip& clip : clips.clips) {
    const bool is_wanted =
        std::any_of(wanted.begin(), wanted.end(), [&](const std::string& reference) { return Names(reference, clip); });
    if (wanted.empty() ? IsCorrective(clip.source) : is_wanted)
      loaded.corrective.push_back(static_cast<int>(motions.size()));
    motions.push_back(clip.motion);
    loaded.sources.push_back(clip.source);
  }
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

}  // namespace etude
