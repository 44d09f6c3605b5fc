#include "bench/run/outside_programs.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/outside/program_view.h"
#include "bench/run/outside_metrics.h"
#include "bench/run/shipped.h"
#include "engine/base/digest.h"
#include "engine/base/machine.h"
#include "io/files/own_files.h"
#include "io/files/temporary_folder.h"
#include "io/process/child_process.h"

namespace etude {

namespace fs = std::filesystem;

std::vector<std::string> ProgramsOf(std::span<const PreparedScenario> scenarios) {
  std::vector<std::string> programs;
  for (const PreparedScenario& scenario : scenarios) {
    for (const ScenarioProgram& program : ProgramsIn(scenario.scenario())) {
      programs.push_back(fmt::format("{} ({}/{})", fmt::join(program.entry->exec, " "), scenario.scenario().name,
                                     program.entry->name));
    }
  }
  return programs;
}

Result<void> CheckPrograms(const std::string& file, std::span<const PreparedScenario> scenarios,
                           const OutsideRules& rules) {
  const std::vector<std::string> programs = ProgramsOf(scenarios);
  if (programs.empty() || rules.allow_exec) return {};
  return Fail({file, 0, 0}, "a run would start programs, but --allow-exec is missing: {}", fmt::join(programs, "; "));
}

OutsideOptions OptionsOf(const PreparedScenario& scenario, const ScenarioProgram& program,
                         const std::string& error_folder, const Fence& fence) {
  const Scenario& told = scenario.scenario();
  const MethodEntry& entry = *program.entry;
  const bool is_metric = program.IsMetric();
  return {.command = entry.exec,
          .task = is_metric ? "metric" : told.task,
          .options_json = entry.options_json,
          .time_s = entry.time_s.value_or(told.limits.time_s),
          .memory_mb = told.limits.memory_mb,
          .error_file = ErrorFileOf(error_folder, told, program),
          .fence = fence,
          .files = entry.files,
          .seed = scenario.setup().seed};
}

namespace {

std::string DigestOfContent(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "unreadable";
  Digest digest;
  std::vector<char> part(1 << 20);
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())), in.gcount() > 0) {
    digest.Add(std::string_view(part.data(), static_cast<std::size_t>(in.gcount())));
  }
  return digest.Hex();
}

/// Returns true for a folder with results of a run, caches of Python or the folder of Git.
bool IsLeftOut(const fs::directory_entry& folder) {
  const fs::path name = folder.path().filename();
  std::error_code error;
  return name == ".git" || name == "__pycache__" || fs::exists(folder.path() / "manifest.json", error);
}

/// Adds the digests of the files in a folder, unless a file IsLeftOut. A folder of very many files, such as an
/// installation of Python, has one digest, of the names and sizes of its files.
void AddFolder(const std::string& folder, Json& files) {
  constexpr std::size_t kMaxContents = 1000;
  std::map<std::string, std::int64_t> sizes;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code none;
    if (entry->is_directory(none)) {
      if (IsLeftOut(*entry)) entry.disable_recursion_pending();
    } else if (entry->is_regular_file(none)) {
      sizes[entry->path().lexically_normal().string()] = static_cast<std::int64_t>(entry->file_size(none));
    }
  }
  if (sizes.size() <= kMaxContents) {
    for (const auto& [file, size] : sizes) files[file] = DigestOfContent(file);
    return;
  }
  Digest digest;
  for (const auto& [file, size] : sizes) digest.Add(std::string_view(file)).Add(size);
  files[folder + " (names and sizes)"] = digest.Hex();
}

/// Returns the extension of an interpreter's scripts, for the extension of a file that scripts of this kind import.
fs::path LanguageOf(const fs::path& file) {
  const fs::path extension = file.extension();
  if (extension == ".so") return ".py";
  return extension == ".mjs" || extension == ".cjs" ? fs::path(".js") : extension;
}

/// Adds the digests of the files in `folder` that a script of the language in this folder may import. Packages count,
/// too: subfolders that contain such files themselves.
void AddNeighbours(const fs::path& folder, const fs::path& language, Json& files) {
  std::vector<fs::path> subfolders;
  bool is_package = false;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code none;
    if (entry->is_directory(none)) {
      if (!entry->is_symlink(none) && !IsLeftOut(*entry)) subfolders.push_back(entry->path());
    } else if (LanguageOf(entry->path()) == language && entry->is_regular_file(none)) {
      files[entry->path().lexically_normal().string()] = DigestOfContent(entry->path());
      is_package = true;
    }
  }
  if (!is_package) return;
  for (const fs::path& subfolder : subfolders) AddNeighbours(subfolder, language, files);
}

