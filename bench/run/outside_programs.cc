#include "bench/run/outside_programs.h"

#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace etude {

namespace fs = std::filesystem;

std::vector<std::string> ProgramsOf(std::span<const PreparedScenario> scenarios) {
  std::vector<std::string> programs;
  for (const PreparedScenario& scenario : scenarios) {
    for (const MethodEntry& method : scenario.scenario().methods) {
      if (method.exec.empty()) continue;
      programs.push_back(fmt::format("{} ({}/{})", fmt::join(method.exec, " "), scenario.scenario().name, method.name));
    }
  }
  return programs;
}

Result<void> CheckPrograms(const std::string& file, std::span<const PreparedScenario> scenarios,
                           const OutsideRules& rules) {
  const std::vector<std::string> programs = ProgramsOf(scenarios);
  if (programs.empty() || rules.allow_exec) return {};
  return Fail({file, 0, 0}, "would run programs, which --allow-exec allows: {}", fmt::join(programs, "; "));
}

Fence FenceFor(std::span<const PreparedScenario> scenarios, const OutsideRules& rules, const fs::path& folder) {
  if (!rules.is_fenced || ProgramsOf(scenarios).empty()) return {};
  Fence fence = Fence::Find();
  if (std::error_code error; fence.IsUp() && fs::is_directory(folder, error)) {
    fence.Hide(fs::absolute(folder).lexically_normal());
  }
  return fence;
}

Json EncodeFence(const Fence& fence) {
  Json hidden = Json::array();
  for (const fs::path& folder : fence.hidden()) hidden.push_back(folder.string());
  return {{"program", fence.program()}, {"hidden", std::move(hidden)}};
}

Fence DecodeFence(const Json& json) {
  Fence fence = Fence::Of(json.at("program").get<std::string>());
  for (const Json& folder : json.at("hidden")) fence.Hide(folder.get<std::string>());
  return fence;
}

}  // namespace etude
