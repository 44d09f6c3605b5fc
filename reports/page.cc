#include "reports/page.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/assets/assets.h"
#include "reports/badge.h"
#include "reports/film_element.h"
#include "reports/growth/growth_section.h"
#include "reports/paper/paper_a_section.h"
#include "reports/paper/paper_b_section.h"
#include "reports/plots/marks.h"
#include "reports/real_takes_section.h"
#include "reports/scenario_card.h"
#include "reports/transitions/recorded_requests.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

// A second line of defence behind the escaping: the page may load nothing from anywhere.
constexpr std::string_view kPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; media-src data:";

// A page carries only the styles that it uses.
std::string Styles(const RunData& run) {
  const bool shows_curves = std::ranges::any_of(run.scenarios, [&](const ScenarioSummary& scenario) {
    return ShowsPaperA(scenario) || ShowsPaperB(run, scenario) || ShowsGrowth(scenario);
  });
  const bool shows_transitions = std::ranges::any_of(
      run.scenarios, [&](const ScenarioSummary& scenario) { return !RecordedRequestsOf(run, scenario).empty(); });
  return std::string(ReportCss()) + MarksCss() + std::string(shows_curves ? PaperCss() : "") +
         std::string(shows_transitions ? TransitionsCss() : "");
}

std::string Head(const RunData& run) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>{} · Etude</title><style>{}</style></head>\n",
      kPolicy, EscapeMarkup(run.suite), Styles(run));
}

std::string Contents(const RunData& run, const std::vector<ScenarioFindings>& findings) {
  std::string html = "<nav aria-label=\"Questions\"><ol class=\"contents\">";
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    html += fmt::format("<li><a href=\"#{}\"><span>{}</span><span class=\"badges\">{}{}</span></a></li>", CardAnchor(i),
                        EscapeMarkup(scenario.question.empty() ? scenario.name : scenario.question),
                        FindingBadge(findings[i].answer, "baseline"), FindingBadge(findings[i].rival, "best other"));
  }
  return html +
         "</ol><p class=\"quiet legend\">The method that each question is about, against its baseline and against the "
         "strongest other method: ▲ better, ▼ worse, = no difference that matters, ? undecided, ± it depends on the "
         "condition. In brackets: on these worlds only, not for other clips, people or libraries like "
         "theirs.</p></nav>";
}

constexpr std::string_view kHowToRead = R"(<section class="how"><h2>How to read this</h2>
<p>A <b>world</b> is one simulated trial whose truth is known; every method meets the same worlds, so differences are
taken world by world. <b>Better</b> and <b>worse</b> mean that the interval of the difference lies clear of zero and
matters in practice; <b>no difference</b>, that it lies within what would matter; <b>inconclusive</b>, that nothing is
settled, and never that there is no difference.</p>
<p>Each comparison has two verdicts. <b>On these worlds</b> (these clips, these people): the differences that were
measured. <b>Beyond them</b> (for other clips, other people): there a clip counts once, however many worlds were drawn
from it, and with fewer than six clips there is no such verdict.</p>
<p>Status <b>ok</b> means that a cell was measured, not that it reached anything: success has shares of its own. Whatever
failed is counted and named; a missing value is shown as —, never as zero.</p></section>
)";

/// What of a large run the pictures show.
std::string LeftOutSentence(const RunData& run) {
  if (!run.source) return "";
  return fmt::format(
      " Figures and verdicts are of all cells; dots, curves and why values are missing, of {} of them: "
      "whole worlds at equal steps.",
      FormatCount(static_cast<long long>(run.rows.size())));
}

std::string Footer(const RunData& run) {
  std::string html = "<footer><dl>";
  const auto entry = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, EscapeMarkup(value));
  };
  entry("Etude", run.program_version);
  entry("Seed", fmt::format("{}", run.seed));
  entry("Took", run.wall_seconds > 0 ? FormatNumber(run.wall_seconds) + " s" : "");
  entry("Machine", run.host);
  entry("Unsealed", run.unsealed);
  entry("Command", run.command_line);
  html += "</dl><p>All tables as CSV and LaTeX: <code>report/tables/</code>";
  if (std::ranges::find(run.scenarios, "capture", &ScenarioSummary::task) != run.scenarios.end()) {
    html += "; recovered motions as BVH, pictures with depth and labels as EXR beside them";
  }
  return html + ".</p></footer>";
}

}  // namespace

std::string WritePage(const RunData& run, const Media& media, std::span<const RealTake> real) {
  std::vector<ScenarioFindings> findings;
  for (const ScenarioSummary& scenario : run.scenarios) findings.push_back(FindingsOf(run, scenario));

  std::string html = Head(run);
  html += fmt::format(
      "<body>{}<a class=\"skip\" href=\"#{}\">Skip to the answers</a><main><header><p class=\"eyebrow\">Etude"
      "</p><h1>The {} suite</h1><p class=\"verdict\">{}</p></header>",
      MarkDefsSvg(), CardAnchor(0), EscapeMarkup(run.suite),
      EscapeMarkup(FindingsOf(run).sentence + LeftOutSentence(run)));
  html += FilmElement(media.film, true);
  html += Contents(run, findings);
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) html += WriteScenarioCard(run, i, findings[i], media);
  html += RealTakesSection(run, real);
  html += kHowToRead;
  html += Footer(run);
  html += "</main><script>";
  html += ChartJs();
  html += "</script><script>";
  html += ReportJs();
  html += "</script></body></html>\n";
  return html;
}

}  // namespace etude
