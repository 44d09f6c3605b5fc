#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// Makes manifest.json, from which the run can be repeated. Its bytes do not depend on the working folder or on the
/// number of workers. Fails if the renderer is installed but cannot be loaded, because the list of libraries would then
/// be incomplete.
Result<Json> MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                          const std::string& version);

/// Reads the suite that a manifest describes. Fails if the manifest's schema has another version than this program's.
Result<SuiteSetup> ReadManifest(const FilePath& path);

/// Fails if the clips of `scenarios` differ from the clips that the manifest at `path` describes.
Result<void> CheckClips(const FilePath& path, std::span<const PreparedScenario> scenarios);

/// A run, read from its manifest, that can be resumed, merged or repeated.
struct PreparedRun {
  SuiteSetup suite;
  std::vector<PreparedScenario> scenarios;
};

/// Prepares the run that a manifest describes. Fails if the run's clips have changed (CheckClips). If the worlds are
/// secret, the key is needed.
Result<PreparedRun> PrepareRun(const FilePath& manifest, const std::optional<SecretKey>& key = {});

/// A value that differs between two manifests.
struct JsonDifference {
  std::string path;       ///< place of the value, e.g. "libraries.libLLVM-15.so.1", "scenarios[0].trials"
  std::string then, now;  ///< the two values, shortened; "absent" if missing

  bool operator==(const JsonDifference&) const = default;
};

/// Returns the values that differ between an earlier and the present manifest. If a text has several lines, the
/// difference shows only the first line that differs; `path` ends with this line's number. If a text of the suite
/// differs, the digests of scenarios are left out.
std::vector<JsonDifference> CompareManifests(const Json& then, const Json& now);
/// Describes the first few differences in words: "seed was 1 and is 2; …".
std::string InWords(std::span<const JsonDifference> differences);
/// Returns the differences that concern outside programs (AddPrograms).
std::vector<JsonDifference> OfPrograms(const std::vector<JsonDifference>& differences);
/// Fails if a scenario has outside programs that `manifest` does not list. `place` is the place of the error.
Result<void> RequirePrograms(const Json& manifest, std::span<const PreparedScenario> scenarios, const Place& place);
/// Returns true if the differences concern only libraries: every path begins with "libraries.".
bool AreOfLibraries(std::span<const JsonDifference> differences);
/// Reads the differences of libraries that are recorded in a run's folder.
Result<std::vector<JsonDifference>> OtherLibrariesOf(const std::filesystem::path& folder);
/// Records in the run's folder which libraries changed while the run's cells were computed. Each difference is recorded
/// once.
Result<void> RecordOtherLibraries(const std::filesystem::path& folder, std::span<const JsonDifference> differences);

/// Returns the digest that a manifest states as `environment`, of the variables that host.json lists
/// (PinnedEnvironment).
std::string DigestOfEnvironment(const std::vector<std::string>& pinned);

/// Makes host.json, which describes the machine, the command line and the duration of the run.
Json DescribeHost(const std::string& command_line, int jobs, double seconds);

/// Returns a digest of the running program. It differs between builds.
Result<std::string> BuildDigest();

}  // namespace etude
