#include "bench/tasks/plausibility/find_clips.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "bench/tasks/evaluation/find_files.h"
#include "bench/tasks/plausibility/options.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "io/clips/open_clip.h"
#include "io/clips/references.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// A clip among a method's answers.
struct LoneClip {
  std::string reference;
  std::string folders;  ///< the folders for which wildcards stand: "walks/", or ""
};

/// Returns the folder before the first wildcard: "lib/" for "lib/*/a.bvh".
std::string FixedFolder(const std::string& pattern) {
  const std::string before = pattern.substr(0, pattern.find_first_of("*?["));
  return before.substr(0, before.rfind('/') + 1);
}

/// Lists the clips of a file. If the file cannot be read, returns the file itself, so that the row of this file states
/// the reason.
std::vector<std::string> ClipsIn(const std::string& reference) {
  constexpr std::array kOfSeveral = {".glb", ".gltf", ".fbx", ".vrm", ".vrma", ".c3d", ".trc"};
  const SplitReference split = Split(reference);
  const std::string ending = InLowerCase(fs::path(split.path).extension().string());
  if (split.animation || std::ranges::find(kOfSeveral, ending) == kOfSeveral.end()) return {reference};
  const auto clips = ReadClips(reference);
  if (!clips || clips->size() < 2) return {reference};
  std::vector<std::string> sources;
  for (const SourceClip& clip : *clips) sources.push_back(clip.source);
  return sources;
}

Result<std::vector<LoneClip>> ClipsOf(const PlausibilityMethod& method, const Place& place,
                                      std::vector<LeftOutFile>& left_out) {
  std::vector<LoneClip> clips;
  for (const std::string& pattern : method.answers) {
    ASSIGN_OR_RETURN(const auto files, ExpandFiles({pattern}, Links::kAllowed, place, left_out));
    const std::string fixed = FixedFolder(pattern);
    const bool has_wildcard = pattern.find_first_of("*?[") != std::string::npos;
    for (const std::string& file : files) {
      std::string folders;
      if (has_wildcard && file.starts_with(fixed)) folders = file.substr(fixed.size());
      folders.resize(folders.rfind('/') + 1);
      for (std::string& reference : ClipsIn(file)) clips.push_back({std::move(reference), folders});
    }
    if (clips.size() > kMaxPairs) return Fail(place, "more than {} clips", kMaxPairs);
  }
  if (clips.empty()) return Fail(place, "method {} has no 'answers'", Quote(method.name));
  return clips;
}

/// Returns the clips of a method by their names. Fails if two clips have the same name.
Result<std::map<std::string, std::string>> ByName(const std::vector<LoneClip>& clips, const Place& place) {
  std::map<std::string, int> count;
  for (const LoneClip& clip : clips) ++count[clip.folders + NameOfReference(clip.reference)];
  std::map<std::string, std::string> named;
  for (const LoneClip& clip : clips) {
    std::string name = clip.folders + NameOfReference(clip.reference);
    if (count[name] > 1) name = clip.folders + fs::path(clip.reference).filename().string();
    const auto [known, is_new] = named.emplace(std::move(name), clip.reference);
    if (is_new) continue;
    return Fail(place, "'{}' and '{}' have the same name; a pattern such as '*/*.bvh' puts folders into names",
                known->second, clip.reference);
  }
  return named;
}

}  // namespace

Result<FoundFiles> FindLoneClips(const Node& condition, std::span<const Node> methods,
                                 const std::map<std::string, std::string>& /*texts*/) {
  // Read the keys that name files. The task will read and check all keys later.
  PlausibilityOptions options;
  Fields fields(condition, "a scenario of task plausibility");
  PlausibilityConditionFields().Read(fields, options);
  if (!fields.ok()) return tl::unexpected(fields.Finish().error());
  if (const Node* trials = condition.Find("trials")) {
    return Fail(trials->place, "'trials' is not allowed in task plausibility, because each clip is judged once");
  }
  // Find the clips of each method, and collect the worlds by name.
  FoundFiles found;
  std::map<std::string, std::vector<std::string>> answers;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    Fields keys(methods[m], "a method of task plausibility");
    PlausibilityMethod method;
    method.name = keys.RequiredText("name");
    PlausibilityMethodFields().ReadKeys(keys, method);
    RETURN_IF_ERROR(keys.Finish());
    const Node* of_answers = methods[m].Find("answers");
    const Place& place = of_answers == nullptr ? methods[m].place : of_answers->place;
    ASSIGN_OR_RETURN(const auto clips, ClipsOf(method, place, found.left_out));
    ASSIGN_OR_RETURN(const auto named, ByName(clips, place));
    for (const auto& [name, reference] : named) {
      std::vector<std::string>& of_name = answers[name];
      of_name.resize(methods.size());
      of_name[m] = reference;
    }
  }
  for (auto& [name, of_name] : answers) {
    found.worlds.push_back({.name = name, .unit = "", .truth = "", .answers = std::move(of_name)});
  }
  if (!options.people.empty()) {
    RETURN_IF_ERROR(FindPeople(options.people, condition.Find("people")->place, found.worlds));
  }
  return found;
}

}  // namespace etude
