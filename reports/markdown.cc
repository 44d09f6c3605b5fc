#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/comparison_table.h"
#include "reports/faulty_clips.h"
#include "reports/overview_table.h"
#include "reports/page.h"
#include "reports/paper/paper_a.h"
#include "reports/paper/paper_b_section.h"
#include "reports/transitions/transition_section.h"
#include "reports/words/answer.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

std::string FindingText(const MethodFinding& finding) {
  if (!finding.is_compared) return EscapeMarkdown(finding.sentence);
  return fmt::format("**{}**: {}", finding.BothVerdicts(), EscapeMarkdown(finding.sentence));
}

/// Returns the method's answer against the baseline. If the strongest other method is not the baseline, adds the answer
/// against the strongest other method.
std::string AnswerText(const ScenarioFindings& findings) {
  std::string text = FindingText(findings.answer) + "\n";
  return HasOtherRival(findings) ? text + "\nThe strongest other: " + FindingText(findings.rival) + "\n" : text;
}

/// Returns the description of the worlds and one sentence about each method; "" if the scenario describes neither
/// worlds nor methods.
std::string WhatIsComparedText(const ScenarioSummary& scenario) {
  std::string text = scenario.description.empty() ? "" : "\n" + EscapeMarkdown(scenario.description) + "\n";
  if (scenario.descriptions.empty()) return text;
  text += "\n";
  for (std::size_t i = 0; i < std::min(scenario.descriptions.size(), kMaxListed); ++i) {
    text += fmt::format("- {}: {}\n", EscapeMarkdown(MethodLabel(scenario, scenario.methods[i])),
                        EscapeMarkdown(scenario.descriptions[i]));
  }
  const std::string rest = LeftOutWords(scenario.methods.size(), kMaxListed, "methods", "manifest.json");
  return rest.empty() ? text : text + "\n" + EscapeMarkdown(rest) + "\n";
}

std::string ScenarioText(const RunData& run, const ScenarioSummary& scenario) {
  const ScenarioFindings findings = FindingsOf(run, scenario);
  // Write the scenario's answer and the tables.
  std::string text = fmt::format("\n## {}\n\n{}\n\n{}", EscapeMarkdown(scenario.name),
                                 EscapeMarkdown(scenario.question), AnswerText(findings));
  if (!findings.figures.methods.empty()) text += TableMarkdown(FiguresTable(findings.figures, true));
  text += WhatIsComparedText(scenario) + OverviewTableMarkdown(scenario);
  text += ComparisonTableMarkdown(scenario) + AcrossTableMarkdown(scenario) + '\n';
  // Write the expectations, how many cells ended in each status, and the reasons.
  for (const ExpectationResult& e : scenario.expectations) {
    const std::string_view outcome = e.outcome == ClaimOutcome::kMet     ? "met"
                                     : e.outcome == ClaimOutcome::kUnmet ? "**not met**"
                                                                         : "undecided";
    text += fmt::format("- {}: {}{}\n", outcome, EscapeMarkdown(e.text),
                        e.detail.empty() ? "" : fmt::format(" ({})", EscapeMarkdown(e.detail)));
  }
  text += fmt::format("- {}\n", EscapeMarkdown(StatusSentence(findings)));
  for (const SuccessFinding& success : findings.successes) {
    text += fmt::format("- {}\n", EscapeMarkdown(SuccessSentence(success)));
  }
  const auto list = [&](const std::vector<ReasonCount>& counts, std::string_view what) {
    for (const ReasonCount& one : std::span(counts).first(std::min(counts.size(), kMaxListed))) {
      text += fmt::format("  - {}\n", EscapeMarkdown(DescribeCount(one)));
    }
    const std::string rest = LeftOutWords(counts.size(), kMaxListed, what, "cells.jsonl");
    if (!rest.empty()) text += fmt::format("  - {}\n", EscapeMarkdown(rest));
  };
  list(findings.reasons, "reasons");
  list(findings.doubts, "doubts");
  return text + PosePairsMarkdown(run, scenario) + TransitionsMarkdown(RecordedRequestsOf(run, scenario)) +
         PaperAMarkdown(scenario) + PaperBMarkdown(run, scenario);
}

}  // namespace

std::string WriteMarkdown(const RunData& run) {
  std::string text = fmt::format("# {}\n\n{}\n\n", EscapeMarkdown(run.suite), FindingsOf(run).sentence);
  for (const ScenarioSummary& scenario : run.scenarios) {
    const std::string headline = HeadlineOf(scenario, MethodInQuestion(scenario),
                                            scenario.headline_metrics.empty() ? "" : scenario.headline_metrics.front());
    if (!headline.empty())
      text += fmt::format("- **{}** {}\n", EscapeMarkdown(scenario.name), EscapeMarkdown(headline));
  }
  text += FaultyClipsMarkdown(run);
  for (const ScenarioSummary& scenario : run.scenarios) text += ScenarioText(run, scenario);
  const bool compares = std::ranges::any_of(run.scenarios, [](const auto& of) { return CountComparisons(of) > 0; });
  if (compares) text += fmt::format("\n{}\n\n{}\n", EscapeMarkdown(kSigns), EscapeMarkdown(kComparisonLegend));
  text += fmt::format("\nEtude {}, {}.\n", EscapeMarkdown(run.program_version), DescribeWorlds(run));
  return text;
}

}  // namespace etude
