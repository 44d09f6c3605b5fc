#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "reports/comparison_table.h"
#include "reports/overview_table.h"
#include "reports/page.h"
#include "reports/paper/paper_a.h"
#include "reports/paper/paper_b_section.h"
#include "reports/transitions/transition_section.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"

namespace etude {
namespace {

/// Writes both verdicts: "better on these clips, inconclusive for other clips".
std::string BothVerdicts(const MethodFinding& finding) {
  if (!finding.is_compared || finding.beyond.on_these_only) return finding.Words();
  return fmt::format("{}, {} for {}", finding.Words(), VerdictWords(finding.beyond.verdict), OtherUnits(finding.unit));
}

/// Writes the answer in a line, then with its figures.
std::string AnswerText(const ScenarioFindings& findings) {
  std::string text;
  if (!findings.headline.empty()) text += fmt::format("**{}**\n\n", EscapeMarkdown(findings.headline));
  text += fmt::format("**{}**: {}\n", BothVerdicts(findings.answer), EscapeMarkdown(findings.answer.sentence));
  if (!findings.rival.is_compared) return text;
  return text + fmt::format("\nAgainst the strongest other method, **{}**: {}\n", BothVerdicts(findings.rival),
                            EscapeMarkdown(findings.rival.sentence));
}

std::string MethodsText(const ScenarioFindings& findings) {
  const std::size_t others = findings.methods.size() > 1 ? findings.methods.size() : 0;
  if (others + findings.yardsticks.size() == 0) return "";
  std::string text = "\n| method | against | verdict | |\n|---|---|---|---|\n";
  for (std::size_t i = 0; i < std::min(others, kMostListed); ++i) {
    const MethodFinding& method = findings.methods[i];
    text += fmt::format("| {} | {} | {} | {} |\n", EscapeMarkdown(method.method), EscapeMarkdown(method.baseline),
                        BothVerdicts(method), EscapeMarkdown(method.sentence));
  }
  for (const std::string& yardstick : findings.yardsticks) {
    text += fmt::format("| {} | | yardstick | Compared with none: what the others are measured by. |\n",
                        EscapeMarkdown(yardstick));
  }
  const std::string rest = LeftOutWords(others, kMostListed, "methods", "the CSV file of comparisons in report/tables");
  return rest.empty() ? text : text + "\n" + EscapeMarkdown(rest) + "\n";
}

std::string ScenarioText(const RunData& run, const ScenarioSummary& scenario) {
  const ScenarioFindings findings = FindingsOf(run, scenario);
  std::string text = fmt::format("\n## {}\n\n{}\n\n{}", EscapeMarkdown(scenario.name),
                                 EscapeMarkdown(scenario.question), AnswerText(findings));
  text += MethodsText(findings) + PosePairsMarkdown(run, scenario) + OverviewTableMarkdown(scenario) + '\n';
  text += AcrossTableMarkdown(scenario);
  for (const ExpectationResult& e : scenario.expectations) {
    const std::string_view ruling = e.ruling == Ruling::kMet     ? "met"
                                    : e.ruling == Ruling::kUnmet ? "**not met**"
                                                                 : "undecided";
    text += fmt::format("- {}: {}{}\n", ruling, EscapeMarkdown(e.text),
                        e.detail.empty() ? "" : fmt::format(" ({})", EscapeMarkdown(e.detail)));
  }
  text += fmt::format("- {}\n", EscapeMarkdown(StatusSentence(findings)));
  for (const SuccessFinding& success : findings.successes) {
    text += fmt::format("- {}\n", EscapeMarkdown(SuccessSentence(success)));
  }
  for (const ReasonCount& reason : std::span(findings.reasons).first(std::min(findings.reasons.size(), kMostListed))) {
    text += fmt::format("  - {} × {} in {}: {}\n", FormatCount(reason.cells), EscapeMarkdown(StatusName(reason.status)),
                        EscapeMarkdown(reason.method), EscapeMarkdown(reason.reason));
  }
  const std::string rest = LeftOutWords(findings.reasons.size(), kMostListed, "reasons", "cells.jsonl");
  if (!rest.empty()) text += fmt::format("  - {}\n", EscapeMarkdown(rest));
  return text + TransitionsMarkdown(RecordedRequestsOf(run, scenario)) + PaperAMarkdown(scenario) +
         PaperBMarkdown(run, scenario) + ComparisonTableMarkdown(scenario);
}

}  // namespace

std::string WriteMarkdown(const RunData& run) {
  std::string text = fmt::format("# {}\n\n{}\n", EscapeMarkdown(run.suite), FindingsOf(run).sentence);
  for (const ScenarioSummary& scenario : run.scenarios) text += ScenarioText(run, scenario);
  text += fmt::format("\nEtude {}, {}.\n", EscapeMarkdown(run.program_version), DescribeWorlds(run));
  return text;
}

}  // namespace etude