/// Returns the digests of the files that a program's `exec` and `files` name, by the files' names in these keys.
Json DigestsOf(const MethodEntry& program) {
  Json files = Json::object();
  std::error_code error;
  for (std::size_t i = 0; i < program.exec.size(); ++i) {
    const std::string& word = program.exec[i];
    const std::string path = i == 0 ? FindProgram(word).value_or("") : word;
    if (!fs::is_regular_file(path, error) || (i == 0 && Fence::IsOfSystem(path))) continue;
    files[fs::path(word).lexically_normal().string()] = DigestOfContent(path);
    if (!program.files.empty() || !fs::path(word).has_extension()) continue;
    const fs::path folder = fs::path(path).parent_path();
    AddNeighbours(folder.empty() ? "." : folder, LanguageOf(path), files);
  }
  for (const std::string& file : program.files) {
    if (fs::is_directory(file, error)) {
      AddFolder(file, files);
    } else {
      files[fs::path(file).lexically_normal().string()] = DigestOfContent(file);
    }
  }
  return files;
}

fs::path Canonical(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(path, error), error);
  return canonical.has_filename() ? canonical : canonical.parent_path();
}

bool Holds(const fs::path& folder, const fs::path& path) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

/// Returns true if `folder` lies so deep in a system folder that it can be a project of its own, e.g. /opt/NAME or
/// /usr/src/NAME, and does not contain the outside program `program`. The whole folder may then be hidden from the
/// program.
bool IsOursInSystem(const fs::path& folder, const fs::path& program) {
  const auto depth = std::distance(folder.begin(), folder.end());
  return Fence::IsOfSystem(folder) && depth >= (Holds("/opt", folder) ? 3 : 4) && !Holds(folder, program);
}

/// Fails if an outside program could read a file that reveals the scenario's secret worlds.
Result<void> CheckShown(const PreparedScenario& scenario, const ScenarioProgram& program, const ProgramView& view,
                        const fs::path& folder, const std::optional<SecretKey>& key) {
  const std::pair<const char*, fs::path> secrets[] = {
      {"the scenario", scenario.setup().file}, {"the run's folder", folder}, {"the key", key ? key->file : fs::path()}};
  for (const fs::path& shown : view.shown) {
    for (const auto& [what, path] : secrets) {
      if (path.empty() || !Holds(Canonical(shown), Canonical(path))) continue;
      return Fail({scenario.setup().file},
                  "{} '{}' could read '{}', which contains {} of the secret worlds ('{}'); list in the key 'files' "
                  "only the files that this program needs",
                  program.role, program.entry->name, shown.string(), what, path.string());
    }
  }
  return {};
}

/// Fails if a path in a program's key `files` does not exist, or is or contains a folder to which programs write.
Result<void> CheckFiles(const PreparedScenario& scenario, const ScenarioProgram& program) {
  std::error_code error;
  for (const std::string& file : program.entry->files) {
    if (Fence::HoldsScratch(Canonical(file))) {
      return Fail(
          {scenario.setup().file},
          "'files' of {} '{}': '{}' contains a folder into which programs write; allowed: files and other folders",
          program.role, program.entry->name, file);
    }
    if (fs::exists(file, error)) continue;
    return Fail({scenario.setup().file}, "'files' of {} '{}': '{}' does not exist; allowed: files and folders",
                program.role, program.entry->name, file);
  }
  return {};
}

Json Texts(const std::vector<fs::path>& paths) {
  Json texts = Json::array();
  for (const fs::path& path : paths) texts.push_back(path.string());
  return texts;
}

}  // namespace

