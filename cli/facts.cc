#include "cli/facts.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace etude {

CLI::Option* AddJson(CLI::App& command, bool& as_json) {
  return command.add_flag("--json", as_json, "For programs (docs/schemas/facts.schema.json)");
}

Result<void> PrintFacts(const std::string& command, Json facts) {
  Json all = {{"command", command}, {"etude", ETUDE_VERSION}};
  all.update(facts);
  ASSIGN_OR_RETURN(const auto text, WriteJson(all));
  fmt::print("{}\n", text);
  return {};
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
  }
  return {{"comparisons", comparison.moves.size()},
          {"moves", std::move(moves)},
          {"only_before", comparison.only_before},
          {"only_after", comparison.only_after},
          {"settings_changed", comparison.settings_changed}};
}

}  // namespace etude
