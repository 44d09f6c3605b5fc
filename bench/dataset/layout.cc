#include "bench/dataset/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "engine/base/text.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameLength = 120;  // bytes; file systems allow up to 255

bool IsPlain(char c) {
  return IsLower(c) || IsUpper(c) || IsDigit(c) || std::string_view("._=,+-").find(c) != std::string_view::npos;
}

std::string TrialName(int trial) { return fmt::format("{:03}", trial); }

/// Returns the name of the world to which an answer file belongs: "007" for "7.json", "007.json" and "007.JSON".
/// Returns nullopt if the extension is not .json.
std::optional<std::string> WorldOf(const fs::path& name) {
  const std::string stem = name.stem().string();
  if (!EqualsIgnoringCase(name.extension().string(), ".json")) return std::nullopt;
  const auto trial = ParseNumber<int>(stem);
  return trial && *trial >= 0 ? TrialName(*trial) : stem;
}

/// Lists all regular files below `folder`, sorted by name; the paths are relative to `folder`. Skips names that begin
/// with a dot. Reports links, pipes and other special files in `faults`. A file with several hard links is reported
/// too, because it may be a link to the truth.
Result<std::vector<fs::path>> AnswersBelow(const fs::path& folder, PredictionFaults& faults) {
  const Place place{folder.string(), 0, 0};
  std::error_code error;
  if (!fs::is_directory(folder, error))
    return Fail(place, "is not an existing folder; allowed: a folder of predictions");
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::file_status status = entry->symlink_status(error);
    const fs::path name = entry->path().lexically_relative(folder);
    if (name.filename().string().starts_with('.')) {
      if (fs::is_directory(status)) entry.disable_recursion_pending();
    } else if (fs::is_regular_file(status) && entry->hard_link_count(error) == 1) {
      files.push_back(name);
    } else if (!fs::is_directory(status)) {
      const char* const what = fs::is_symlink(status) || fs::is_regular_file(status) ? "is a link" : "is no file";
      faults.broken.push_back(
          fmt::format("{} {}; allowed: regular files that are not links", name.generic_string(), what));
    }
  }
  if (error) return Fail(place, "cannot be read: {}", error.message());
  std::sort(files.begin(), files.end());
  std::sort(faults.broken.begin(), faults.broken.end());
  return files;
}

}  // namespace

std::vector<std::string> ConditionFolders(const Scenario& scenario) {
  std::vector<std::string> folders;
  for (const Condition& condition : scenario.conditions) {
    std::string name = condition.swept.empty() ? "all" : CompactLabel(condition.swept).substr(0, kMaxNameLength);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !IsPlain(c); }, '_');
    std::string unique = name;
    for (int copy = 2; std::find(folders.begin(), folders.end(), unique) != folders.end(); ++copy) {
      unique = fmt::format("{}~{}", name, copy);
    }
    folders.push_back(std::move(unique));
  }
  return folders;
}

std::string WorldName(const PreparedScenario& scenario, int condition, int trial) {
  if (scenario.setup().seed.IsPlain()) return TrialName(trial);
  return fmt::format("{:016x}", RandomStream(scenario.KeyOf(condition, trial), "exchange/export").Bits());
}

Result<PredictionFiles> FindPredictions(const fs::path& folder, const Plan& plan, PredictionFaults& faults) {
  ASSIGN_OR_RETURN(const auto files, AnswersBelow(folder, faults));
  // Map each world, by its folder "SCENARIO/CONDITION" and its name, to its index in the plan.
  std::map<std::pair<std::string, std::string>, std::size_t> worlds;
  for (std::size_t w = 0; w < plan.world_count(); ++w) {
    const Scenario& scenario = plan.scenario_of(w).scenario();
    const World& world = plan.world(w);
    worlds[{scenario.name + "/" + ConditionFolders(scenario)[world.condition],
            WorldName(plan.scenario_of(w), world.condition, world.trial)}] = w;
  }
  PredictionFiles found(plan.world_count());
  for (const fs::path& file : files) {
    const std::optional<std::string> name = WorldOf(file.filename());
    const auto world = name ? worlds.find({file.parent_path().generic_string(), *name}) : worlds.end();
    if (world == worlds.end()) {
      faults.extra.push_back(file.generic_string());
    } else if (auto& place = found[world->second]) {
      faults.duplicate.push_back(fmt::format("{} (as {})", file.generic_string(), place->below().generic_string()));
    } else {
      place = Inside(folder) / file;
    }
  }
  return found;
}

}  // namespace etude