Result<void> AddPrograms(std::span<const PreparedScenario> scenarios, const Fence& fence, Json& manifest) {
  // The folder for the programs' standard error, which the reason of a failure quotes.
  std::optional<TemporaryFolder> errors;
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    for (const ScenarioProgram& program : ProgramsIn(scenarios[s].scenario())) {
      if (!errors) {
        AdoptOrphans();  // so that processes that outlive a program become children of this process, which ends them
        ASSIGN_OR_RETURN(errors, TemporaryFolder::Make("greetings"));
      }
      OutsideMethod started(OptionsOf(scenarios[s], program, errors->path().string(), fence));
      const OutsideReply reply = started.Greet();
      if (!reply.was_asked) {
        return FailOfMachine("{} {} of {}: {}", program.role, program.entry->name, scenarios[s].scenario().name,
                             reply.reason);
      }
      manifest["scenarios"][s]["programs"][(program.IsMetric() ? "metric " : "") + program.entry->name] = {
          {"greeting", reply.status == Status::kOk ? Json(started.ProgramName()) : Json()},
          {"files", DigestsOf(*program.entry)}};
    }
  }
  return {};
}

Result<Fence> FenceFor(std::span<const PreparedScenario> scenarios, const OutsideRules& rules, const fs::path& folder,
                       const std::optional<SecretKey>& key) {
  if (ProgramsOf(scenarios).empty()) return Fence();
  Fence fence = rules.is_fenced ? Fence::Find() : Fence();
  std::error_code error;
  // Hide all named pipes. If the working folder or a scenario's folder is below a system folder, hide this folder, too.
  std::vector<fs::path> ours = {fs::current_path(error)};
  for (const PreparedScenario& scenario : scenarios) {
    const bool is_secret = !scenario.setup().seed.IsPlain();
    ours.push_back(Canonical(scenario.setup().file).parent_path());
    for (const ScenarioProgram& program : ProgramsIn(scenario.scenario())) {
      RETURN_IF_ERROR(CheckFiles(scenario, program));
      RETURN_IF_ERROR(CheckNames(program.entry->exec, program.entry->exec_places));
      std::vector<std::string> command = program.entry->exec;
      if (const auto found = FindProgram(command.front())) command.front() = *found;
      for (const fs::path& mine : ours) {
        if (IsOursInSystem(mine, Canonical(command.front()))) fence.Hide(mine);
      }
      if (fence.IsUp()) {
        for (const fs::path& shown : ViewOf(command, program.entry->files).shown) {
          for (const fs::path& pipe : Fence::PipesBelow(shown)) fence.Hide(pipe);
        }
      }
      // If worlds are secret, the sandbox must work, and the files that reveal the worlds must be hidden.
      if (!is_secret || !rules.is_fenced) continue;
      if (!fence.IsUp()) {
        return Fail({scenario.setup().file},
                    "this scenario has secret worlds, but its outside programs cannot run in a fence: {}; --no-fence "
                    "runs the programs without a fence, and the run's page reports this",
                    fence.description());
      }
      RETURN_IF_ERROR(CheckShown(scenario, program, ViewOf(command, program.entry->files), folder, key));
    }
  }
  // Hide the installed program and scenarios of Etude, but not the examples, because methods import them. Also hide the
  // clips that are publicly available.
  fence.Hide(ThisProgram());
  if (const fs::path shipped = ShippedFolder(); shipped.parent_path().filename() == "share") {
    fence.Hide(shipped / "scenarios");
    fence.Hide(shipped.parent_path().parent_path() / "bin/etude");
  }
  fence.Hide("/usr/share/assimp");
  if (!folder.empty()) fence.Hide(fs::absolute(folder).lexically_normal());
  if (key && !key->file.empty()) fence.Hide(Canonical(key->file));
  return fence;
}

void HideTruthIn(const fs::path& folder, Fence& fence) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  for (const char* name : {"truth", "recordings", "series", "columns", "cells.jsonl"}) fence.Hide(whole / name);
}

Json EncodeFence(const Fence& fence) {
  return {{"program", fence.program()},
          {"hidden", Texts(fence.hidden())},
          {"kept", Texts(fence.kept())},
          {"groups", fence.groups()},
          {"programs", fence.programs()}};
}

Fence DecodeFence(const Json& json) {
  const auto paths = [&](const char* key) {
    const auto texts = json.at(key).get<std::vector<std::string>>();
    return std::vector<fs::path>(texts.begin(), texts.end());
  };
  Fence fence = Fence::Of(json.at("program").get<std::string>(), paths("kept"), json.at("groups").get<std::string>());
  fence.ShareBy(json.at("programs").get<int>());
  for (const fs::path& path : paths("hidden")) fence.Hide(path);
  return fence;
}

}  // namespace etude
