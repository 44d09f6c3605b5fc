#include "reports/gate_report.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <map>

#include "reports/gate_table.h"
#include "reports/junit.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

// A comment on a pull request takes 65,536 characters; a table of more rows is read by nobody.
constexpr std::size_t kMostRows = 100;
constexpr std::size_t kMostWorldsEach = 5, kMostWorlds = 40;

std::string MoveTable(const std::vector<GateTableRow>& rows) {
  std::string text =
      "\n| | scenario | condition | method | metric | baseline | now | difference (95 %) | p | worlds |\n"
      "|---|---|---|---|---|---:|---:|---:|---:|---:|\n";
  for (std::size_t i = 0; i < std::min(kMostRows, rows.size()); ++i) {
    const GateTableRow& row = rows[i];
    const std::string verdict = row.fails ? "**" + row.verdict + "**" : row.verdict;
    text += "| " + verdict;
    for (const std::string& cell : {row.scenario, row.condition, row.method, row.metric, row.before, row.after,
                                    row.difference, row.p, row.worlds}) {
      text += " | " + EscapeMarkdown(cell);
    }
    text += " |\n";
  }
  if (rows.size() > kMostRows) text += fmt::format("\n… and {} more rows, in gate.xml.\n", rows.size() - kMostRows);
  return text;
}

std::string List(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = fmt::format("\n{}\n\n", title);
  for (std::size_t i = 0; i < std::min(kMostRows, lines.size()); ++i) text += "- " + EscapeMarkdown(lines[i]) + "\n";
  if (lines.size() > kMostRows) text += fmt::format("- … and {} more\n", lines.size() - kMostRows);
  return text;
}

/// Writes a command as code, to be copied; as plain text where a name would break out of the code span.
std::string CommandText(const std::string& command) {
  const bool plain = command.find_first_of("`\n\r") == std::string::npos;
  return plain ? "`" + command + "`" : EscapeMarkdown(command);
}

std::string WorldList(std::string_view title, const std::vector<TailLine>& lines) {
  if (lines.empty()) return "";
  std::string text = fmt::format("\n{}\n\n", title);
  for (const TailLine& line : lines) {
    text += "- " + EscapeMarkdown(line.world) + (line.replay.empty() ? "" : ": " + CommandText(line.replay)) + "\n";
  }
  return text;
}

/// Lists the expectations and time rules that have this ruling.
std::vector<std::string> ClaimsThatAre(const GateReport& report, Ruling ruling) {
  std::vector<std::string> lines;
  for (const GateExpectation& e : report.expectations) {
    if (e.result.ruling != ruling) continue;
    lines.push_back(fmt::format("{}: {} ({})", e.scenario, e.result.text, e.result.detail));
  }
  for (const RatioResult& ratio : report.ratios) {
    if (ratio.ruling != ruling) continue;
    lines.push_back(fmt::format("{}: {} ({})", ratio.scenario, RatioClaim(ratio), RatioDetail(ratio)));
  }
  return lines;
}

Ruling RulingOf(const MetricMove& move) {
  if (IsRegression(move)) return Ruling::kUnmet;
  return move.movement == Movement::kUnclear ? Ruling::kUndecided : Ruling::kMet;
}

constexpr std::size_t kMostWorldsOfCase = 20;

JunitCase CaseOf(const MetricMove& move, const GateReport& report) {
  const GateTableRow row = TableRow(move);
  std::string detail = fmt::format("{}: {} -> {}, difference {}, p {}, in {} worlds", row.verdict, row.before,
                                   row.after, row.difference, row.p, row.worlds);
  for (const TailLine& line : TailLines({&move}, report, kMostWorldsOfCase)) {
    detail += "\n" + line.world + (line.replay.empty() ? "" : ": " + line.replay);
  }
  return {fmt::format("{}, {}: {}", row.condition, row.method, row.metric), RulingOf(move), std::move(detail)};
}

}  // namespace

std::string WriteGateMarkdown(const GateReport& report) {
  std::string text =
      fmt::format("## Etude gate of {}: {}\n\n", EscapeMarkdown(report.suite), GateVerdictWords(GateVerdictOf(report)));
  for (const std::string& sentence : GateSentences(report)) text += "- " + EscapeMarkdown(sentence) + "\n";
  text += List("**Incomplete**, so there is no verdict on the whole:", report.incomplete);
  text += List("**Methods without an answer:**", report.silent);
  text += List("**Not met:**", ClaimsThatAre(report, Ruling::kUnmet));
  std::vector<GateTableRow> failing, others;
  for (GateTableRow& row : MovedRows(report.comparison)) (row.fails ? failing : others).push_back(std::move(row));
  if (!failing.empty()) text += MoveTable(failing);
  text += WorldList("**Worlds that are far worse:**", TailLines(report, true, kMostWorldsEach, kMostWorlds));
  if (!others.empty()) {
    text += fmt::format("\n<details><summary>What else moved ({})</summary>\n{}{}\n</details>\n", others.size(),
                        MoveTable(others),
                        WorldList("Single worlds that are far worse, too few to fail:",
                                  TailLines(report, false, kMostWorldsEach, kMostWorlds)));
  }
  text += List("Could not be decided:", ClaimsThatAre(report, Ruling::kUndecided));
  text += List("New, not in the baseline (`--update` takes it in):", report.comparison.only_after);
  text += List("Settings of the method changed in the scenario:", report.comparison.settings_changed);
  if (!report.baseline_file.empty()) {
    text += fmt::format(
        "\nBaseline {} (Etude {}), run by Etude {}. p: after Holm's correction. Worlds: "
        "where the values differ, of those compared.\n",
        EscapeMarkdown(report.baseline_file), EscapeMarkdown(report.baseline_version),
        EscapeMarkdown(report.program_version));
  }
  return text;
}

std::string WriteGateJunit(const GateReport& report) {
  const auto empty = [](const std::string& name, const std::vector<std::string>& lines) {
    return JunitCase{name, lines.empty() ? Ruling::kMet : Ruling::kUnmet, fmt::format("{}\n", fmt::join(lines, "\n"))};
  };
  std::vector<JunitSuite> suites = {
      {"gate",
       {empty("every cell can be judged", report.incomplete), empty("every method has an answer", report.silent)}}};
  std::map<std::string, std::size_t> places;
  const auto suite_of = [&](const std::string& scenario) -> JunitSuite& {
    const auto [place, is_new] = places.emplace(scenario, suites.size());
    if (is_new) suites.push_back({scenario, {}});
    return suites[place->second];
  };
  for (const GateExpectation& e : report.expectations) {
    suite_of(e.scenario).cases.push_back({e.result.text, e.result.ruling, e.result.detail});
  }
  for (const RatioResult& ratio : report.ratios) {
    suite_of(ratio.scenario).cases.push_back({RatioClaim(ratio), ratio.ruling, RatioDetail(ratio)});
  }
  for (const MetricMove& move : report.comparison.moves) {
    suite_of(move.identity.scenario).cases.push_back(CaseOf(move, report));
  }
  return WriteJunitXml(report.suite + " gate", suites, report.program_version);
}

}  // namespace etude
