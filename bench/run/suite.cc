#include "bench/run/suite.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "bench/run/manifest.h"
#include "bench/run/recorded_motions.h"
#include "bench/run/shipped.h"
#include "bench/scenario/methods.h"
#include "bench/tasks/registry.h"
#include "engine/base/digest.h"
#include "engine/base/text.h"
#include "io/clips/open_clip.h"
#include "io/clips/raw_motions.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "io/streams/load.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

fs::path TopOf(const fs::path& folder) {
  for (fs::path above = folder; above != above.parent_path(); above = above.parent_path()) {
    if (std::error_code none; fs::exists(above / ".git", none)) return above;
  }
  // The name of a shipped file is its path in the repository, wherever the program is installed.
  const fs::path shipped = ShippedFolder();
  const fs::path inside = folder.lexically_relative(shipped);
  return shipped.empty() || inside.empty() || *inside.begin() == ".." ? fs::path() : shipped;
}

std::string SuiteName(const std::vector<std::string>& paths) {
  if (paths.size() != 1) return "suite";
  std::error_code error;
  const fs::path path = fs::absolute(paths.front(), error).lexically_normal();
  if (!fs::is_directory(path, error)) return path.stem().string();
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  return name.empty() || name == "." ? "suite" : name;
}

/// Adds to `texts` the text of a file that a scenario names, so that the manifest suffices to repeat the run.
Result<void> KeepText(const std::string& file, SourceTexts& texts) {
  if (file.empty() || texts.contains(file)) return {};
  ASSIGN_OR_RETURN(auto text, ReadWholeFile(file));
  texts[file] = std::move(text);
  return {};
}

/// Adds to `texts` the texts of the files that a scenario's conditions name. The tasks check their content later.
Result<void> KeepNamedFiles(const Scenario& scenario, SourceTexts& texts) {
  for (const Condition& condition : scenario.conditions) {
    for (const NamedFile& file : FilesNamedBy(condition, *FindTaskKind(scenario.task))) {
      if (auto kept = KeepText(file.node->scalar, texts); !kept) {
        return Fail(file.node->place, "{}", ToString(kept.error()));
      }
    }
  }
  return {};
}

/// Adds to `texts` the text of a joint map, followed by the lines `more`. Returns the map's name in `texts`.
Result<std::string> KeepJointMap(const std::string& file, const std::string& more, SourceTexts& texts) {
  RETURN_IF_ERROR(KeepText(file, texts));
  if (more.empty()) return file;
  std::string name = file + "(" + more.substr(0, more.size() - 1) + ")";
  std::ranges::replace(name, '\n', ',');
  texts[name] = (file.empty() ? "" : texts.at(file) + "\n") + more;
  return name;
}

/// Fails if a list of clips names a motion twice, even by different paths: it would count twice, and a transition could
/// lead from a clip to itself.
Result<void> RefuseDoubles(const std::vector<std::string>& references, const Place& place) {
  std::map<std::pair<std::string, std::optional<std::string>>, std::string> known;
  for (const std::string& reference : references) {
    const auto expanded = ExpandReference(reference, place);
    if (!expanded) continue;  // reading the clips reports it
    for (const std::string& one : *expanded) {
      const SplitReference split = Split(one);
      std::error_code none;
      const auto path = std::filesystem::canonical(FileOf(split.path), none);
      const auto [first, is_new] = known.emplace(std::pair(none ? split.path : path.string(), split.animation), one);
      if (is_new) continue;
      return Fail(place, "the clips contain a motion twice: '{}' and '{}' (from '{}'); list each motion once",
                  first->second, one, reference);
    }
  }
  return {};
}

