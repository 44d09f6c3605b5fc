#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bench/run/secret_key.h"
#include "bench/run/setup.h"
#include "io/files/json.h"
#include "io/process/fence.h"

namespace etude {

/// How the programs of a run may be run.
struct OutsideRules {
  bool is_fenced = true;    ///< use the sandbox, if the kernel allows it
  bool allow_exec = false;  ///< also run programs that a manifest or a pack names, which may come from a stranger
};

/// Lists every method and metric that is a program: "python3 my_solver.py (ik-weights/mine)".
std::vector<std::string> ProgramsOf(std::span<const PreparedScenario> scenarios);

/// Fails if `file` names programs and the rules do not allow them; the message lists the programs.
Result<void> CheckPrograms(const std::string& file, std::span<const PreparedScenario> scenarios,
                           const OutsideRules& rules);

/// Makes the fence for the programs of these scenarios, which hides the run's `folder` ("" = none). Without programs,
/// the fence is empty. Fails if worlds are secret and this machine has no fence, unless the rules ask for none; and if
/// a program would see a scenario with secret worlds, the run's folder or the key's file.
Result<Fence> FenceFor(std::span<const PreparedScenario> scenarios, const OutsideRules& rules,
                       const std::filesystem::path& folder, const std::optional<SecretKey>& key);

/// Hides the truth that an exported folder or a run holds.
void HideTruthIn(const std::filesystem::path& folder, Fence& fence);

/// Encodes a fence for the set-up of a worker, and decodes it.
Json EncodeFence(const Fence& fence);
Fence DecodeFence(const Json& json);

}  // namespace etude
