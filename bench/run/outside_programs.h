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

/// The rules by which methods outside may be run.
struct OutsideRules {
  bool is_fenced = true;    ///< where the kernel allows it
  bool allow_exec = false;  ///< also those that a manifest or a pack names, which may come from anybody
};

/// "python3 my_solver.py (ik-weights/mine)" of every method and metric that is a program.
std::vector<std::string> ProgramsOf(std::span<const PreparedScenario> scenarios);

/// Refuses to run the programs that `file` names unless that is allowed, and lists them.
Result<void> CheckPrograms(const std::string& file, std::span<const PreparedScenario> scenarios,
                           const OutsideRules& rules);

/// The fence for the methods outside of these scenarios, which shall not see the run's `folder` ("" = there is none).
/// It is looked for only where there are such methods. Under a secret seed, a machine without a fence is refused unless
/// none is asked for, and so are methods that would be shown a scenario, the folder or the file of the key.
Result<Fence> FenceFor(std::span<const PreparedScenario> scenarios, const OutsideRules& rules,
                       const std::filesystem::path& folder, const std::optional<SecretKey>& key);

/// Has no program see the truth that an exported folder or a run holds, if `folder` is one.
void HideTruthIn(const std::filesystem::path& folder, Fence& fence);

/// Encodes a fence for a worker's set-up, and decodes it there.
Json EncodeFence(const Fence& fence);
Fence DecodeFence(const Json& json);

}  // namespace etude
