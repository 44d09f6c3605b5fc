#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "io/files/json.h"

namespace etude {

/// Makes manifest.json, which repeats the run. Its bytes do not depend on how or where it is run. Fails, with an error
/// of this machine, when the renderer is there and cannot be loaded: the libraries would not be those of the next
/// start.
Result<Json> MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                          const std::string& version);

/// The suite that a manifest describes. Fails when it is of another schema.
Result<SuiteSetup> ReadManifest(const FilePath& path);

/// Checks that `scenarios`, prepared from the suite of the manifest at `path`, have the very clips that it had then.
Result<void> CheckClips(const FilePath& path, std::span<const PreparedScenario> scenarios);

/// A run made ready to be gone on with, merged or repeated.
struct PreparedRun {
  SuiteSetup suite;
  std::vector<PreparedScenario> scenarios;
};

/// Makes ready what a manifest describes, with the very clips that it had then.
/// Secret worlds need their key.
Result<PreparedRun> PrepareRun(const FilePath& manifest, const std::optional<SecretKey>& key = {});

/// A value of a manifest that is another in a second one.
struct JsonDifference {
  std::string path;       ///< "libraries.libLLVM-15.so.1", "scenarios[0].trials"
  std::string then, now;  ///< cut short; "absent"

  bool operator==(const JsonDifference&) const = default;
};

/// Finds all values that two manifests do not share.
std::vector<JsonDifference> CompareManifests(const Json& then, const Json& now);
/// Tells the first few of them: "seed was 1 and is 2; …".
std::string InWords(std::span<const JsonDifference> differences);
/// Tells whether all of them are builds of libraries.
bool AreOfLibraries(std::span<const JsonDifference> differences);
/// The differences that the folder of a run notes.
Result<std::vector<JsonDifference>> OtherLibrariesOf(const std::filesystem::path& folder);
/// Notes in the run's folder, once, that cells of it were computed under other libraries than its manifest names.
Result<void> RecordOtherLibraries(const std::filesystem::path& folder, std::span<const JsonDifference> differences);

/// Makes host.json: where and how the run was made.
Json DescribeHost(const std::string& command_line, int jobs, double seconds);

/// A fingerprint of the program that is running: two builds have two.
Result<std::string> BuildDigest();

}  // namespace etude
