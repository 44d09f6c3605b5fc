#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/outside/outside_method.h"
#include "bench/run/secret_key.h"
#include "bench/run/setup.h"
#include "io/files/json.h"
#include "io/process/fence.h"

namespace etude {

/// The rules for running the outside programs of a run.
struct OutsideRules {
  bool is_fenced = true;    ///< true: outside programs run in the sandbox, if the kernel allows it
  bool allow_exec = false;  ///< true: also run programs that a manifest or a pack names, which may come from a stranger
};

/// Returns the options with which a program of a scenario is started. The program's standard error goes to a file in
/// `error_folder` (ErrorFileOf).
OutsideOptions OptionsOf(const PreparedScenario& scenario, const ScenarioProgram& program,
                         const std::string& error_folder, const Fence& fence);

/// Adds to a manifest what identifies each outside program: the name and version that it states in the handshake (null
/// if the handshake fails), and the digests of its files. These are the files that its keys `exec` and `files` name. If
/// `files` is empty, they are also the files beside its script that have the script's extension. Every program is
/// started once. Fails if this machine cannot start one.
Result<void> AddPrograms(std::span<const PreparedScenario> scenarios, const Fence& fence, Json& manifest);

/// Lists every method and every metric that is a program, e.g. "python3 my_solver.py (ik-weights/mine)".
std::vector<std::string> ProgramsOf(std::span<const PreparedScenario> scenarios);

/// Fails if the scenarios of `file` contain programs and the rules do not allow programs. The error lists the programs.
Result<void> CheckPrograms(const std::string& file, std::span<const PreparedScenario> scenarios,
                           const OutsideRules& rules);

/// Makes the sandbox for the outside programs of these scenarios. The sandbox hides the run's `folder` ("" = none).
/// Returns an empty Fence if there are no outside programs. Fails if a program's key `exec` or `files` names a file
/// that does not exist, or if `files` names a folder to which programs write. If worlds are secret and the rules do not
/// switch the sandbox off, fails also if this machine cannot make a sandbox, or if an outside program could read the
/// key's file, the run's folder or the scenario's file.
Result<Fence> FenceFor(std::span<const PreparedScenario> scenarios, const OutsideRules& rules,
                       const std::filesystem::path& folder, const std::optional<SecretKey>& key);

/// Makes the sandbox hide the ground truth in an exported data set or in a run's folder.
void HideTruthIn(const std::filesystem::path& folder, Fence& fence);

/// EncodeFence writes a sandbox as JSON, for the set-up of a worker. DecodeFence reads this JSON.
Json EncodeFence(const Fence& fence);
Fence DecodeFence(const Json& json);

}  // namespace etude
