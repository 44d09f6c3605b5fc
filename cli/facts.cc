#include "cli/facts.h"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace etude {

CLI::Option* AddJson(CLI::App& command, bool& as_json) {
  return command.add_flag("--json", as_json, "Print JSON (docs/schemas/facts.schema.json)");
}

Result<void> PrintFacts(const std::string& command, Json facts) {
  Json all = {{"command", command}, {"etude", ETUDE_VERSION}};
  all.update(facts);
  ASSIGN_OR_RETURN(const auto text, WriteJson(all));
  fmt::print("{}\n", text);
  return {};
}

StdoutToStderr::StdoutToStderr(bool is_active) {
  if (!is_active) return;
  std::fflush(stdout);
  output_ = ::dup(STDOUT_FILENO);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

void StdoutToStderr::End() {
  if (output_ < 0) return;
  std::fflush(stdout);
  ::dup2(output_, STDOUT_FILENO);
  ::close(output_);
  output_ = -1;
}

Json FactsOf(const SnapshotComparison& comparison) {
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json moves = Json::array();
  for (const MetricMove& move : comparison.moves) {
    if (move.movement == Movement::kSame) continue;
    moves.push_back({{"scenario", move.identity.scenario},
                     {"condition", move.identity.condition},
                     {"method", move.identity.method},
                     {"metric", move.identity.metric},
                     {"movement", MovementWords(move.movement)},
                     {"before", number(move.before)},
                     {"after", number(move.after)},
                     {"worlds", move.worlds},
                     {"differing", move.differing},
                     {"far_worse", move.tail.size()}});
    if (!move.comparison.not_alike.empty()) moves.back()["not_alike"] = move.comparison.not_alike;
  }
  return {{"comparisons", comparison.moves.size()},
          {"moves", std::move(moves)},
          {"only_before", comparison.only_before},
          {"only_after", comparison.only_after},
          {"settings_changed", comparison.settings_changed}};
}

}  // namespace etude
