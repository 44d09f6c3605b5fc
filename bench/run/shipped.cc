#include "bench/run/shipped.h"

#include <algorithm>

#include "engine/base/names.h"
#include "io/files/files.h"
#include "io/files/own_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSuites[] = {"quick", "paper", "full"};
constexpr const char* kScenarioFolder = "scenarios";
constexpr const char* kEnding = ".yaml";

/// Returns the paths of the *.yaml files in a folder, sorted.
std::vector<fs::path> ScenarioFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == kEnding) files.push_back(entry->path());
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

fs::path ShippedFolder() { return FolderWith(fs::path(kScenarioFolder) / kSuites[0]); }

std::vector<std::string> ShippedScenarios() {
  std::vector<std::string> names;
  for (const char* suite : kSuites) {
    for (const fs::path& file : ScenarioFilesIn(ShippedFolder() / kScenarioFolder / suite)) {
      names.push_back(fmt::format("{}/{}", suite, file.stem().string()));
    }
  }
  std::ranges::sort(names);
  return names;
}

fs::path FindShipped(const std::string& name) {
  const fs::path top = ShippedFolder();
  if (top.empty()) return {};
  const fs::path path = top / kScenarioFolder / name;
  if (std::ranges::find(kSuites, name) != std::end(kSuites)) return path;
  const std::vector<std::string> names = ShippedScenarios();
  return std::ranges::binary_search(names, name) ? fs::path(path.string() + kEnding) : fs::path();
}

namespace {

/// Returns the name of a scenario that is nearest to `name`: as a whole, or without the suite; or a name that begins
/// with `name` without the suite. Returns "" if there is none.
std::string NearestScenario(const std::string& name, const std::vector<std::string>& names) {
  if (std::string nearest = NearestName(name, names); !nearest.empty()) return nearest;
  std::string own = fs::path(name).filename().string();
  std::ranges::replace(own, '-', '_');
  std::vector<std::string> own_names;
  for (const std::string& each : names) own_names.push_back(fs::path(each).filename().string());
  auto found = std::ranges::find(own_names, NearestName(own, own_names));
  if (found == own_names.end() && own.size() >= 3)
    found = std::ranges::find_if(own_names, [&](const std::string& each) { return each.starts_with(own); });
  return found == own_names.end() ? "" : names[static_cast<std::size_t>(found - own_names.begin())];
}

}  // namespace

tl::unexpected<Error> UnknownShippedName(const std::string& path) {
  std::vector<std::string> names = ShippedScenarios();
  names.insert(names.end(), std::begin(kSuites), std::end(kSuites));
  // In the path of a file in a clone of the repository, such as "scenarios/quick/ik.yaml", the name of the scenario is
  // the text between "scenarios/" and ".yaml".
  std::string name = fs::path(path).lexically_normal().string();
  const std::string folder = std::string(kScenarioFolder) + "/";
  if (const std::size_t at = name.rfind(folder); at != std::string::npos) name.erase(0, at + folder.size());
  if (name.ends_with(kEnding)) name.resize(name.size() - std::string_view(kEnding).size());
  if (name.ends_with('/')) name.pop_back();
  const std::string nearest = NearestScenario(name, names);
  return Fail({path},
              "no such scenario file or folder, and etude has no scenario with this name{}; 'etude list scenarios' "
              "lists the names",
              nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

fs::path FindScenario(const std::string& path) {
  std::error_code error;
  const fs::file_status here = fs::status(path, error);
  const bool holds_none = fs::is_directory(here) && ScenarioFilesIn(path).empty();
  if (here.type() != fs::file_type::not_found && !holds_none) return path;
  const fs::path shipped = FindShipped(path);
  return shipped.empty() && holds_none ? fs::path(path) : shipped;
}

std::vector<Error> DescribeAmbiguousPaths(const std::vector<std::string>& paths) {
  std::vector<Error> told;
  for (const std::string& path : paths) {
    const fs::path shipped = FindShipped(path);
    std::error_code error;
    if (shipped.empty() || !fs::exists(path, error) || fs::equivalent(path, shipped, error)) continue;
    told.push_back({{path},
                    FindScenario(path) == shipped
                        ? "this folder contains no scenario (*.yaml), so etude uses its own scenario with this name"
                        : "etude uses this file or folder instead of its own scenario with the same name"});
  }
  return told;
}

Result<std::vector<fs::path>> CopyShipped(const std::string& name, const fs::path& folder) {
  const fs::path found = FindShipped(name);
  if (found.empty()) return UnknownShippedName(name);
  std::error_code error;
  const bool is_suite = fs::is_directory(found, error);
  const fs::path into = is_suite ? folder / name : folder;
  std::vector<fs::path> written;
  const std::vector<fs::path> files = is_suite ? ScenarioFilesIn(found) : std::vector<fs::path>{found};
  for (const fs::path& file : files) {
    const fs::path copy = into / file.filename();
    if (fs::exists(copy, error)) return Fail({copy.string()}, "already exists; nothing was copied");
  }
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
    RETURN_IF_ERROR(WriteFileAtomically(into / file.filename(), text));
    written.push_back(into / file.filename());
  }
  return written;
}

}  // namespace etude