/// Returns the clips of `references` that can be read and understood. Adds the others to `refused`.
Result<std::vector<std::string>> OnlyUnderstood(const std::vector<std::string>& references, const OpenOptions& how,
                                                const Place& place, std::vector<RefusedClip>& refused) {
  std::vector<std::string> understood;
  const std::size_t before = refused.size();
  for (const std::string& reference : references) {
    ASSIGN_OR_RETURN(const auto expanded, ExpandReference(reference, place));
    for (const std::string& one : expanded) {
      auto clips = ReadClips(one, how);
      if (!clips) refused.push_back({one, ToString(clips.error())});
      if (!clips) continue;
      for (SourceClip& clip : *clips) {
        const std::string source = clip.source;
        if (const auto opened = UnderstandClip(std::move(clip), how); opened) {
          understood.push_back(source);
        } else {
          refused.push_back({source, ToString(opened.error())});
        }
      }
    }
  }
  if (!references.empty() && understood.empty()) {
    const std::span now = std::span(refused).subspan(before);
    return Fail(place, "--skip-refused: none of {} clips can be read; the first: {}", now.size(),
                now.empty() ? "there is none" : now.front().why);
  }
  return understood;
}

/// Leaves out the clips of files that are byte copies of earlier files, and adds them to `refused`. Otherwise one
/// motion would count as two independent clips. Files whose motion also depends on other files are kept. Only files of
/// equal size are read.
void LeaveOutCopies(std::vector<std::string>& references, const OpenOptions& how, const Place& place,
                    std::vector<RefusedClip>& refused) {
  std::vector<std::string> all, kept;
  for (const std::string& reference : references) {
    const auto expanded = ExpandReference(reference, place);
    if (!expanded) return;  // reading the clips reports it
    all.insert(all.end(), expanded->begin(), expanded->end());
  }
  const auto size_of = [](const std::string& file) {
    std::error_code none;
    const auto size = std::filesystem::file_size(file, none);
    return none ? 0 : size;
  };
  std::map<std::uintmax_t, std::set<std::string>> of_size;
  for (const std::string& one : all) of_size[size_of(FileOf(Split(one).path))].insert(FileOf(Split(one).path));
  std::map<std::pair<std::string, std::optional<std::string>>, std::string> known;
  for (const std::string& one : all) {
    const SplitReference split = Split(one);
    const std::string file = FileOf(split.path), ending = InLowerCase(std::filesystem::path(file).extension().string());
    const bool may_be_copy = of_size[size_of(file)].size() > 1 && ending != ".amc" && ending != ".gltf";
    const auto digest = may_be_copy ? DigestOfFile(one, how) : Result<std::string>(one);
    if (!digest) return;
    const auto [first, is_new] = known.emplace(std::pair(*digest, split.animation), one);
    if (is_new) {
      kept.push_back(one);
    } else {
      refused.push_back(
          {one, fmt::format("is a byte copy of '{}', and one motion must not count twice", first->second)});
    }
  }
  if (kept.size() < all.size()) references = std::move(kept);
}

/// Applies LeaveOutCopies to the clips of a scenario, and to those of each library.
Result<void> LeaveOutCopies(ScenarioSetup& setup, const SourceTexts& texts) {
  ASSIGN_OR_RETURN(const auto how, OpenOptionsOf(setup, texts));
  LeaveOutCopies(setup.clips, how, {setup.file, 0, 0}, setup.refused);
  for (NamedClips& library : setup.libraries) {
    LeaveOutCopies(library.clips, how, {setup.file, 0, 0}, setup.refused);
  }
  return {};
}

Result<void> LeaveOutRefused(ScenarioSetup& setup, const SourceTexts& texts) {
  ASSIGN_OR_RETURN(const auto how, OpenOptionsOf(setup, texts));
  const Place place{setup.file, 0, 0};
  ASSIGN_OR_RETURN(setup.clips, OnlyUnderstood(setup.clips, how, place, setup.refused));
  for (NamedClips& library : setup.libraries) {
    ASSIGN_OR_RETURN(library.clips, OnlyUnderstood(library.clips, how, place, setup.refused));
  }
  return {};
}

/// Adds to `texts` the texts of label files. Returns the files' names in `texts`.
Result<std::vector<std::string>> KeepLabels(const std::string& path, SourceTexts& texts) {
  if (path.empty()) return std::vector<std::string>{};
  ASSIGN_OR_RETURN(auto files, LabelFiles(path));
  for (const std::string& file : files) RETURN_IF_ERROR(KeepText(file, texts));
  return files;
}

