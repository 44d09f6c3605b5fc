#include "bench/replay/cell_choice.h"

#include <algorithm>
#include <utility>

#include "bench/replay/replay.h"
#include "bench/run/manifest.h"
#include "engine/base/names.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// Returns the methods of a run. Each entry says why the method's cells cannot be run again, or that they can.
std::vector<MethodRows> MethodsOf(const ReplayOptions& options, const PreparedRun& prepared) {
  const std::optional<ScoredMethod>& scored = prepared.suite.scored;
  std::vector<MethodRows> methods;
  for (const PreparedScenario& one : prepared.scenarios) {
    for (const MethodEntry& method : one.scenario().methods) {
      MethodRows& rows = methods.emplace_back();
      rows.scenario = one.scenario().name;
      rows.method = method.name;
      const bool asks = !method.exec.empty() || !one.scenario().outside_metrics.empty();
      if (scored && method.name == scored->name) {
        rows.why_not = "their answers were read from files and scored";
      } else if (options.without_programs && asks) {
        rows.why_not = "they run programs (--allow-exec allows it)";
      }
    }
  }
  return methods;
}

class MethodTable {
 public:
  explicit MethodTable(std::vector<MethodRows>& methods) {
    for (MethodRows& method : methods) by_name_[{method.scenario, method.method}] = &method;
  }
  /// Returns the entry of the row's method; null if the run has no such method.
  MethodRows* Find(const Row& row) const {
    const auto found = by_name_.find({row.scenario, row.method});
    return found == by_name_.end() ? nullptr : found->second;
  }

 private:
  std::map<std::pair<std::string, std::string>, MethodRows*> by_name_;
};

/// Returns the indices of the rows that the options name.
Result<std::set<std::size_t>> FindCells(const ReplayOptions& options, const RunData& run, const MethodTable& methods) {
  std::set<std::size_t> places;
  for (const std::string& wanted : options.cells) {
    const auto place = FindRow(run, wanted);
    if (!place) {
      std::vector<std::string> known;
      ForEachRow(run, [&](const Row& row, std::size_t /*place*/) { known.push_back(row.Id()); });
      const std::string nearest = NearestName(wanted, known);
      const std::string advice = !nearest.empty() ? "; did you mean '" + nearest + "'?"
                                 : !known.empty() ? ", such as '" + known.front() + "'"
                                                  : "";
      return Fail({options.folder, 0, 0}, "contains no cell '{}'{}", wanted, advice);
    }
    const MethodRows* const method = methods.Find(RowAt(run, *place));
    if (method == nullptr) {
      return Fail({options.folder}, "contains the cell {}, but its manifest does not contain this cell", wanted);
    }
    if (!method->why_not.empty()) {
      return Fail({options.folder, 0, 0}, "cannot run cell '{}' and the other cells of its method again: {}", wanted,
                  method->why_not);
    }
    places.insert(*place);
  }
  return places;
}

}  // namespace

bool IsRecorded(const PreparedRun& run, const Row& row) {
  return std::ranges::any_of(run.scenarios, [&](const PreparedScenario& one) {
    const RecordingSelection& kept = one.scenario().recordings;
    return one.scenario().name == row.scenario && kept.KeepsTrial(row.trial) && kept.KeepsMethod(row.method);
  });
}

Result<CellChoice> ChooseCells(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared) {
  CellChoice choice;
  choice.methods = MethodsOf(options, prepared);
  const MethodTable methods(choice.methods);
  if (!options.cells.empty()) {
    ASSIGN_OR_RETURN(choice.places, FindCells(options, run, methods));
    return choice;
  }
  // Count the rows of each method. If the options require it, choose all rows with recordings.
  std::optional<std::string> unexpected;
  const auto is_chosen_anyway = [&](const Row& row) { return options.recorded_too && IsRecorded(prepared, row); };
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    MethodRows* const method = methods.Find(row);
    if (method == nullptr) unexpected = row.Id();
    if (method == nullptr) return;
    ++method->rows;
    if (DependsOnMachine(row.result.status)) ++method->by_machine[std::string(StatusName(row.result.status))];
    if (!method->why_not.empty()) return;
    if (is_chosen_anyway(row)) {
      choice.places.insert(place);
      ++choice.recorded;
    } else {
      ++method->drawable;
      ++choice.drawable;
    }
  });
  if (unexpected)
    return Fail({options.folder}, "contains the cell {}, but its manifest does not contain this cell", *unexpected);
  // Draw by selection sampling (Knuth, volume 2, algorithm S): take each row with probability (number still to draw) /
  // (number of rows left).
  choice.dice = options.dice.value_or(run.seed);
  const std::size_t wanted = std::min(options.sample.value_or(choice.drawable), choice.drawable);
  std::size_t left = choice.drawable;
  RandomStream dice({.suite_seed = choice.dice, .scenario = "replay", .trial = 0}, "sample");
  ForEachRow(run, [&](const Row& row, std::size_t place) {
    if (choice.drawn == wanted || !methods.Find(row)->why_not.empty() || is_chosen_anyway(row)) return;
    if (dice.IndexBelow(left--) >= wanted - choice.drawn) return;
    choice.places.insert(place);
    ++choice.drawn;
  });
  return choice;
}

std::vector<MissedForgery> WhatIsMissed(const CellChoice& choice) {
  if (choice.drawn == choice.drawable) return {};
  const auto missed = [&](const std::string& method, std::size_t forged, std::size_t cells) {
    return MissedForgery{method, forged, cells, ChanceOfMissing(choice.drawable, choice.drawn, forged)};
  };
  const MethodRows* fewest = nullptr;
  for (const MethodRows& method : choice.methods) {
    if (method.drawable > 0 && (fewest == nullptr || method.drawable < fewest->drawable)) fewest = &method;
  }
  return {missed("", (choice.drawable + 19) / 20, choice.drawable),
          missed(fewest->scenario + "/" + fewest->method, (fewest->drawable + 1) / 2, fewest->drawable),
          missed("", 1, choice.drawable)};
}

double ChanceOfMissing(std::size_t cells, std::size_t drawn, std::size_t forged) {
  if (drawn + forged > cells) return 0;
  // Exchanging `drawn` and `forged` does not change the probability, so the loop runs over the smaller number.
  const auto [fewer, more] = std::minmax(drawn, forged);
  double chance = 1;
  for (std::size_t i = 0; i < fewer; ++i) {
    chance *= static_cast<double>(cells - more - i) / static_cast<double>(cells - i);
  }
  return chance;
}

}  // namespace etude
