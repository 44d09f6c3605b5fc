#include "tools/clips/bridge_library.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "engine/motion/equal_motions.h"
#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "sim/choreography/judged_proportions.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

/// Returns true for the clips by which a coach corrects (paper A, section 3.3): shaking the head, waving, a slow
/// demonstration, and the puzzled act.
bool IsCorrective(const std::string& source) {
  const std::string slow = "builtin:" + std::string(kSlowDemonstrationPrefix);
  const bool is_act = source == "builtin:head_shake" || source == "builtin:wave" || source == "builtin:puzzled";
  return is_act || source.starts_with(slow);
}

/// Expands references into clips. Each clip is listed once, in the order of first mention.
Result<std::vector<std::string>> ListReferences(const std::vector<std::string>& named) {
  auto all = ExpandReferences(named, kMaxLibraryClips);
  if (!all) return all;
  std::set<std::string> seen;
  std::erase_if(*all, [&](const std::string& reference) { return !seen.insert(reference).second; });
  return all;
}

/// Returns true if `reference` names the clip `source`; a reference to a glTF file names all animations of the file.
bool Names(const std::string& reference, const std::string& source) {
  return source == reference || source.starts_with(reference + "#");
}

/// If several clips have the same name, replaces these names by the clips' sources, which differ in the folder.
void MakeUnique(std::vector<std::string>& names, const std::vector<std::string>& sources) {
  std::map<std::string, int> counts;
  for (const std::string& name : names) ++counts[name];
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (counts[names[c]] > 1) names[c] = sources[c];
  }
}

/// Removes each clip that shows the same motion as an earlier clip, because a pose must occur in several motions. If
/// the copy is corrective, the earlier clip becomes corrective.
void LeaveOutCopies(BridgeLibrary& loaded, std::vector<BodyMotion>& motions) {
  std::vector<Places> places;
  for (const BodyMotion& motion : motions) places.push_back(PlacesOf(motion));
  const auto equals = FindEqual(places);
  std::vector<int> index(motions.size());  // of each clip, or of the clip that it equals, among those that remain
  std::size_t kept = 0;
  for (std::size_t c = 0; c < motions.size(); ++c) {
    if (equals[c]) {
      index[c] = index[*equals[c]];
      loaded.copies.push_back({{loaded.sources[c]}, "shows the same motion as " + loaded.sources[*equals[c]]});
      continue;
    }
    index[c] = static_cast<int>(kept++);
  }
  if (loaded.copies.empty()) return;
  EraseEqual(motions, equals);
  EraseEqual(loaded.library.names, equals);
  EraseEqual(loaded.sources, equals);
  std::set<int> corrective;
  for (const int c : loaded.corrective) corrective.insert(index[static_cast<std::size_t>(c)]);
  loaded.corrective.assign(corrective.begin(), corrective.end());
}

}  // namespace

Result<BridgeLibrary> LoadBridgeLibrary(const BridgeLibraryOptions& options) {
  BridgeLibrary loaded;
  loaded.system = options.system;
  ASSIGN_OR_RETURN(const auto wanted, ListReferences(options.to));
  std::vector<std::string> named = options.clips;
  named.insert(named.end(), wanted.begin(), wanted.end());
  ASSIGN_OR_RETURN(const auto references, ListReferences(named));
  // Read the clips one by one, and keep only the clips' motions.
  TaggedLibrary& library = loaded.library;
  std::vector<BodyMotion> motions;
  std::size_t done = 0;
  for (const std::string& reference : references) {
    if (options.on_progress) options.on_progress(done++, references.size());
    ASSIGN_OR_RETURN(auto read, LoadClips({reference}, {}, options.reading));
    for (LibraryClip& clip : read.clips) {
      const bool is_wanted = std::ranges::any_of(wanted, [&](const auto& one) { return Names(one, clip.source); });
      if (wanted.empty() ? IsCorrective(clip.source) : is_wanted) {
        loaded.corrective.push_back(static_cast<int>(motions.size()));
      }
      motions.push_back(std::move(clip.motion));
      library.names.push_back(std::move(clip.name));
      loaded.sources.push_back(std::move(clip.source));
    }
  }
  if (options.on_progress) options.on_progress(done, references.size());
  LeaveOutCopies(loaded, motions);
  MakeUnique(library.names, loaded.sources);
  // Retarget all clips to one body, tag the clips, and build the in-betweens.
  loaded.tag_rules.memberships = loaded.system.memberships;
  loaded.tag_rules.weights = loaded.system.weights;
  loaded.tag_rules.min_clips = options.min_clips;
  loaded.tag_rules.most_per_class = options.most_per_class;
  loaded.match_rules = {.weights = loaded.system.weights,
                        .threshold = options.threshold,
                        .pick = Pick::kFirst,
                        .within_class = options.within_class};
  library.proportions = JudgedProportions();
  PerformBy(library.proportions, motions);
  library.tagged = TagClips(motions, library.proportions.standing_hip_height, loaded.tag_rules);
  library.in_betweens = BuildInBetweens(
      library.tagged, {.weights = loaded.system.weights, .threshold = options.threshold, .tween = {}});
  return loaded;
}

BridgeTags TagsOf(const BridgeLibrary& loaded) {
  return CollectTags(loaded.library, loaded.sources, loaded.system, loaded.tag_rules, loaded.match_rules);
}

Result<void> WriteTags(const BridgeLibrary& loaded, const std::string& path) {
  const BridgeTags tags = TagsOf(loaded);
  ASSIGN_OR_RETURN(const auto text, WriteTagsFile(tags));
  if (text.size() > kMaxTagsFileBytes) {
    return Fail({path}, "the file would have {} MB; allowed: {} MB. Use --most-per-class N to keep fewer bridge frames",
                text.size() / 1'000'000, kMaxTagsFileBytes / 1'000'000);
  }
  ASSIGN_OR_RETURN(const auto back, ReadTagsFile(text, path));
  if (!(back == tags))
    return Fail({path, 0, 0}, "the written tags differ when they are read back, so Etude wrote no file");
  return WriteFileAtomically(path, text);
}

}  // namespace etude
