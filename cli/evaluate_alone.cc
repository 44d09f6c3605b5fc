#include "cli/evaluate_alone.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "bench/run/shipped.h"
#include "bench/tasks/plausibility/judge.h"
#include "bench/tasks/plausibility/options.h"
#include "cli/commands.h"
#include "cli/named_results.h"
#include "engine/base/names.h"
#include "engine/document/node.h"
#include "engine/retargeting/map_file.h"
#include "io/drawing/numbers.h"
#include "io/files/files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Reads limits from the file `name`, or from the shipped file of that name ("recorded").
Result<std::map<std::string, double>> ReadLimitsFile(const std::string& name) {
  std::error_code none;
  const fs::path folder = ShippedFolder() / "scenarios" / "limits", shipped = folder / (name + ".yaml");
  fs::path file = name;
  if (!fs::exists(name, none)) {
    std::vector<std::string> known;
    for (const auto& entry : fs::directory_iterator(folder, none)) known.push_back(entry.path().stem().string());
    std::ranges::sort(known);
    if (std::ranges::find(known, name) == known.end()) {
      return Fail({"--limits"}, "there is no such file of limits; {}, or the path of a file",
                  UnknownName("name of limits", name, known));
    }
    file = shipped;
  }
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(const auto node, ParseYaml(text, file.string()));
  Fields fields(node, "a file of limits");
  auto limits = ReadLimits(fields);
  RETURN_IF_ERROR(fields.Finish());
  if (limits.empty())
    return Fail({file.string()},
                "contains no limit; allowed: one metric and its limit per line, such as skates_share: 0.02");
  return limits;
}

/// For each kind of fault: a metric that is above 0 if a clip shows the fault, and the word for the fault.
constexpr std::pair<std::string_view, std::string_view> kTelling[] = {
    {"floats_share", "floats"}, {"sinks_share", "sinks"},   {"skates_share", "skates"},
    {"jumps", "jumps"},         {"pops", "pops"},           {"freezes_share", "freezes"},
    {"bends_share", "bends"},   {"passes_share", "passes"}, {"stretches_max_percent", "stretches"},
    {"torn_max_cm", "torn"},    {"gaps_share", "gaps"},     {"wrong_rate", "wrong rate"}};

/// Prints the number of lines and the heading ("2 not judged:"), then at most twenty lines.
void PrintLines(std::string_view heading, const std::vector<std::string>& lines) {
  fmt::print("{} {}{}\n", lines.size(), heading, lines.empty() ? "" : ":");
  for (const std::string& line : FirstLines(lines, 20, "more; `etude rows` prints all cells"))
    fmt::print("  {}\n", line);
}

}  // namespace

Result<std::string> ScenarioOfMotions(const std::vector<std::string>& files, const AloneOptions& options,
                                      const std::string& people) {
  ASSIGN_OR_RETURN(const auto methods, ReadMotions(files));
  std::string text = "scenario: evaluate\nquestion: Could a person have made these motions?\ntask: plausibility\n";
  if (options.floor_m) text += fmt::format("floor_m: {}\n", *options.floor_m);
  if (!people.empty()) text += fmt::format("people: {}\n", QuotedInYaml(people));
  if (!options.limits.empty()) {
    ASSIGN_OR_RETURN(const auto limits, ReadLimitsFile(options.limits));
    text += "at_most:\n";
    for (const auto& [id, limit] : limits) text += fmt::format("  {}: {}\n", id, limit);
  }
  return text + MethodsInYaml(methods);
}

Triage TriageOf(const RunData& run) {
  Triage triage;
  ForEachRow(run, [&](const Row& row, std::size_t) {
    const std::string name = fmt::format("{}, {}: ", row.method, row.clip);
    if (row.result.status != Status::kOk) {
      if (row.result.status != Status::kSkipped) triage.not_judged.push_back(name + row.result.reason);
      return;
    }
    ++triage.clips;
    const std::string line = name + std::string(FaultWords(row.result.reason));
    for (const auto& [id, word] : kTelling) {
      if (ValueOf(row, id).value_or(0) > 0) ++triage.kinds[std::string(word)];
    }
    const auto is_within = ValueOf(row, "within_limits");
    triage.has_limits |= is_within.has_value();
    const bool is_faulty = ValueOf(row, "faults").value_or(0) > 0;
    triage.fault_free += is_faulty ? 0 : 1;
    if (is_within == 0.0) {
      triage.beyond_limits.push_back(line);
    } else if (is_faulty) {
      triage.faulty.push_back(line);
    }
  });
  return triage;
}

void PrintTriage(const Triage& triage) {
  fmt::print("{} of {} without a fault{}\n", triage.fault_free, Plural(static_cast<long long>(triage.clips), "clip"),
             triage.not_judged.empty() ? "" : fmt::format(", {} more could not be judged", triage.not_judged.size()));
  for (const auto& [kind, clips] : triage.kinds) fmt::print("  {:<10}  {:>6}\n", kind, clips);
  if (!triage.kinds.empty()) fmt::print("  `etude list faults` explains each fault\n");
  if (triage.has_limits) PrintLines("beyond the limits", triage.beyond_limits);
  if (!triage.faulty.empty())
    PrintLines(triage.has_limits ? "with faults that are within the limits" : "with faults", triage.faulty);
  if (!triage.not_judged.empty()) PrintLines("not judged", triage.not_judged);
}

}  // namespace etude