/// Fails if, for one of `paths`, no scenario file can use an option of the command line. `with_use` contains the
/// scenario files that can use the option; `why` names the option and says why the others cannot.
Result<void> CheckThatUsed(const std::vector<std::string>& paths, const std::set<std::string>& with_use,
                           std::string_view why) {
  for (const std::string& path : paths) {
    ASSIGN_OR_RETURN(const auto files, FindScenarioFiles({path}));
    const bool used = std::ranges::any_of(files, [&](const std::string& file) { return with_use.contains(file); });
    if (!used) return Fail({path, 0, 0}, "cannot use {}", why);
  }
  return {};
}

/// Parses options of the form "NAME=CLIPS". Clips with the same name are combined into one library.
Result<std::vector<NamedClips>> ReadLibraryOptions(const std::vector<std::string>& options) {
  std::vector<NamedClips> libraries;
  for (const std::string& option : options) {
    const std::size_t equals = option.find('=');
    const std::string name = option.substr(0, equals);
    if (equals == std::string::npos || equals + 1 == option.size() || !IsPlainName(name)) {
      return Fail({}, "--library: found '{}'; allowed: NAME=CLIPS, such as dance='mocap/*.bvh'", option);
    }
    auto known = std::ranges::find(libraries, name, &NamedClips::name);
    if (known == libraries.end()) known = libraries.insert(known, {name, {}});
    known->clips.push_back(option.substr(equals + 1));
  }
  return libraries;
}

/// The scenario files in which a scenario can use the option for clips, and those in which a scenario can use the
/// option for recordings.
struct UsersOfFiles {
  std::set<std::string> clips, recordings;
};

std::optional<Seed> SeedOf(const RunOptions& options) {
  if (options.key) return Seed::Secret(options.key->words);
  return options.seed ? std::optional<Seed>(*options.seed) : std::nullopt;
}

/// Applies the command line's options to a scenario. Adds to `sources` the texts that the scenario names, and to
/// `users` the scenario's file.
Result<ScenarioSetup> SetUp(Scenario& scenario, const std::string& file, const std::string& digest, int trials,
                            const RunOptions& options, SourceTexts& sources, UsersOfFiles& users) {
  const bool uses_clips = FindTaskKind(scenario.task)->uses_clips;
  // Find the options that apply to this scenario, and refuse options that contradict it.
  if (uses_clips) users.clips.insert(file);
  const bool replaced = !options.clips.empty() && uses_clips;
  if (replaced && !scenario.libraries.empty()) {
    return Fail({file, 0, 0},
                "--clips: not allowed, because scenario {} uses libraries; --library NAME=CLIPS adds a library",
                scenario.name);
  }
  if (replaced && !scenario.streams.files.empty()) {
    return Fail({file, 0, 0},
                "--clips: not allowed, because scenario {} uses recordings; --streams replaces the recordings",
                scenario.name);
  }
  const bool uses_recordings = FindTaskKind(scenario.task)->uses_recordings;
  const bool is_recorded = uses_recordings && !options.streams.empty();
  if (is_recorded && !scenario.libraries.empty()) {
    return Fail({file, 0, 0}, "--streams: not allowed, because scenario {} uses libraries", scenario.name);
  }
  if (uses_recordings) users.recordings.insert(file);
  if (is_recorded) scenario.streams.files = options.streams;
  // The scenario's labels belong to its own recordings. If the options give recordings or labels, the labels of the
  // options replace them.
  if (is_recorded || (uses_recordings && !options.labels.empty())) scenario.streams.labels = options.labels;
  // With libraries or recordings, the scenario's own clips are not used.
  std::vector<std::string> clips = replaced ? options.clips : scenario.clips;
  if (!scenario.libraries.empty() || !scenario.streams.files.empty()) clips.clear();
  ASSIGN_OR_RETURN(
      const auto joint_map,
      KeepJointMap(options.joint_map.empty() ? scenario.joint_map : options.joint_map, options.clip_facts, sources));
  RETURN_IF_ERROR(RefuseDoubles(clips, {file, 0, 0}));
  for (const NamedClips& library : scenario.libraries) RETURN_IF_ERROR(RefuseDoubles(library.clips, {file, 0, 0}));
  // Add the texts that the scenario names, and check that its clips and recordings can be read.
  RETURN_IF_ERROR(KeepNamedFiles(scenario, sources));
  ScenarioSetup setup{file,   scenario.name,      SeedOf(options).value_or(scenario.seed.value_or(1)),
                      trials, std::move(clips),   joint_map,
                      digest, scenario.libraries, scenario.streams.files};
  setup.keeps_motions = options.keeps_motions;
  RETURN_IF_ERROR(LeaveOutCopies(setup, sources));
  if (options.skip_refused) RETURN_IF_ERROR(LeaveOutRefused(setup, sources));
  ASSIGN_OR_RETURN(setup.labels, KeepLabels(scenario.streams.labels, sources));
  RETURN_IF_ERROR(FindFiles(scenario, sources, setup));
  if (!setup.files.empty()) {  // each world made of files is one trial; --trials limits the number of these worlds
    if (options.key)
      return Fail({file, 0, 0}, "--seed-file: not allowed, because scenario {} judges files and uses no random numbers",
                  scenario.name);
    setup.trials = std::min(options.trials.value_or(static_cast<int>(kMaxCells)), static_cast<int>(setup.files.size()));
    setup.files.resize(static_cast<std::size_t>(setup.trials));
  }
  ASSIGN_OR_RETURN(const auto people, CountRecordedPeople(setup, scenario.streams, sources));
  if (people) setup.trials = std::min(trials, *people);  // each person is one trial
  return setup;
}

}  // namespace

