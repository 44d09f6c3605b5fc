#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// Makes manifest.json, from which the run can be repeated. Its bytes do not depend on how or where it is run. Fails if
/// the renderer is installed but cannot be loaded, because the list of libraries would be incomplete.
Result<Json> MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                          const std::string& version);

/// Reads the suite that a manifest describes. Fails if its schema has another version.
Result<SuiteSetup> ReadManifest(const FilePath& path);

/// Fails if the clips of `scenarios` are not those that the manifest at `path` describes.
Result<void> CheckClips(const FilePath& path, std::span<const PreparedScenario> scenarios);

/// A run that is prepared to be resumed, merged or repeated.
struct PreparedRun {
  SuiteSetup suite;
  std::vector<PreparedScenario> scenarios;
};

/// Prepares the run that a manifest describes, with the same clips (CheckClips). Secret worlds need their key.
Result<PreparedRun> PrepareRun(const FilePath& manifest, const std::optional<SecretKey>& key = {});

/// A value that differs between two manifests.
struct JsonDifference {
  std::string path;       ///< "libraries.libLLVM-15.so.1", "scenarios[0].trials"
  std::string then, now;  ///< shortened; "absent" if missing

  bool operator==(const JsonDifference&) const = default;
};

/// Returns all values that differ between two manifests.
std::vector<JsonDifference> CompareManifests(const Json& then, const Json& now);
/// Lists the first few differences: "seed was 1 and is 2; …".
std::string InWords(std::span<const JsonDifference> differences);
/// Returns true if all of them are builds of libraries.
bool AreOfLibraries(std::span<const JsonDifference> differences);
/// Reads the differences of libraries that a run's folder records.
Result<std::vector<JsonDifference>> OtherLibrariesOf(const std::filesystem::path& folder);
/// Records in the run's folder which libraries changed while its cells were computed, each once.
Result<void> RecordOtherLibraries(const std::filesystem::path& folder, std::span<const JsonDifference> differences);

/// Makes host.json, which says where and how the run was made.
Json DescribeHost(const std::string& command_line, int jobs, double seconds);

/// Returns a digest of the running program, which differs between builds.
Result<std::string> BuildDigest();

}  // namespace etude
