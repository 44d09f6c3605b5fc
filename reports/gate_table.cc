#include "reports/gate_table.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/junit.h"

namespace etude {
namespace {

MetricWords GateWordsFor(const std::string& metric) {
  if (metric != kOkShare) return WordsFor(metric);
  return {.label = "cells with status ok",
          .suffix = " %",
          .difference_suffix = " percentage points",
          .scale = 100,
          .is_share = true,
          .direction = Direction::kHigherIsBetter};
}

std::string DifferenceText(const MetricMove& move, const MetricWords& words) {
  const Comparison& found = move.comparison;
  const auto difference = move.by_mean ? found.mean : found.difference;
  const auto low = move.by_mean ? found.mean_low : found.ci_low, high = move.by_mean ? found.mean_high : found.ci_high;
  if (!difference) return std::string(kNoValue);
  const std::string text =
      (move.by_mean ? "mean " : "") + FormatNumber(*difference * words.scale) + words.difference_suffix;
  return low ? text + " (" + FormatInterval(low, high, words) + ")" : text;
}

std::string TestText(const MetricMove& move) {
  if (move.movement == Movement::kChanged || !move.comparison.p_holm) return std::string(kNoValue);
  return *move.comparison.p_holm < 0.001 ? "< 0.001" : fmt::format("{:.3f}", *move.comparison.p_holm);
}

std::string WorldsText(const MetricMove& move) {
  std::string text = fmt::format("{} of {}", FormatCount(move.differing), FormatCount(move.worlds));
  if (move.lost > 0) text += fmt::format(", {} lost", Plural(move.lost, "value"));
  if (move.gained > 0) text += fmt::format(", {} gained", Plural(move.gained, "value"));
  if (!move.tail.empty()) text += fmt::format(", {} far worse", move.tail.size());
  return text;
}

/// Returns how many changes of metrics have each outcome, without zeros: "2 worse, 3 better, 165 same".
std::string MovementCounts(const std::vector<MetricMove>& moves) {
  std::string text;
  for (Movement movement : {Movement::kWorse, Movement::kChanged, Movement::kBetter, Movement::kUndecided,
                            Movement::kNoMatter, Movement::kSame}) {
    const auto count =
        std::count_if(moves.begin(), moves.end(), [&](const MetricMove& move) { return move.movement == movement; });
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", FormatCount(count), MovementWords(movement));
  }
  return text;
}

/// Returns how many items have each outcome, without zeros: "12 expectations: 11 met, 1 unmet"; "" if there are no
/// items.
template <typename Items, typename OutcomeOf>
std::string OutcomeCounts(const Items& items, std::string_view what, OutcomeOf outcome_of) {
  std::string text;
  for (ClaimOutcome outcome : {ClaimOutcome::kUnmet, ClaimOutcome::kUndecided, ClaimOutcome::kMet}) {
    const auto count =
        std::count_if(items.begin(), items.end(), [&](const auto& item) { return outcome_of(item) == outcome; });
    if (count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", FormatCount(count), ClaimOutcomeName(outcome));
  }
  return text.empty() ? "" : Plural(static_cast<long long>(items.size()), what) + ": " + text;
}

std::string VerdictText(const MetricMove& move) {
  const std::string words(MovementWords(move.movement));
  return move.by_tail ? fmt::format("{} in {}", words, Plural(std::ssize(move.tail), "world")) : words;
}

constexpr const char* kTo = " → ";

std::string ValuesText(const TailWorld& world, const std::string& metric) {
  const std::string ended_before(StatusName(StatusOf(world.ended_before)));
  const std::string ended_after(StatusName(StatusOf(world.ended_after)));
  if (metric == kOkShare) return ended_before + kTo + ended_after;
  const MetricWords words = GateWordsFor(metric);
  const std::string before = FormatValue(world.before, words), after = FormatValue(world.after, words);
  if (!world.after) return fmt::format("{}{}no value ({})", before, kTo, ended_after);
  if (before != after) return before + kTo + after;
  return fmt::format("{}{}{}", *world.before, kTo, *world.after);  // FormatValue would drop the digits that differ
}

}  // namespace

GateTableRow GateRowOf(const MetricMove& move) {
  const MetricWords words = GateWordsFor(move.identity.metric);
  return {.scenario = move.identity.scenario,
          .condition = move.identity.condition,
          .method = move.identity.method,
          .metric = words.label,
          .before = FormatValue(move.before, words),
          .after = FormatValue(move.after, words),
          .difference = DifferenceText(move, words),
          .p = TestText(move),
          .worlds = WorldsText(move),
          .verdict = VerdictText(move),
          .fails = IsRegression(move)};
}

std::vector<GateTableRow> MovedRows(const SnapshotComparison& comparison) {
  constexpr std::array kOrder = {Movement::kWorse, Movement::kChanged, Movement::kBetter, Movement::kUndecided,
                                 Movement::kNoMatter};
  std::vector<GateTableRow> rows;
  for (Movement movement : kOrder) {
    for (const MetricMove& move : comparison.moves) {
      if (move.movement == movement) rows.push_back(GateRowOf(move));
    }
  }
  return rows;
}

std::string RatioClaim(const RatioResult& ratio) {
  return fmt::format("processor time of {} divided by that of {}: at most {}", ratio.rule.of, ratio.rule.over,
                     ratio.rule.at_most);
}

std::string RatioDetail(const RatioResult& ratio) {
  if (!ratio.median) return "no world has times of both methods";
  const std::string median = "median " + FormatNumber(*ratio.median);
  const std::string worlds = Plural(ratio.pairs, "world");
  const std::string short_time =
      ratio.too_short_s ? fmt::format("; too short to judge: a method takes {} ms per world, the rule needs {} ms",
                                      FormatNumber(*ratio.too_short_s * 1000), kMinJudgedSeconds * 1000)
                        : "";
  if (!ratio.ci_low) return fmt::format("{} over {}, which are too few for an interval{}", median, worlds, short_time);
  return fmt::format("{} (95 % interval {}) over {}{}", median, FormatInterval(ratio.ci_low, ratio.ci_high, {}), worlds,
                     short_time);
}

std::string_view GateVerdictWords(GateVerdict verdict) {
  constexpr std::array<std::string_view, 3> kWords = {"pass", "regression", "incomplete"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::vector<std::string> NotAlikeLines(const SnapshotComparison& comparison) {
  std::vector<std::pair<std::string, std::string>> lines;  // the method with the reason, and the metrics
  for (const MetricMove& move : comparison.moves) {
    if (move.movement != Movement::kUndecided || move.comparison.not_alike.empty()) continue;
    const MoveIdentity& one = move.identity;
    const std::string about = one.scenario + (one.condition == "-" ? "" : ", " + one.condition) + ", " + one.method +
                              ": " + move.comparison.not_alike;
    auto line = std::ranges::find(lines, about, &std::pair<std::string, std::string>::first);
    if (line == lines.end()) line = lines.insert(lines.end(), {about, ""});
    line->second += (line->second.empty() ? "" : ", ") + GateWordsFor(one.metric).label;
  }
  std::vector<std::string> text;
  for (const auto& [about, metrics] : lines) text.push_back(fmt::format("{} ({})", about, metrics));
  return text;
}

std::string CompareSentence(const SnapshotComparison& comparison) {
  return Plural(static_cast<long long>(comparison.moves.size()), "comparison") + ": " +
         MovementCounts(comparison.moves);
}

std::vector<std::string> GateSentences(const GateReport& report) {
  std::vector<std::string> sentences = {
      OutcomeCounts(report.expectations, "expectation", [](const GateExpectation& e) { return e.result.outcome; }),
      OutcomeCounts(report.ratios, "time rule", [](const RatioResult& ratio) { return ratio.outcome; })};
  if (report.baseline_file.empty()) {
    const bool has_own = !report.expectations.empty() || !report.ratios.empty();
    sentences.push_back(fmt::format(
        "nothing was compared, because there is no baseline: {}",
        has_own                      ? "the gate only judged the expectations and time rules of the run’s scenarios"
        : !report.incomplete.empty() ? "the run is incomplete, so the gate judged nothing else"
                                     : "the scenarios have no expectations, so the gate only checked that every "
                                       "cell has a row and every method has an answer"));
  } else if (!report.comparison.moves.empty()) {
    sentences.push_back("compared with the baseline: " + CompareSentence(report.comparison));
  }
  std::erase(sentences, "");
  return sentences;
}

std::vector<std::string> WorsenedLines(const GateReport& report, bool only_reversed) {
  std::vector<std::string> lines;
  for (const WorsenedAnswer& one : report.worsened) {
    if (one.IsReversed() || !only_reversed) lines.push_back(DescribeWorsened(one));
  }
  return lines;
}

std::string CellOf(const MoveIdentity& identity, int trial) {
  return fmt::format("{}/{}/{:03}/{}", identity.scenario, identity.condition, trial, identity.method);
}

std::string ReplayCommand(const GateReport& report, const std::string& cell) {
  return fmt::format("etude replay {}{} --cell {}{}", report.run_folder.empty() ? "RUN" : ShellWord(report.run_folder),
                     report.runs_programs ? " --allow-exec" : "", ShellWord(cell),
                     report.baseline_file.empty() ? "" : " --baseline " + ShellWord(report.baseline_file));
}

std::vector<TailLine> TailLines(const std::vector<const MetricMove*>& moves, const GateReport& report,
                                std::size_t most) {
  if (moves.empty()) return {};
  const MoveIdentity& one = moves.front()->identity;
  const std::string about = one.scenario + (one.condition == "-" ? "" : ", " + one.condition);
  // The far worse worlds: the trial of each, and a text that lists the metrics that became far worse.
  std::vector<std::pair<int, std::string>> worlds;
  std::map<int, std::size_t> places;
  for (const MetricMove* move : moves) {
    const std::string& metric = move->identity.metric;
    const std::string label = metric == kOkShare ? "" : GateWordsFor(metric).label + " ";
    for (const TailWorld& world : move->tail) {
      const auto [place, is_new] = places.emplace(world.trial, worlds.size());
      if (is_new) worlds.emplace_back(world.trial, "");
      std::string& text = worlds[place->second].second;
      text += (text.empty() ? "" : "; ") + label + ValuesText(world, metric);
    }
  }
  std::vector<TailLine> lines;
  for (std::size_t i = 0; i < std::min(most, worlds.size()); ++i) {
    const auto& [trial, text] = worlds[i];
    lines.push_back({fmt::format("{}, trial {}, {}: {}", about, trial, one.method, text),
                     ReplayCommand(report, CellOf(one, trial))});
  }
  if (worlds.size() > most) {
    const auto more = std::ssize(worlds) - std::ssize(lines);
    lines.push_back({fmt::format("… and {} of {}, {}", Plural(more, "more world"), about, one.method), ""});
  }
  return lines;
}

std::string_view TailHeading(TailGroup group) {
  switch (group) {
    case TailGroup::kFailing:
      return "Worlds in which a method became far worse:";
    case TailGroup::kTooFew:
      return "Single worlds in which a method became far worse, but too few to fail the gate:";
    case TailGroup::kNotJudged:
      break;
  }
  return "Single worlds in which a method became far worse; not judged, because the scenario turned off the tail rule:";
}

std::vector<TailLine> TailLines(const GateReport& report, TailGroup group, std::size_t most_each, std::size_t most) {
  const auto group_of = [](const MetricMove& move) {
    return IsRegression(move) ? TailGroup::kFailing : move.is_tail_judged ? TailGroup::kTooFew : TailGroup::kNotJudged;
  };
  // The changes of metrics of each method under each condition, in the order of the run.
  std::vector<std::vector<const MetricMove*>> methods;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> places;
  for (const MetricMove& move : report.comparison.moves) {
    if (move.tail.empty() || group_of(move) != group) continue;
    const MoveIdentity& one = move.identity;
    const auto [place, is_new] = places.emplace(std::tuple(one.scenario, one.condition, one.method), methods.size());
    if (is_new) methods.emplace_back();
    methods[place->second].push_back(&move);
  }
  std::vector<TailLine> lines;
  std::size_t left_out = 0;
  for (const auto& moves : methods) {
    if (lines.size() >= most) {
      ++left_out;
      continue;
    }
    for (TailLine& line : TailLines(moves, report, most_each)) lines.push_back(std::move(line));
  }
  if (left_out > 0) lines.push_back({fmt::format("… and worlds of {}", Plural(left_out, "more method")), ""});
  return lines;
}

namespace {

// The maximum number of rows. GitHub allows 65,536 characters in a comment, and nobody would read a longer table.
constexpr std::size_t kMaxRows = 100;
constexpr std::size_t kMaxWorldsEach = 5, kMaxWorlds = 40;

std::string MoveTable(const std::vector<GateTableRow>& rows) {
  Table table{.columns = {{}, {"scenario"}, {"condition"}, {"method"}, {"metric"}}};
  for (const char* head : {"baseline", "now", "difference (95 %)", "p", "worlds"}) {
    table.columns.push_back({.head = head, .is_number = true});
  }
  for (std::size_t i = 0; i < std::min(kMaxRows, rows.size()); ++i) {
    const GateTableRow& row = rows[i];
    table.rows.push_back({{row.verdict, row.scenario, row.condition, row.method, row.metric, row.before, row.after,
                           row.difference, row.p, row.worlds}});
    table.rows.back().cells.front().is_strong = row.fails;
  }
  std::string text = TableMarkdown(table);
  if (rows.size() > kMaxRows)
    text += fmt::format("\n… and {} more rows; gate.xml contains all rows.\n", rows.size() - kMaxRows);
  return text;
}

std::string List(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = fmt::format("\n{}\n\n", title);
  for (std::size_t i = 0; i < std::min(kMaxRows, lines.size()); ++i) text += "- " + EscapeMarkdown(lines[i]) + "\n";
  if (lines.size() > kMaxRows) text += fmt::format("- … and {} more\n", lines.size() - kMaxRows);
  return text;
}

/// Returns `content` as Markdown, collapsed below a title (<details>); "" if `content` is empty.
std::string FoldedAway(const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return fmt::format("\n<details><summary>{}</summary>\n{}\n</details>\n", title, content);
}

/// Returns a table of the run's own answers (which method is better), as the report page of the run states them.
std::string AnswerTable(const std::vector<GateAnswer>& answers) {
  if (answers.empty()) return "";
  Table table{.columns = {{"scenario"}, {"condition"}, {"method"}, {"against"}, {"answer"}, {"decided by"}}};
  for (std::size_t i = 0; i < std::min(kMaxRows, answers.size()); ++i) {
    const auto& [scenario, condition, answer] = answers[i];
    const std::string step(NameOfValue(kAnswerSteps, answer.decided_by));
    table.rows.push_back({{scenario, condition, answer.method, answer.baseline, VerdictName(answer.verdict), step}});
  }
  return TableMarkdown(table);
}

/// Returns a command as a Markdown code span, or as plain text if the command contains a character that would end the
/// span.
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

std::vector<std::string> ClaimsThatAre(const GateReport& report, ClaimOutcome outcome) {
  std::vector<std::string> lines;
  for (const GateExpectation& e : report.expectations) {
    if (e.result.outcome != outcome) continue;
    lines.push_back(fmt::format("{}: {} ({})", e.scenario, e.result.text, e.result.detail));
  }
  for (const RatioResult& ratio : report.ratios) {
    if (ratio.outcome != outcome) continue;
    lines.push_back(fmt::format("{}: {} ({})", ratio.scenario, RatioClaim(ratio), RatioDetail(ratio)));
  }
  return lines;
}

ClaimOutcome OutcomeOf(const MetricMove& move) {
  if (IsRegression(move)) return ClaimOutcome::kUnmet;
  return move.movement == Movement::kUndecided ? ClaimOutcome::kUndecided : ClaimOutcome::kMet;
}

constexpr std::size_t kMaxWorldsOfCase = 20;

JunitCase CaseOf(const MetricMove& move, const GateReport& report) {
  const GateTableRow row = GateRowOf(move);
  std::string detail = fmt::format("{}: {} -> {}, difference {}, p {}, in {} worlds", row.verdict, row.before,
                                   row.after, row.difference, row.p, row.worlds);
  if (move.movement == Movement::kUndecided && !move.comparison.not_alike.empty())
    detail += "\n" + move.comparison.not_alike;
  for (const TailLine& line : TailLines({&move}, report, kMaxWorldsOfCase)) {
    detail += "\n" + line.world + (line.replay.empty() ? "" : ": " + line.replay);
  }
  return {fmt::format("{}, {}: {}", row.condition, row.method, row.metric), OutcomeOf(move), std::move(detail)};
}

}  // namespace

std::string WriteGateMarkdown(const GateReport& report) {
  std::string text =
      fmt::format("## Etude gate of {}: {}{}\n\n", EscapeMarkdown(report.suite),
                  GateVerdictWords(GateVerdictOf(report)), report.baseline_file.empty() ? ", without a baseline" : "");
  // Write how many expectations and comparisons were judged, and how many failed.
  for (const std::string& sentence : GateSentences(report)) text += "- " + EscapeMarkdown(sentence) + "\n";
  text += List("**The run is incomplete**, so there is no overall verdict:", report.incomplete);
  text += List("**Without an answer or a value in any cell:**", report.silent);
  text += List("**Expectations and time rules that are not met:**", ClaimsThatAre(report, ClaimOutcome::kUnmet));
  text +=
      List("**Verdicts that became worse** (a change from better to worse is a regression):", WorsenedLines(report));
  // Write the changed metrics. Changes that fail the gate are visible; all other changes are collapsed.
  std::vector<GateTableRow> failing, others;
  for (GateTableRow& row : MovedRows(report.comparison)) (row.fails ? failing : others).push_back(std::move(row));
  if (!failing.empty()) text += MoveTable(failing);
  const auto worlds = [&](TailGroup group) {
    const std::string stars = group == TailGroup::kFailing ? "**" : "";
    return WorldList(fmt::format("{0}{1}{0}", stars, TailHeading(group)),
                     TailLines(report, group, kMaxWorldsEach, kMaxWorlds));
  };
  text += worlds(TailGroup::kFailing);
  if (!others.empty()) {
    text += FoldedAway(fmt::format("Other changes ({})", others.size()),
                       MoveTable(others) + worlds(TailGroup::kTooFew) + worlds(TailGroup::kNotJudged));
  }
  // Write the undecided claims (which pass), the run's own answers, the entries that could not be compared, and the
  // methods with changed settings.
  const std::vector<std::string> undecided = ClaimsThatAre(report, ClaimOutcome::kUndecided);
  text += FoldedAway(fmt::format("Undecided expectations and time rules ({})", undecided.size()),
                     List("These do not fail the gate:", undecided));
  text += FoldedAway(fmt::format("Verdicts of this run ({})", report.answers.size()), AnswerTable(report.answers));
  text += List("Undecided, because the values cannot be compared:", NotAlikeLines(report.comparison));
  text += List("New, not in the baseline (`--update` adds these):", report.comparison.only_after);
  text += List("Methods whose settings in the scenario changed:", report.comparison.settings_changed);
  text += List("Doubts about the judged files (these do not fail the gate):", report.doubts);
  if (!report.baseline_file.empty()) {
    text += fmt::format(
        "\n"
        "Baseline {} (Etude {}), run by Etude {}. p: p-value after Holm's correction. Worlds: the number of worlds in "
        "which the values differ, out of all compared worlds.\n",
        EscapeMarkdown(report.baseline_file), EscapeMarkdown(report.baseline_version),
        EscapeMarkdown(report.program_version));
  }
  return text;
}

std::string WriteGateJunit(const GateReport& report) {
  const auto empty = [](const std::string& name, const std::vector<std::string>& lines) {
    return JunitCase{name, lines.empty() ? ClaimOutcome::kMet : ClaimOutcome::kUnmet,
                     fmt::format("{}\n", fmt::join(lines, "\n"))};
  };
  std::vector<JunitSuite> suites = {{"gate",
                                     {empty("every cell can be judged", report.incomplete),
                                      empty("every method has an answer, and every metric a value", report.silent),
                                      empty("no verdict changed from better to worse", WorsenedLines(report, true))}}};
  std::map<std::string, std::size_t> places;
  const auto suite_of = [&](const std::string& scenario) -> JunitSuite& {
    const auto [place, is_new] = places.emplace(scenario, suites.size());
    if (is_new) suites.push_back({scenario, {}});
    return suites[place->second];
  };
  for (const GateExpectation& e : report.expectations) {
    suite_of(e.scenario).cases.push_back({e.result.text, e.result.outcome, e.result.detail});
  }
  for (const RatioResult& ratio : report.ratios) {
    suite_of(ratio.scenario).cases.push_back({RatioClaim(ratio), ratio.outcome, RatioDetail(ratio)});
  }
  for (const MetricMove& move : report.comparison.moves) {
    suite_of(move.identity.scenario).cases.push_back(CaseOf(move, report));
  }
  return WriteJunitXml(report.suite + " gate", suites, report.program_version);
}

}  // namespace etude