std::map<std::string, std::string> CanonicalNames(const std::string& scenario_file,
                                                  const std::vector<std::string>& sources) {
  std::error_code error;
  const fs::path given = fs::absolute(scenario_file, error).lexically_normal().parent_path();
  const fs::path folder = fs::weakly_canonical(given, error);
  const fs::path top = TopOf(folder);
  std::map<std::string, std::string> names;
  for (const std::string& source : sources) {
    // The name is the path that an `include` would contain: relative to the scenario's folder, without resolving links.
    const fs::path from_folder = fs::absolute(source, error).lexically_normal().lexically_relative(given);
    const fs::path path = (folder / from_folder).lexically_normal();
    names[source] = (top.empty() ? path : path.lexically_relative(top)).generic_string();
  }
  return names;
}

Result<std::vector<std::string>> FindScenarioFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& named : paths) {
    const std::string path = FindScenario(named).string();
    if (path.empty()) return UnknownShippedName(named);
    std::error_code error;
    if (fs::is_directory(path, error)) {
      std::vector<std::string> inside;
      for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == ".yaml") inside.push_back(entry->path().string());
      }
      if (error) return Fail({path, 0, 0}, "cannot be read: {}", error.message());
      if (inside.empty()) return Fail({path, 0, 0}, "contains no scenario (*.yaml)");
      std::sort(inside.begin(), inside.end());
      files.insert(files.end(), inside.begin(), inside.end());
    } else {
      files.push_back(path);  // if the file does not exist, reading it later reports the error
    }
  }
  return files;
}

