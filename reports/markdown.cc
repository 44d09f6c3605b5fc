#include "reports/markdown.h"

#include <fmt/core.h>

#include "reports/comparison_table.h"
#include "reports/paper/paper_b_section.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"

namespace etude {
namespace {

std::string ScenarioText(const RunData& run, const ScenarioSummary& scenario) {
  const ScenarioFindings findings = FindingsOf(run, scenario);
  std::string text =
      fmt::format("\n## {}\n\n{}\n\n**{}**: {}\n", EscapeMarkdown(scenario.name), EscapeMarkdown(scenario.question),
                  findings.answer.Words(), EscapeMarkdown(findings.answer.sentence));
  if (findings.methods.size() > 1) {
    text += "\n| method | against | verdict | |\n|---|---|---|---|\n";
    for (const MethodFinding& method : findings.methods) {
      text += fmt::format("| {} | {} | {} | {} |\n", EscapeMarkdown(method.method), EscapeMarkdown(method.baseline),
                          method.Words(), EscapeMarkdown(method.sentence));
    }
  }
  text += '\n';
  for (const ExpectationResult& e : scenario.expectations) {
    const std::string_view outcome = e.outcome == Outcome::kMet     ? "met"
                                     : e.outcome == Outcome::kUnmet ? "**not met**"
                                                                    : "undecided";
    text += fmt::format("- {}: {}{}\n", outcome, EscapeMarkdown(e.text),
                        e.detail.empty() ? "" : fmt::format(" ({})", EscapeMarkdown(e.detail)));
  }
  text += fmt::format("- {}\n", EscapeMarkdown(StatusSentence(findings)));
  for (const ReasonCount& reason : findings.reasons) {
    text += fmt::format("  - {} × {} in {}: {}\n", FormatCount(reason.cells), EscapeMarkdown(StatusName(reason.status)),
                        EscapeMarkdown(reason.method), EscapeMarkdown(reason.reason));
  }
  return text + PaperBMarkdown(run, scenario) + ComparisonTableMarkdown(scenario);
}

}  // namespace

std::string WriteMarkdown(const RunData& run) {
  std::string text = fmt::format("# {}\n\n{}\n", EscapeMarkdown(run.suite), FindingsOf(run).sentence);
  for (const ScenarioSummary& scenario : run.scenarios) text += ScenarioText(run, scenario);
  text += fmt::format("\nEtude {}, seed {}.\n", EscapeMarkdown(run.program_version), run.seed);
  return text;
}

}  // namespace etude