Result<SuiteSetup> ReadSuite(const RunOptions& options) {
  std::vector<std::string> files = options.scenarios;
  if (options.text.empty()) {
    ASSIGN_OR_RETURN(files, FindScenarioFiles(options.scenarios));
  }
  ASSIGN_OR_RETURN(const auto libraries, ReadLibraryOptions(options.libraries));
  SuiteSetup suite;
  suite.suite = SuiteName(options.scenarios);
  suite.seed = SeedOf(options).value_or(1);
  std::map<std::string, std::string> file_of_name;
  UsersOfFiles users;
  std::size_t cells = 0;
  for (const std::string& file : files) {
    // Read the file and the files that it includes. Compute one digest of all these files, in the order of their
    // canonical names.
    SourceTexts texts;
    if (!options.text.empty()) texts[file] = options.text;
    ASSIGN_OR_RETURN(auto scenarios, options.text.empty() ? ReadScenarios(file, texts) : ParseScenarios(file, texts));
    suite.parsed[file] = scenarios;
    std::vector<std::string> names;
    for (const auto& [name, text] : texts) names.push_back(name);
    // A text that does not come from a file has the same name everywhere.
    const auto canonical =
        options.text.empty() ? CanonicalNames(file, names) : std::map<std::string, std::string>{{file, file}};
    std::map<std::string_view, std::string_view> texts_in_order;
    for (const auto& [name, text] : texts) texts_in_order[canonical.at(name)] = text;
    Digest digest;
    for (const auto& [name, text] : texts_in_order) digest.Add(text);
    // Apply the options to each scenario. Check that names are unique and that there are not too many cells.
    for (Scenario& scenario : scenarios) {
      const bool uses_clips = FindTaskKind(scenario.task)->uses_clips;
      for (const NamedClips& library : libraries) {
        if (std::ranges::find(scenario.libraries, library.name, &NamedClips::name) == scenario.libraries.end())
          continue;
        return Fail({file, 0, 0}, "--library: scenario {} already has a library '{}'", scenario.name, library.name);
      }
      if (uses_clips) AddLibraries(libraries, scenario);
      const auto [other, is_new] = file_of_name.emplace(scenario.name, file);
      if (!is_new) {
        return Fail({file, 0, 0}, "a scenario named '{}' is already in {}", scenario.name, other->second);
      }
      const int trials = options.trials.value_or(scenario.trials);
      cells += scenario.conditions.size() * scenario.methods.size() * static_cast<std::size_t>(trials);
      if (cells > kMaxCells) {
        return Fail({file, 0, 0},
                    "with this scenario ({} conditions × {} methods × {} trials), the run has more than {} cells",
                    scenario.conditions.size(), scenario.methods.size(), trials, kMaxCells);
      }
      ASSIGN_OR_RETURN(auto setup, SetUp(scenario, file, digest.Hex(), trials, options, suite.sources, users));
      suite.scenarios.push_back(std::move(setup));
    }
    suite.canonical.insert(canonical.begin(), canonical.end());
    suite.sources.merge(texts);
  }
  // Refuse options that no scenario of the suite can use.
  if (!options.clips.empty() || !options.libraries.empty()) {
    RETURN_IF_ERROR(CheckThatUsed(options.scenarios, users.clips,
                                  "--clips or --library: no scenario has a task that takes clips; a task that judges "
                                  "files finds its files by the scenario's key 'truth'"));
  }
  if (!options.streams.empty() || !options.labels.empty()) {
    RETURN_IF_ERROR(CheckThatUsed(options.scenarios, users.recordings,
                                  "--streams or --labels: no scenario has a task that makes worlds from recordings"));
  }
  return suite;
}

Result<void> RefuseFiles(const SuiteSetup& suite) {
  for (const ScenarioSetup& setup : suite.scenarios) {
    if (setup.files.empty()) continue;
    return Fail(
        {setup.file, 0, 0},
        "scenario {} judges files, so it has no problems to export or score; use 'etude run' or 'etude evaluate'",
        setup.name);
  }
  return {};
}

Result<SuiteSetup> ReadSuiteToRun(const RunOptions& options) {
  ASSIGN_OR_RETURN(auto suite, options.from.empty() ? ReadSuite(options) : ReadManifest(options.from));
  if (!options.from.empty()) RETURN_IF_ERROR(OpenSeeds(options.key, {options.from}, suite));
  if (!suite.scored) return suite;
  return Fail({options.from, 0, 0},
              "describes the scored answers of '{}', and etude cannot run answers; use 'etude score'",
              suite.scored->name);
}

Result<std::vector<PreparedScenario>> PrepareToRun(const SuiteSetup& suite, const RunOptions& options) {
  ASSIGN_OR_RETURN(auto scenarios, PrepareAll(suite));
  if (!options.from.empty()) {
    RETURN_IF_ERROR(CheckClips(options.from, scenarios));
    RETURN_IF_ERROR(CheckPrograms(options.from, scenarios, options.outside));
  }
  return scenarios;
}

}  // namespace etude
